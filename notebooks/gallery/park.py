"""Eight feedback gains of a standing person on a moving platform, from angles with noise.

Source: Park, Horak & Kuo (2004), Experimental Brain Research 154; opty's example "Standing Balance Control
Identification": gains of 950, 175, 185, 50 at the ankle and 45, 290, 60, 26 at the hip, 20 s on a platform that moves
in twelve sines, sensor noise of a quarter of a degree. Here with the body that lies in `data`. The answer is the
truth of the simulation, within three standard errors of the estimate.
"""

from pathlib import Path

import numpy as np

import symid as si
from symid.simulation import Simulator

body = si.mechanics.DoubleLinkPendulum.from_json(Path(__file__).parents[2] / "data/standing_synthetic/body.json")
model = body.with_feedback(si.mechanics.FullStatePD()).fixed(ref_ankle=0, ref_hip=0)
ankle = {"kp_aa": 950, "kp_ah": 175, "kd_aa": 185, "kd_ah": 50}
gains = ankle | {"kp_ha": 45, "kp_hh": 290, "kd_ha": 60, "kd_hh": 26}

time, rng = np.linspace(0, 20, 2001), np.random.default_rng(0)
w = 2 * np.pi * np.array([7, 11, 16, 25, 38, 61, 103, 131, 151, 181, 313, 523]) / 240
push = {"platform_acceleration": -0.02 * (w**2 * np.sin(np.outer(time, w))).sum(axis=1)}
motion = Simulator(model).simulate(gains, np.zeros(4), time, push)
seen = {name: y + np.deg2rad(0.25) * rng.standard_normal(len(time)) for name, y in motion.outputs.items()}
units = dict.fromkeys(seen, "rad") | {"platform_acceleration": "m/s^2"}
channels = {model.outputs[name].channel: y for name, y in seen.items()}
data = si.Recording("platform", time, channels | push, {c: units.get(c, "rad") for c in channels | push})
solution = si.Identification(model, data).solve()

error = solution.parameters["std_error"]
answers = {name: (solution.values[name], value, 3 * error[name]) for name, value in gains.items()}
