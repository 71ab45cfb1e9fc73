"""What was measured: recordings and body files, with units and a history. See `Recording`."""

from symid.recording.read import read_recording
from symid.recording.recording import Recording

__all__ = ["Recording", "read_recording"]
