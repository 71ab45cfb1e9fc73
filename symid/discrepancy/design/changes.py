"""Experiments that may tell laws apart: what can be changed about the one that was recorded."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Design:
    """An experiment, as factors of the one that was recorded.

    Attributes
    ----------
    words : what to do. effort : order in which experiments are preferred. input : size of the inputs; speed : of
    their course in time. start : distance of the initial state from the mean motion. longer : duration. noise : of
    the sensors. repeats : runs from the same start.
    """

    words: str
    effort: int
    input: float = 1.0
    speed: float = 1.0
    start: float = 1.0
    longer: float = 1.0
    noise: float = 1.0
    repeats: int = 1


DRIVEN = (
    Design("the same input at half its size", 1, input=0.5),
    Design("the same input at twice its size", 1, input=2.0),
    Design("the same input at twice the speed", 2, speed=2.0),
    Design("the same input at half the speed", 2, speed=0.5),
    Design("a recording three times as long", 3, longer=3.0),
    Design("sensors with a quarter of the noise", 4, noise=0.25),
)
"""Experiments with a system that is driven: laws differ in amplitude, frequency, or hide in noise."""
FREE = (
    Design("a start from half as far", 1, start=0.5),
    Design("a start from one and a half times as far", 1, start=1.5),
    Design("a start from twice as far", 1, start=2.0),
    Design("3 recordings from the same start", 3, repeats=3),
    Design("sensors with a quarter of the noise", 4, noise=0.25),
)
"""Experiments with a system that is let go."""
