"""Recordings with what their makers know of them, ready to be diagnosed: case directories and rigs."""

from symid.cases.case import Case, diagnose_case, read_case, rig_case

__all__ = ["Case", "diagnose_case", "read_case", "rig_case"]
