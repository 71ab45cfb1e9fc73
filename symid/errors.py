"""One exception for each stage of the work, so that a message says where things went wrong.

Every message follows one pattern: what failed, at which named thing (file, column, row,
symbol), what was found there, and what to do about it.
"""


class SymidError(Exception):
    """Base of every error that symid raises on purpose. `except SymidError` catches them all.

    Examples
    --------
    >>> try:
    ...     si.read_recording("nowhere.csv")
    ... except si.SymidError as error:
    ...     print(type(error).__name__)
    RecordingError
    """


class RecordingError(SymidError):
    """A recording or body file cannot be used as it is.

    Examples
    --------
    >>> si.read_recording("nowhere.csv")
    Traceback (most recent call last):
    symid.errors.RecordingError: nowhere.csv: no such file
    """


class ModelError(SymidError):
    """A model is incomplete or contradicts itself, says `message`; `violations` lists all that was found.

    Examples
    --------
    >>> si.Model("empty").check()
    Traceback (most recent call last):
    symid.errors.ModelError: ...
    """

    def __init__(self, message: str, violations: tuple[str, ...] = ()):
        super().__init__(message)
        self.violations = violations


class CodegenError(SymidError):
    """Equations could not be turned into a compiled or NumPy kernel.

    Examples
    --------
    >>> si.Identification(model, recording, backend="fortran").transcription
    Traceback (most recent call last):
    symid.errors.CodegenError: ...
    """


class TranscriptionError(SymidError):
    """A model and a recording could not be turned into a nonlinear program.

    Examples
    --------
    >>> si.Identification(model, recording, window=(0, 1e6)).transcription
    Traceback (most recent call last):
    symid.errors.TranscriptionError: window 0 to 1e+06 s does not lie in pendulum...
    """


class SolveError(SymidError):
    """The nonlinear program could not be solved, or an evaluation gave NaN or infinity.

    Examples
    --------
    >>> problem.solve(starts=0)
    Traceback (most recent call last):
    symid.errors.SolveError: starts=0: give a whole number of at least 1
    """


class MachineError(SolveError):
    """A solve failed for reasons of the machine (memory, libraries), not of the problem: it is worth trying again."""


class OptionError(SolveError):
    """Ipopt refused one of its options, as it will from every start."""


class DiagnosisError(SymidError):
    """A diagnosis was asked of something that cannot be diagnosed.

    Examples
    --------
    >>> si.diagnose(model)
    Traceback (most recent call last):
    symid.errors.DiagnosisError: diagnose: a model alone is not enough; give the recording and fit_window=(t0, t1)
    """


class WriteError(SymidError, OSError):
    """A file cannot be written where it was asked for; `errno`, `strerror` and `filename` as of any OSError.

    Examples
    --------
    >>> recording.to_csv("/dev/null/recording.csv")
    Traceback (most recent call last):
    symid.errors.WriteError: /dev/null/recording.csv cannot be written (Not a directory): give another path, or ...
    """

    def __str__(self) -> str:
        return (
            f"{self.filename} cannot be written ({self.strerror}): give another path, or make room and the right to "
            "write there"
        )


class UnitError(SymidError):
    """A unit text is not understood, or cannot be used where it stands."""


class RecordingWarning(UserWarning):
    """A recording can be used, but something in it deserves a look before it is trusted."""
