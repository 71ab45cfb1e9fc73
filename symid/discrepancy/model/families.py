"""Which laws look alike: those that take up what one another do, wherever a search may have taken one for another."""

from __future__ import annotations

from symid.discrepancy.model.suspects import Suspect

FAMILIES = (
    {
        "viscous_friction",
        "coulomb_friction",
        "stribeck_friction",
        "joint_drag",
        "cubic_damping",
        "quadratic_drag",
        "link_drag",
        "bouc_wen_hysteresis",
        "bent_hysteresis",
    },
    {"torsional_spring", "bouc_wen_hysteresis", "bent_hysteresis", "clearance", "preload", "gravity_torque"},
    {"torsional_spring", "cubic_stiffness", "quadratic_stiffness", "constant_torque", "gravity_torque"},
    {"cogging_torque", "gravity_torque"},
    {"cubic_stiffness", "end_range_stiffness", "clearance", "play", "bouc_wen_hysteresis", "bent_hysteresis"},
    {"play", "backlash", "clearance", "slack_below", "slack_above"},
    {"cubic_stiffness", "quadratic_stiffness", "end_range_stiffness", "clearance", "upper_stop", "lower_stop"},
    {"quadratic_stiffness", "upper_stop", "lower_stop", "slack_below", "slack_above"},
    {"constant_torque", "quadratic_stiffness", "asymmetric_damping"},
    {"extra_mass", "center_of_mass_error", "link_inertia_error"},
    {"feedback_delay", "muscle_lag", "second_order_muscle_lag", "joint_feedback_delay", "joint_muscle_lag"},
    {"late_damping", "late_feedback", "late_sensing", "feedback_lag"},
    {"late_correction", "late_observation", "correction_lag"},
    {"input_delay", "input_lag", "inputs_delay", "inputs_lag"},
    {"sensor_delay", "sensor_lag"},
    {"sensor_offset", "sensor_drift"},
    {"body_drag", "slow_body_drag", "body_friction"},
    {"proportional_loss", "orifice_loss", "constant_loss", "quadratic_loss", "constant_flow"},
    {"proportional_exchange", "orifice_exchange"},
)
"""Laws that take up what one another do: each is at one amplitude, or while it is small, nearly another."""
LATE_ANYWHERE = ({"input_delay", "inputs_delay", "sensor_delay"}, {"input_lag", "inputs_lag", "sensor_lag"})
"""Laws that look alike wherever they act: of a linear machine the drive may be late, or the sensor."""
STATED = {"stated_value_error"}
"""A constant that is wrong may take up what another is, wherever it stands."""
LOSSES = (
    "viscous_friction",
    "coulomb_friction",
    "quadratic_drag",
    "stribeck_friction",
    "joint_drag",
    "cubic_damping",
    "link_drag",
    "body_drag",
    "slow_body_drag",
    "body_friction",
    "load_dependent_friction",
    "bouc_wen_hysteresis",
    "bent_hysteresis",
)
"""Laws by which a mechanism loses energy."""
EVERYWHERE = "global"
"""The place of laws that act at all places of their kind."""


def is_alike(suspect: Suspect, other: Suspect) -> bool:
    """Whether both are laws of one family at one place, or one of them at all places.

    All muscles may lag where the lag of those at one joint explains much.
    """
    places = {suspect.term.location, other.term.location}
    same = len(places) == 1 or EVERYWHERE in places
    return same and any({suspect.term.name, other.term.name} <= family for family in FAMILIES)


def may_be(suspect: Suspect, other: Suspect) -> bool:
    """Whether `other` may be what acts in the place of `suspect`: of its family there, or late or stated elsewhere."""
    names = {suspect.term.name, other.term.name}
    return is_alike(suspect, other) or any(names <= family for family in (*LATE_ANYWHERE, STATED))
