"""Regions, cross-validation and the bootstrap over recordings against closed forms and against what is true."""

import numpy as np
import pytest
from conftest import pendulum, pendulum_recording

import symid as si
from symid.errors import ModelError


def lines(count: int = 1, seed: int = 0) -> tuple[si.Model, list[si.Recording]]:
    """y = a + b t with white noise, where everything is known in closed form."""
    m, rng, time = si.Model("line"), np.random.default_rng(seed), np.arange(0, 4, 0.05)
    m.a, m.b = si.Parameter(unit="m", bounds=(-9, 9)), si.Parameter(unit="m/s", bounds=(-9, 9))
    m.y = si.Output(m.a + m.b * m.time, unit="m")
    data = [1 + rng.normal(0, 0.3) + 0.5 * time + 0.1 * rng.standard_normal(80) for _ in range(count)]
    return m, [si.Recording(f"run {k}", time, {"y": y}, {"y": "m"}) for k, y in enumerate(data)]


def test_a_region_of_a_linear_model_is_its_ellipse():
    m, (recording,) = lines()
    solution = si.Identification(m, recording).solve(options={"tol": 1e-10}).with_errors("white")
    region = si.likelihood_region(solution, "a", "b", points=5)
    information = np.linalg.inv(solution.covariance.loc[["a", "b"], ["a", "b"]].to_numpy())
    for a in region.index:
        for b in region.columns:
            d = np.array([a - solution.values["a"], b - solution.values["b"]])
            assert region.loc[a, b] == pytest.approx(d @ information @ d, rel=1e-4, abs=1e-6)
    from symid.plots import plot_profile, plot_region

    assert plot_region(region).png().startswith(b"\x89PNG")
    assert plot_profile(si.profile(solution, "a")).png().startswith(b"\x89PNG")
    with pytest.raises(ModelError, match="no parameter 'c'"):
        si.likelihood_region(solution, "a", "c")


@pytest.mark.slow
def test_recordings_that_differ_are_counted_by_a_bootstrap_over_them():
    m, recordings = lines(count=12)
    solution = si.Identification(m, recordings).solve()
    drawn = si.bootstrap(solution, 60, over="recordings", on_finished=None)
    own = np.array([si.Identification(m, r).solve(check=False).values["a"] for r in recordings])
    assert drawn.parameters["std_error"]["a"] == pytest.approx(own.std() / np.sqrt(12), rel=0.35)
    assert drawn.parameters["std_error"]["a"] > 2 * solution.with_errors("white").parameters["std_error"]["a"]
    with pytest.raises(ModelError, match="1 recordings cannot be drawn from; give at least 4"):
        si.bootstrap(si.Identification(m, recordings[0]).solve(check=False), 5, over="recordings")
    with pytest.raises(ModelError, match="known are 'blocks', 'recordings'"):
        si.bootstrap(solution, 5, over="people")


@pytest.mark.slow
def test_a_model_is_judged_on_blocks_and_recordings_that_it_did_not_see():
    recording = pendulum_recording(duration=6, noise=0.01)
    right = si.Identification(pendulum(), recording).solve()
    wrong = si.Identification(pendulum().with_constants(stiffness=3.0), recording).solve()
    seen, unseen = si.cross_validate(right, folds=3), si.cross_validate(wrong, folds=3)
    assert seen["held_out_rms"].tolist() == pytest.approx([0.01] * 3, rel=0.2)
    assert (unseen["held_out_rms"] > 2 * seen["held_out_rms"]).all()
    assert seen["end_s"].tolist()[:-1] == seen["start_s"].tolist()[1:] and (seen["damping"] - 0.4).abs().max() < 0.02
    several = [pendulum_recording(duration=2, noise=0.01, seed=k) for k in range(2)]
    assert len(si.cross_validate(si.Identification(pendulum(), several).solve())) == 2
    with pytest.raises(ModelError, match="too short; take fewer"):
        si.cross_validate(right, folds=10_000)
