"""In words, the experiment that tells two laws apart."""

# What separates two laws is where their effects differ: in frequency, amplitude or time.
_EXPERIMENTS = (
    (
        ("delay", "lag", "torque_feedback", "acceleration"),
        "a faster excitation: above the frequencies in this recording a delay turns "
        "the phase without loss, a lag loses amplitude, an inertia grows",
    ),
    (
        ("friction", "drag", "dead_zone", "stiffness", "saturation", "backlash", "hysteresis"),
        "the same excitation at half and at twice the amplitude: "
        "each of these laws changes with amplitude in its own way",
    ),
    (
        ("gain_change", "push", "periodic"),
        "a longer recording: an event passes, a change stays, an oscillation returns",
    ),
    (("integral",), "a constant push that is held for a minute: an accumulated error removes the offset in the end"),
    (
        ("gain", "offset", "tilt", "mass", "inertia"),
        "calibrate the sensors and the drive, or weigh the part: the motion alone shows only their product",
    ),
)


def experiment(name: str) -> str:
    """In words, an experiment in which the law `name` differs from its likes."""
    return next(
        (text for words, text in _EXPERIMENTS if any(w in name for w in words)),
        "motion that is faster, larger or longer",
    )
