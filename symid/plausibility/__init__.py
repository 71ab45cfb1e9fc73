"""MISTAKES OF UNITS AND SIGNS, told before a fit hides them: is it possible, what was measured and what the body is?

Three witnesses: magnitudes that a person or a recording can have; channels that must be each other's rates; and the
model's own equations, which explain the recorded accelerations far better once a mistake is undone.
"""

from symid.plausibility.body import body_remarks
from symid.plausibility.channels import channel_remarks
from symid.plausibility.equations import Change
from symid.plausibility.evidence import unexplained
from symid.plausibility.mistakes import model_remarks
from symid.plausibility.motion import Motion, motion_of
from symid.plausibility.remarks import remarks

__all__ = [
    "Change",
    "Motion",
    "body_remarks",
    "channel_remarks",
    "model_remarks",
    "motion_of",
    "remarks",
    "unexplained",
]
