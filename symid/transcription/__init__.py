"""Continuous to finite: schemes, layout, episodes, and the sparse program of a collocation."""

from symid.transcription.data import EXTREME, Measured, measure
from symid.transcription.episodes import Episodes
from symid.transcription.layout import Layout
from symid.transcription.program import CollocationProgram
from symid.transcription.schemes import (
    SCHEMES,
    BackwardEuler,
    HermiteSimpson,
    Midpoint,
    Scheme,
    Trapezoid,
    scheme_by_name,
)
from symid.transcription.transcribe import Transcription, transcribe

__all__ = [
    "EXTREME",
    "SCHEMES",
    "BackwardEuler",
    "CollocationProgram",
    "Episodes",
    "HermiteSimpson",
    "Layout",
    "Measured",
    "Midpoint",
    "Scheme",
    "Transcription",
    "Trapezoid",
    "measure",
    "scheme_by_name",
    "transcribe",
]
