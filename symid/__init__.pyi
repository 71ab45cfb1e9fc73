"""The public names and where they are defined; `symid/__init__.py` reads this list, and so do type checkers."""

from . import mechanics as mechanics
from .analysis import (
    Stability as Stability,
    Uncertainty as Uncertainty,
    bootstrap as bootstrap,
    compare as compare,
    cross_validate as cross_validate,
    design as design,
    identifiability as identifiability,
    likelihood_region as likelihood_region,
    profile as profile,
    stability as stability,
    stability_of as stability_of,
    uncertainty as uncertainty,
)
from .cases import diagnose_case as diagnose_case, read_case as read_case, rig_case as rig_case
from .discrepancy import Diagnosis as Diagnosis, Suspect as Suspect, diagnose as diagnose, suspects as suspects
from .errors import (
    CodegenError as CodegenError,
    DiagnosisError as DiagnosisError,
    ModelError as ModelError,
    RecordingError as RecordingError,
    SolveError as SolveError,
    SymidError as SymidError,
    TranscriptionError as TranscriptionError,
    WriteError as WriteError,
)
from .identification import (
    Cluster as Cluster,
    Identification as Identification,
    LocalPool as LocalPool,
    Solution as Solution,
    Solve as Solve,
    Study as Study,
)
from .identification.files.export import export as export
from .model import (
    Algebraic as Algebraic,
    Boundary as Boundary,
    Constant as Constant,
    Constraint as Constraint,
    Control as Control,
    Equation as Equation,
    Expression as Expression,
    Input as Input,
    Law as Law,
    LawParameter as LawParameter,
    LogNormal as LogNormal,
    Model as Model,
    Noise as Noise,
    Normal as Normal,
    Objective as Objective,
    Output as Output,
    Parameter as Parameter,
    Port as Port,
    Process as Process,
    State as State,
    Term as Term,
    c_function as c_function,
    table as table,
)
from .optimization import Free as Free, Optimization as Optimization, Plan as Plan
from .plots import LivePlot as LivePlot
from .recording import Recording as Recording, read_recording as read_recording
from .transcription import (
    BackwardEuler as BackwardEuler,
    Episodes as Episodes,
    HermiteSimpson as HermiteSimpson,
    Midpoint as Midpoint,
    Trapezoid as Trapezoid,
)

__version__: str
