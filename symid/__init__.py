"""symid: identify mechanical systems and their feedback controllers from recordings.

The public names below are loaded when first used, so that ``import symid`` is quick and the
command line starts at once.
"""

from importlib import import_module

_WHERE = {
    "symid.errors": (
        "CodegenError",
        "DiagnosisError",
        "ModelError",
        "RecordingError",
        "SolveError",
        "SymidError",
        "TranscriptionError",
    ),
    "symid.model": (
        "Algebraic",
        "Boundary",
        "Constant",
        "Constraint",
        "Control",
        "Equation",
        "Expression",
        "Input",
        "Law",
        "LawParameter",
        "LogNormal",
        "Model",
        "Noise",
        "Normal",
        "Objective",
        "Output",
        "Parameter",
        "Port",
        "Process",
        "State",
        "Term",
    ),
    "symid.recording": ("Recording", "read_recording"),
    "symid.transcription": ("BackwardEuler", "Episodes", "HermiteSimpson", "Midpoint", "Trapezoid"),
    "symid.analysis": (
        "Stability",
        "Uncertainty",
        "bootstrap",
        "compare",
        "identifiability",
        "profile",
        "stability",
        "stability_of",
        "uncertainty",
    ),
    "symid.discrepancy": ("Diagnosis", "Suspect", "diagnose", "suspects"),
    "symid.cases": ("diagnose_case", "read_case", "rig_case"),
    "symid.optimization": ("Free", "Optimization", "Plan"),
    "symid.identification": ("Cluster", "Identification", "LocalPool", "Solution", "Solve", "Study"),
}
_MODULE_OF = {name: module for module, names in _WHERE.items() for name in names}
__all__ = ["mechanics", *sorted(_MODULE_OF)]


def __getattr__(name: str):
    if name == "mechanics":
        return import_module("symid.mechanics")
    if name == "__version__":
        from importlib.metadata import version

        return version("symid")
    if name not in _MODULE_OF:
        raise AttributeError(f"module 'symid' has no attribute '{name}'")
    return getattr(import_module(_MODULE_OF[name]), name)


def __dir__():
    return __all__
