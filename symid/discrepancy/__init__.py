"""Find the physics that a model leaves out: locate, name, model, prove."""

from symid.discrepancy.diagnose import diagnose
from symid.discrepancy.model.suspects import Suspect, suspects
from symid.discrepancy.say.answer import read_answer
from symid.discrepancy.say.diagnosis import Diagnosis, Effect

__all__ = ["Diagnosis", "Effect", "Suspect", "diagnose", "read_answer", "suspects"]
