"""What was measured: recordings and body files, with units and a history. See `Recording`."""

from symid.recording.body import read_body
from symid.recording.join import join
from symid.recording.markers import joint_angles
from symid.recording.prepare import fill_gaps, lowpass, resample
from symid.recording.read import read_recording
from symid.recording.recording import Recording
from symid.recording.signals.smooth import differentiate, smooth_states, spline_of
from symid.recording.signals.spikes import find_dropouts, find_spikes
from symid.recording.signals.turns import find_wraps, unwrap
from symid.recording.table.columns import load_columns
from symid.recording.table.names import rate_name, rate_unit

__all__ = [
    "Recording",
    "differentiate",
    "fill_gaps",
    "find_dropouts",
    "find_spikes",
    "find_wraps",
    "join",
    "joint_angles",
    "load_columns",
    "lowpass",
    "rate_name",
    "rate_unit",
    "read_body",
    "read_recording",
    "resample",
    "smooth_states",
    "spline_of",
    "unwrap",
]
