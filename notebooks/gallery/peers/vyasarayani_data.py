"""Angles and rates of a pendulum with noise, as in the gallery's vyasarayani.py, with two and a half times the samples."""

import math

import numpy as np

N, PIECES = 5001, 8
step = 50 / (N - 1)
time, motion = step * np.arange(N), []
y1, y2, h = math.pi / 6, 0.0, step / PIECES
for _ in range(N):
    motion.append((y1, y2))
    for _ in range(PIECES):  # leapfrog: no tool should pay for the import of an integrator
        y2 -= 0.5 * h * 10 * math.sin(y1)
        y1 += h * y2
        y2 -= 0.5 * h * 10 * math.sin(y1)
noisy = np.transpose(motion) + np.random.default_rng(0).normal(0, [[0.05], [0.1]], (2, N))
