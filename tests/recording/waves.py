"""Small recordings and their files, shared by the tests of this folder."""

from pathlib import Path

import numpy as np

from symid.recording import Recording

DEGREE = np.pi / 180


def wave(count=200, step=0.01, noise=0.0, seed=0) -> Recording:
    """A sway of 0.7 Hz with exact velocity, sampled evenly from 5 s on."""
    time = 5 + step * np.arange(count)
    angle = 0.05 * np.sin(2 * np.pi * 0.7 * time)
    angle = angle + noise * np.random.default_rng(seed).standard_normal(count)
    velocity = 0.05 * 2 * np.pi * 0.7 * np.cos(2 * np.pi * 0.7 * time)
    return Recording(
        "wave",
        time,
        {"ankle_angle": angle, "ankle_velocity": velocity},
        {"ankle_angle": "rad", "ankle_velocity": "rad/s"},
        signs={"ankle_angle": "forward"},
        noise={"ankle_angle": 0.001},
    )


def without_noise_figure(recording: Recording) -> Recording:
    return recording.with_channel("ankle_angle", recording["ankle_angle"], "rad")


def written(folder: Path, text: str, name: str = "r.csv") -> Path:
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def even_rows(count: int, step: float = 0.01) -> list[str]:
    return [f"{step * i:.4f},{i % 7}" for i in range(count)]


def csv_text(rows, header="time_s,ankle_angle_deg") -> str:
    return "\n".join([header, *rows]) + "\n"
