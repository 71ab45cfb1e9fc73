"""Every number that decides something in a diagnosis, with its reason.

Evidence is counted in units of twice the log-likelihood. Where no source is named a number is a judgement, looked
at on the practice cases and on real machines. What all of them together do is measured by
`tests/examination/examine.py`, on recordings with known answers.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from symid.estimation.fitting.robust_errors import BLOCK


@dataclass(frozen=True)
class Policy:
    """What a finding costs, and when a search or a proof ends.

    Each suspect pays log N per unknown (BIC; Schwarz 1978), twice for one that is looked for over a grid,
    2 log K for being one of K (extended BIC; Chen & Chen 2008), and `accept`. N counts independent samples.

    Attributes
    ----------
    accept : evidence beyond all that, an odds ratio of exp(accept / 2).
    doubt : what a law without an established name must explain more than one with a name, odds of 150 to 1.
    odds : by kind of suspect, or by name of its law, what it must explain more than a force that follows the state: a
        stated geometry or a sensor is checked by whoever builds the machine (7 to 1), a clock explains any regular
        motion (150 to 1). Drag with the square of the speed belongs to what moves through air or water, with its cube
        to a ship that rolls, a friction with the speed to joints: the other way round is rarer (50 to 1). Dry friction
        alone is rarer than friction with the speed (7 to 1), which is the first term of every smooth loss. What spins
        or rotates is seldom overlooked (50 to 1); a sensor that drifts is rarer than one that is off (7 to 1). One lag
        of all drives is the same in the data as that of an only sensor, which is one fault and not several (150 to 1).
        Of what holds a machine all comes late only where a controller is written into its equations, and an inertia
        that nobody knows of is mostly one that was stated wrongly (150 to 1).
    braking : likewise of a constant force that takes energy from the motion all the time. A disc that runs down does
        not tell it from dry friction, which is in every bearing (7 to 1, its own odds above taken off).
    never : the price of what is never named: a clock whose frequency is a multiple of the one at which a motion
        swings that nothing drives, since any bent force or bent scale makes such harmonics; a law of which a
        part came to nothing; a channel that is late by less than `skew` samples.
    least_part : of two forces of one law neither is less than this part of the other, else the law is never named. A
        Stribeck curve with ten times as much friction at rest as in motion lets a spring stop where it turns, and
        imitates any period that depends on the amplitude (tests/discrepancy/machines/test_other_machines.py).
    skew : of a sample, by which channels of one recorder may be apart: its multiplexer reads them one after the other,
        and what a model leaves out of a smooth motion looks like a hundredth of a sample.
    harmonics : multiples that count.
    equivalent : answers whose evidence is so near are told; the better test then errs in 4 % (Phi(-sqrt(12)/2)).
    most_effects : a search ends here.
    quiet : -log10 of the probability by chance of the most suspicious test, below which no search goes on:
        of about ten tests one reaches it in a tenth of the recordings with nothing left.
    remainder : likewise, above which a rest counts as systematic.
    located : likewise, above which a test tells the place of a rest.
    far : errors so many times the sensors' noise are not explained by whatever acts at one place alone.
    sensors : laws with names explain a free motion where they leave no more than so many times the sensors' rms
        noise: as much again, in power. A judgement, looked at on an air-track glider.
    sure : an effect not so many honest standard errors from nothing is left out.
    apart : values of two halves that differ by so many standard errors contradict each other.
    confirm : probability that the held-out data must give to the improvement.
    block : seconds of a block of held-out data at the pace of a second.
    fewest_blocks : with fewer the scatter of their differences is not known (a t with 5 degrees of freedom).
    chance : a finding that chance alone would make in this recording with more than this probability is none.
    certain : a suspect that chance makes with no more than this probability is found though it does not pay its price.
        Of 198 persons and rigs with nothing missing the least probability was 0.0013 (tests/examination, "null").
    refuted : likewise of one that the held-out data speak against, at the usual level of a test.
    nulls : simulated recordings without the finding, from which its probability by chance is read.
    """

    accept: float = 3.0
    doubt: float = 10.0
    odds: dict[str, float] = field(
        default_factory=lambda: {
            "state": 0.0,
            "geometry": 4.0,
            "sensor": 4.0,
            "clock": 10.0,
            "coulomb_friction": 4.0,
            "joint_drag": 8.0,
            "cubic_damping": 8.0,
            "link_drag": 8.0,
            "slow_body_drag": 8.0,
            "body_friction": 4.0,
            "gyroscopic_force": 8.0,
            "sensor_drift": 4.0,
            "inputs_lag": 10.0,
            "rotor_inertia": 10.0,
            "late_feedback": 10.0,
            "late_sensing": 10.0,
            "feedback_lag": 10.0,
            "late_correction": 10.0,
            "late_observation": 10.0,
            "correction_lag": 10.0,
        }
    )
    braking: float = 8.0
    never: float = 1000.0
    least_part: float = 0.1
    skew: float = 0.05
    harmonics: int = 6
    equivalent: float = 12.0
    most_effects: int = 8
    quiet: float = 2.0
    remainder: float = 4.5
    located: float = 2.0
    far: float = 5.0
    sensors: float = 2**0.5
    sure: float = 2.0
    apart: float = 3.0
    confirm: float = 0.95
    block: float = BLOCK
    fewest_blocks: int = 6
    chance: float = 0.5
    certain: float = 5e-4
    refuted: float = 0.05
    nulls: int = 19

    # ---- how much work a search does; not studied: more of it costs time ------------------------------
    worth_refitting: float = 8.0
    always_refitted: int = 6
    refitted: int = 20
    converged: int = 5
    refitted_later: int = 10
    converged_later: int = 3
    near: float = 50.0
    near_share: float = 0.1
    rivals: int = 5
    rivals_on_halves: int = 3
    beam: int = 3
    beam_share: float = 0.3


POLICY = Policy()
