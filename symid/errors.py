"""One exception for each stage of the work, so that a message says where things went wrong.

Every message follows one pattern: what failed, at which named thing (file, column, row,
symbol), what was found there, and what to do about it.
"""


class SymidError(Exception):
    """Base of every error that symid raises on purpose. `except SymidError` catches them all."""


class RecordingError(SymidError):
    """A recording or body file cannot be used as it is."""


class ModelError(SymidError):
    """A model is incomplete or contradicts itself. `violations` lists all that was found."""

    def __init__(self, message: str, violations: tuple[str, ...] = ()):
        super().__init__(message)
        self.violations = violations


class CodegenError(SymidError):
    """Equations could not be turned into a compiled or NumPy kernel."""


class TranscriptionError(SymidError):
    """A model and a recording could not be turned into a nonlinear program."""


class SolveError(SymidError):
    """The nonlinear program could not be solved, or an evaluation gave NaN or infinity."""


class MachineError(SolveError):
    """A solve failed for reasons of the machine (memory, libraries), not of the problem: it is worth trying again."""


class DiagnosisError(SymidError):
    """A diagnosis was asked of something that cannot be diagnosed."""


class UnitError(SymidError):
    """A unit text is not understood, or cannot be used where it stands."""


class RecordingWarning(UserWarning):
    """A recording can be used, but something in it deserves a look before it is trusted."""
