"""Files that a user writes, spoiled by hypothesis: one exception of symid, or a result; never another, never a hang."""

import json
import re
import shutil

import numpy as np
import pytest
from conftest import ROOT
from fuzz import few, spoiled, told
from hypothesis import given, strategies as st

from symid.cases import read_case
from symid.cli import main
from symid.errors import RecordingError, SymidError
from symid.mechanics import LIBRARY, DoubleLinkPendulum, rig_model
from symid.recording import Recording, fill_gaps, read_recording, resample

DATA = ROOT / "data"
BODY = json.loads((DATA / "standing_synthetic" / "body.json").read_text())
CASES = [json.loads((DATA / "concealed" / "cases" / name / "case.json").read_text()) for name in ("r01", "s01")]
RIG = CASES[0]["parameters"]


@few
@given(spoiled(BODY))
def test_bodies(tmp_path, content):
    (tmp_path / "body.json").write_text(json.dumps(content))
    told(DoubleLinkPendulum.from_json, tmp_path / "body.json")


@few
@given(spoiled(RIG))
def test_rigs(content):
    told(rig_model, content)


@pytest.mark.parametrize("kind", [0, 1])
def test_cases(tmp_path, kind):
    rows = "\n".join(f"{0.01 * i:.2f},{np.sin(0.1 * i):.6f},{np.cos(0.1 * i):.6f},{0.1 * (i % 7)}" for i in range(60))
    names = ("link1_angle_rad,link2_angle_rad,other_m", "ankle_angle_rad,hip_angle_rad,platform_acceleration_m_s2")[
        kind
    ]
    (tmp_path / "recording.csv").write_text(f"time_s,{names}\n{rows}\n")

    @few
    @given(spoiled(CASES[kind] | {"fit_window_s": [0, 0.4], "heldout_window_s": [0.4, 0.55]}))
    def check(content):
        (tmp_path / "case.json").write_text(json.dumps(content))
        told(read_case, tmp_path)

    check()


def plan() -> dict:
    """What `symid diagnose --experiment` writes, of the rig, with made-up numbers."""
    channels = ["link1_angle", "link2_angle"]
    model = rig_model(RIG, channels)
    answer = {
        "terms": [["viscous_friction", "joint1"]],
        "parameters": {},
        "constants": {},
        "initial_state": dict.fromkeys(model.states, 0.1),
        "random_forces": {},
        "sensor_noise": dict.fromkeys(model.outputs, 1e-3),
    }
    with_law = model.with_term(LIBRARY["viscous_friction"].at("joint1"))
    answer["parameters"] = dict.fromkeys(with_law.parameters, 0.01)
    experiment = {
        "words": "let go from 0.1 rad",
        "step_s": 0.01,
        "samples": 30,
        "recordings": 2,
        "inputs": dict.fromkeys(model.inputs, [0.0] * 30),
        "answers": {"finding": answer, "rival": answer | {"terms": []}},
    }
    return {"system": {"rig": RIG, "friction": []}, "channels": channels, "experiments": [experiment]}


def simulated(folder, content) -> int:
    (folder / "plan.json").write_text(json.dumps(content))
    return main(["simulate", str(folder / "o.csv"), "--experiment", str(folder / "plan.json")])


def test_plans_of_experiments(tmp_path):
    whole = plan()
    assert simulated(tmp_path, whole) == 0 and len(read_recording(tmp_path / "o.csv")) == 60

    @few
    @given(st.one_of(spoiled(whole), spoiled(whole["experiments"][0]).map(lambda e: whole | {"experiments": [e]})))
    def check(content):
        assert told(simulated, tmp_path, content) in (0, 2)

    check()


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"samples": 10**9}, "experiments.0..samples: must be at most 1e"),
        ({"step_s": float("nan")}, "experiments.0..step_s: must be a number, found NaN"),
        ({"inputs": {"push": [float("inf")] * 30}}, "must be a number, found Infinity"),
        ({"samples": 2, "step_s": 9e3}, "longer than 1,000,000 samples"),
        ({"inputs": {"push": [0.0]}}, "input 'push' has 1 values for 30 samples"),
        ({"answers": {}}, "the plan has no answer 'finding'; known: none"),
        ({"inputs": 3}, "experiments.0..inputs: must be a object"),
    ],
)
def test_a_plan_that_is_none_is_refused_with_its_place(tmp_path, capsys, change, said):
    whole = plan()
    content = whole | {"experiments": [whole["experiments"][0] | change]}
    assert simulated(tmp_path, content) == 2
    assert re.search(said, capsys.readouterr().err)


