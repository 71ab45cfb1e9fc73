"""Arguments of public functions and words on the command line: a result, or one sentence of symid's own."""

import json
import shutil
from importlib import import_module

import numpy as np
import pytest
from conftest import ROOT, pendulum, pendulum_recording
from fuzz import few, odd, of_json, spoiled, told
from hypothesis import given, settings, strategies as st

import symid as si
from symid import fetch
from symid.cli import main
from symid.conceal.setup import setup_from_facts
from symid.errors import DiagnosisError
from symid.recording import fill_gaps, joint_angles, lowpass, resample, smooth_states, unwrap

plain = st.one_of(st.none(), st.booleans(), st.integers(), st.floats(), st.just(10**400), st.just(-(10**400)))
fewer = settings(few, max_examples=max(few.max_examples // 4, 1))
"""Of what takes longer."""


@pytest.fixture(scope="module")
def solution():
    return si.Identification(pendulum(), pendulum_recording(duration=2.0, noise=0.01)).solve()


@fewer
@given(st.data())
def test_arguments_of_analyses(solution, tmp_path_factory, data):
    """One of them is odd; what costs many solves is not asked for."""
    value = data.draw(odd)
    if isinstance(value, (int, float)) and not isinstance(value, bool) and 0 < value < 1e6:
        value = -value
    name = data.draw(st.sampled_from(["damping", "rate", ""]))
    calls = {
        "profile": lambda: si.profile(solution, name, [value, 0.4]),
        "profile of": lambda: si.profile(solution, value, [0.4]),
        "region": lambda: si.likelihood_region(solution, "damping", value),
        "region points": lambda: si.likelihood_region(solution, "damping", "damping", value),
        "bootstrap": lambda: si.bootstrap(solution, value, on_finished=None),
        "bootstrap seed": lambda: si.bootstrap(solution, 1, seed=value, on_finished=None),
        "bootstrap over": lambda: si.bootstrap(solution, 1, over=value, on_finished=None),
        "bootstrap block": lambda: si.bootstrap(solution, 1, block=value, on_finished=None),
        "folds": lambda: si.cross_validate(solution, value),
        "compare": lambda: si.compare(value),
        "compare held": lambda: si.compare({"one": solution, "two": solution}, held_out=value),
        "stability": lambda: si.stability(solution, held_out=value),
        "stability which": lambda: si.stability(solution, which=value),
        "stability window": lambda: si.stability(solution, window=value),
        "stability grid": lambda: si.stability(solution, per_state=value),
        "stability step": lambda: si.stability(solution, held_out=(0, 1), step=value),
        "stability threads": lambda: si.stability(solution, held_out=(0, 1), threads=value),
        "stability of": lambda: si.stability_of(value, solution.values, RECORDING, window=(0, 1)),
        "stability values": lambda: si.stability_of(pendulum(), value, RECORDING, window=(0, 0.3), per_state=2),
        "stability recording": lambda: si.stability_of(pendulum(), solution.values, value, window=(0, 1)),
        "study": lambda: si.Study(value),
        "study of": lambda: si.Study({name: value}),
        "study executor": lambda: si.Study({name: si.Solve(PROBLEM)}).run(value) if value is not None else None,
        "solve seed": lambda: si.Solve(PROBLEM, "random", seed=value).key,
        "solve options": lambda: si.Solve(PROBLEM, options=value).key,
        "solve start": lambda: si.Identification(pendulum(), RECORDING, backend="numpy").start(value),
        "suspects": lambda: si.suspects(value),
        "term": lambda: pendulum().with_term(si.Term(value, name)),
        "read_case": lambda: si.read_case(value),
        "diagnose_case": lambda: si.diagnose_case(value),
        "channel": lambda: RECORDING[value],
        "part": lambda: pendulum()[value],
        "rename": lambda: RECORDING.rename({"angle": value}),
        "with_channel": lambda: RECORDING.with_channel("q", value, "m"),
        "with_channel unit": lambda: RECORDING.with_channel("q", RECORDING["angle"], value),
        "with_channel noise": lambda: RECORDING.with_channel("q", RECORDING["angle"], "m", noise=value),
        "lowpass": lambda: lowpass(RECORDING, value),
        "lowpass order": lambda: lowpass(RECORDING, 5.0, order=value),
        "smooth_states": lambda: smooth_states(RECORDING, "angle", noise=value),
        "unwrap": lambda: unwrap(RECORDING, "angle", period=value),
        "table of a rig": lambda: si.mechanics.rig_model(value),
        "lags": lambda: si.mechanics.DelayedFullState(lags=value),
        "hidden": lambda: si.mechanics.NeuralNetwork(hidden=value),
        "chain": lambda: si.mechanics.Chain(value),
        "uncertainty": lambda: si.uncertainty(solution, value),
        "uncertainty of": lambda: si.uncertainty(value),
        "identifiability": lambda: si.identifiability(value),
        "identifiability seed": lambda: si.identifiability(pendulum(), value),
        "fit_on": lambda: solution.fit_on(value),
        "with_errors": lambda: solution.with_errors(value).parameters,
        "export": lambda: si.export(value, tmp_path_factory.mktemp("e") / "m.c"),
        "export path": lambda: si.export(solution, tmp_path_factory.mktemp("e") / f"m.{name}"),
        "table": lambda: si.table(pendulum().angle, value, [0.0, 1.0, 4.0]),
        "table values": lambda: si.table(pendulum().angle, [0.0, 1.0, 2.0], value),
        "design": lambda: si.design(pendulum(), {"damping": 0.4}, duration=value, noise={"measured": 1}, rate=1),
        "design values": lambda: si.design(pendulum(), value, duration=2, noise={"measured": 1}, rate=1),
        "design noise": lambda: si.design(pendulum(), {"damping": 0.4}, duration=2, noise=value, rate=1),
        "fill_gaps": lambda: fill_gaps(solution.problem.recordings[0], value),
        "resample": lambda: resample(solution.problem.recordings[0], value),
        "joint_angles": lambda: joint_angles(solution.problem.recordings[0], value, "b", "c"),
        "pickled": lambda: solution.problem.load(value),
    }
    told(calls[data.draw(st.sampled_from(sorted(calls)))])


class Reached(DiagnosisError):
    """The arguments were taken."""


def reached(*_, **__):
    raise Reached("here")


ARGUMENTS = ("subject", "recording", "fit_window", "held_out", "sensor_noise", "segment_length", "driven", "settling")
ARGUMENTS += ("filter", "start", "threads", "suspects")


@fewer
@given(st.sampled_from(ARGUMENTS), odd)
def test_arguments_of_a_diagnosis(name, value):
    """Up to the first fit."""
    recording = pendulum_recording(duration=4.0, noise=0.01)
    arguments = {"subject": pendulum(), "recording": recording, "fit_window": (0.0, 3.0), "held_out": (3.0, 4.0)}
    if name == "threads" and isinstance(value, int) and 0 < value:
        return

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(import_module("symid.discrepancy.explained"), "fitted_as_given", reached)
        told(si.diagnose, **arguments | {name: value})


CASES = [json.loads((ROOT / "data" / "concealed" / "cases" / n / "case.json").read_text()) for n in ("r01", "s01")]


@few
@given(st.sampled_from(CASES).flatmap(spoiled))
def test_facts_that_are_imitated(content):
    told(setup_from_facts, content, np.random.default_rng(0))


@few
@given(st.one_of(of_json, st.dictionaries(st.sampled_from(["a.txt", "../b", "/etc/passwd", "x", ""]), of_json)))
def test_the_checksums_of_a_download(tmp_path_factory, content):
    folder = tmp_path_factory.mktemp("raw")
    (folder / "a.txt").write_text("1")
    (folder / fetch.LOCK).write_text(json.dumps(content))

    def nothing(*_):
        raise AssertionError("asked the network")

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(fetch, "_listed", lambda place: [])
        patch.setattr(fetch, "_retrieved", nothing)
        told(fetch.standing_raw, folder)


@few
@given(st.lists(st.binary(max_size=60), min_size=3, max_size=3))
def test_tables_of_the_article(tmp_path, contents):
    files = [tmp_path / name for name in ("a.txt", "b.txt", "c.txt")]
    for file, content in zip(files, contents, strict=True):
        file.write_bytes(content)
    told(fetch.prepared, *files)


RECORDING = pendulum_recording(duration=0.3)
PROBLEM = si.Identification(pendulum(), RECORDING)
OPTIONS = ("window", "scheme", "episodes", "weights", "noise", "loss", "per_recording", "backend", "refine", "ridge")


@few
@given(st.sampled_from(["model", "recordings", *OPTIONS, "ridge_about"]), odd)
def test_arguments_of_an_identification(name, value):
    given = {"model": pendulum(), "recordings": RECORDING, "backend": "numpy"} | {name: value}
    told(lambda: si.Identification(**given).transcription)


@few
@given(st.sampled_from(["starts", "seed", "check", "time_limit_s", "max_iterations", "options"]), odd)
def test_arguments_of_a_solve(tmp_path, monkeypatch, name, value):
    monkeypatch.chdir(tmp_path)
    if not (name == "starts" and isinstance(value, (int, float)) and value > 3):  # that many are solved
        told(lambda: PROBLEM.solve(**{"max_iterations": 1, "start": "random", "check": False} | {name: value}))


@few
@given(st.data())
def test_arguments_of_other_calls(data):
    value, more = data.draw(plain), data.draw(plain)
    act = data.draw(
        st.sampled_from(
            [
                lambda: si.Episodes(value, amplitude=more),
                lambda: si.Episodes(2, torque=value, seed=more),
                lambda: si.Episodes(2, push=1.0, seed=value, shared_initial_state=more),
                lambda: si.Free(value, more),
                lambda: si.Normal(value, more),
                lambda: si.LogNormal(value, more),
                lambda: si.Optimization(pendulum(), duration=value, nodes=more),
                lambda: si.Recording(value, RECORDING.time, {"a": more}, {"a": "m"}),
                lambda: si.Recording("r", value, {"a": RECORDING["angle"]}, {"a": more}),
                lambda: RECORDING.window(value, more),
                lambda: pendulum().with_constants(stiffness=value),
                lambda: pendulum().with_bounds(damping=value),
                lambda: pendulum().fixed(damping=value),
                lambda: pendulum().free(stiffness=value),
                lambda: si.LocalPool(value),
                lambda: si.mechanics.Chain.uniform(value, more),
                lambda: si.mechanics.rig_model(value, more),
            ]
        )
    )
    told(act, also=(TypeError,))


WORDS = st.one_of(
    st.sampled_from(
        ["r.csv", "--body", "b.json", "--controller", "pd", "fpd", "--window", "0", "1", "-1", "nan", "--starts"]
        + ["--jobs", "--json", "/nope/x", "--noise", "--episodes", "--scheme", "--rig", "--held-out", "--columns"]
        + ["--", "-", "", "--help", "--allow-gaps", "--parameters", "1e99", "--store", "--report", "--seed", ".", "c"]
        + ["--filter", "--friction", "joint1", "--system", "case.json", "--effect", "extra_mass@trunk", "x@y:z=1"]
        + ["--count", "0", "--folder", "zsh", "standing", "growth", "--growth", "--formulations", "x.xlsx", "m.toml"]
        + ["--cluster", "tcp://nobody:1", "--duration", "--rate", "--time-limit", "--max-iterations", "--distribution"]
    ),
    st.text(max_size=5),
)
COMMANDS = ["identify", "simulate", "diagnose", "conceal", "fetch", "bench", "reproduce", "completion", "report", ""]


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """With files that are there and right, so that words get beyond the first look."""
    data = ROOT / "data"
    shutil.copy(data / "standing_synthetic" / "body.json", tmp_path / "b.json")
    rows = (data / "standing_synthetic" / "recording.csv").read_text().splitlines()[:60]
    (tmp_path / "r.csv").write_text("\n".join(rows))
    (tmp_path / "x.xlsx").write_bytes(b"PK")
    (tmp_path / "m.toml").write_text('ankle_angle_deg = "nothing"')
    (tmp_path / "case.json").write_text(json.dumps(CASES[1]))
    (tmp_path / "c").mkdir()
    (tmp_path / "c" / "case.json").write_text(json.dumps(CASES[1]))
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("SYMID_STANDING", str(tmp_path / "none"))
    takes_long = {
        "symid.discrepancy.explained": ["fitted_as_given"],
        "symid.conceal": ["draw_case"],
        "symid.cli.bench": ["_solves", "_part", "_load", "_growth", "_formulations"],
        "symid.fetch": ["_downloaded", "_listed"],
    }
    for module, names in takes_long.items():
        for name in names:
            monkeypatch.setattr(import_module(module), name, reached)


@few
@given(st.sampled_from(COMMANDS), st.lists(WORDS, max_size=8))
def test_words_on_the_command_line(folder, command, words):
    try:
        assert told(main, [command, *words] if command else words) in (0, 1, 2)
    except SystemExit as done:
        assert done.code in (0, 2)
    except KeyboardInterrupt:
        pytest.fail("a command that was not interrupted says so")
