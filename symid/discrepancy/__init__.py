"""Find the physics that a model leaves out: locate, name, add, prove."""

from symid.discrepancy.case import Case, diagnose_case, read_case, rig_case
from symid.discrepancy.diagnose import diagnose
from symid.discrepancy.diagnosis import Diagnosis, Effect
from symid.discrepancy.suspects import Suspect, established_suspects

__all__ = ["Case", "Diagnosis", "Effect", "Suspect", "diagnose", "diagnose_case", "established_suspects", "read_case",
           "rig_case"]