def test_the_noise_of_sensors_may_stand_once_for_both_answers_as_in_earlier_plans(tmp_path, capsys):
    whole = plan()
    experiment = whole["experiments"][0]
    noises = [a.pop("sensor_noise") for a in experiment["answers"].values()]
    assert simulated(tmp_path, whole) == 2
    assert "the plan has no noise of output" in capsys.readouterr().err
    experiment["sensor_noise"] = noises[0]
    assert simulated(tmp_path, whole) == 0


@pytest.mark.parametrize(
    "text",
    [
        b"\xff",
        b"[" * 100_000,
        b'{"system": NaN}',
        b'{"system": ' + b"9" * 5000 + b"}",
        b"",
        b"[]",
        b'{"system": "standing", "body": [1], "baseline": [2], "id": 3}',
    ],
)
def test_spoiled_json_ends_in_one_sentence(tmp_path, text):
    (tmp_path / "case.json").write_bytes(text)
    (tmp_path / "recording.csv").write_text("time_s,a_m\n0,1\n1,2\n")
    with pytest.raises(SymidError):
        read_case(tmp_path)
    with pytest.raises(RecordingError):
        DoubleLinkPendulum.from_json(tmp_path / "case.json")


def test_all_violations_of_a_case_are_told_at_once_with_their_places(tmp_path):
    body = CASES[1]["body"] | {"l_L_m": "long", "m_T_kg": -3}
    (tmp_path / "case.json").write_text(json.dumps(CASES[1] | {"body": body, "baseline": {"controller": 4}}))
    with pytest.raises(
        SymidError,
        match=r"baseline.controller: must be a string, found 4; body.l_L_m: .*; body.m_T_kg: must be at least 1e-09",
    ):
        read_case(tmp_path)


@pytest.mark.parametrize("key", ["m999999_kg", "m9999_kg", "m1_kg" * 200, "m" + "9" * 5000 + "_kg"])
def test_a_rig_of_a_million_links_is_refused_at_once(key):
    with pytest.raises(RecordingError):
        rig_model(RIG | {key: 1.0})


@pytest.mark.parametrize("time", [[0, 1e-9, 1e9], [0, 1e-300, 1e300], [0, 1, 1e18]])
def test_times_that_would_need_endless_memory_are_refused(time):
    recording = Recording("r", np.array(time), {"a": np.zeros(3)}, {"a": "m"})
    for verb in (lambda: fill_gaps(recording, 1e300), lambda: resample(recording, 1e12)):
        with pytest.raises(RecordingError):
            verb()


@few
@given(st.binary(max_size=200))
def test_recordings_of_any_bytes(tmp_path, content):
    for name in ("r.csv", "r.tsv", "r.trc", "r.mot"):
        (tmp_path / name).write_bytes(content)
        told(read_recording, tmp_path / name)


@pytest.mark.parametrize(
    ("stated", "said"),
    [
        ({"order": 2, "cutoff_Hz": 6.0, "zero_phase": False}, "filter.zero_phase: must be True, since only filters"),
        ({"order": 0, "cutoff_Hz": 6.0}, "filter.order: must be one of"),
        ({"order": 2}, "'cutoff_Hz' is a required property"),
        ({"order": 2, "cutoff_Hz": 400.0}, "must be below half of the"),
    ],
)
def test_a_filter_that_cannot_be_undone_is_refused(tmp_path, stated, said):
    (tmp_path / "case.json").write_text(json.dumps(CASES[1] | {"filter": stated}))
    shutil.copy(DATA / "concealed" / "cases" / "s01" / "recording.csv", tmp_path)
    with pytest.raises(SymidError, match=said):
        read_case(tmp_path)
