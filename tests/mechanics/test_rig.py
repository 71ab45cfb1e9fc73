"""Rigs that nobody prepared a case for: their models, their recordings, what is asked if a user leaves things out."""

import json
from importlib import import_module

import numpy as np
import pytest
from rigs import SINGLE

from symid.cases import diagnose_case, read_case, rig_case
from symid.cases.case import parts_of, with_base_acceleration
from symid.cli import main
from symid.discrepancy import Suspect, diagnose, suspects
from symid.discrepancy.locate.projection import Projection
from symid.discrepancy.name.trial.comb import comb
from symid.errors import DiagnosisError, SymidError
from symid.estimation.fitting.cold_start import fit_model
from symid.estimation.signals.data import Data
from symid.estimation.signals.segment import Segment
from symid.estimation.signals.swings import piece_length
from symid.estimation.signals.windows import segments_of
from symid.mechanics import LIBRARY, rig_model
from symid.recording import Recording, read_recording
from symid.simulation import simulator

STEP = 2 * np.pi / 8192


def swinging(folder, seconds=32.0, piece=4.0, pieces_held_out=2, rate=100.0):
    """A pendulum with dry friction, its encoder's steps, in segments; the files of a rig."""
    term = LIBRARY["coulomb_friction"].at("joint1")
    time = np.arange(0, seconds, 1 / rate)
    run = simulator(rig_model(SINGLE).with_term(term)).simulate(
        {term.parameter_name("torque_Nm"): 1e-3}, np.array([0.8, 0.0]), time, substeps=4
    )
    angle = np.round(run.y[:, 0] / STEP) * STEP
    lines, per = ["split,segment,time_s,link1_angle_rad"], int(piece * rate)
    for k in range(len(time) // per):
        label = "held_out" if k >= len(time) // per - pieces_held_out else "fit"
        lines += [
            f"{label},{k},{t:.2f},{y:.9f}"
            for t, y in zip(time[k * per : (k + 1) * per], angle[k * per : (k + 1) * per], strict=True)
        ]
    (folder / "recording.csv").write_text("\n".join(lines) + "\n")
    (folder / "rig.json").write_text(json.dumps({"source": "made", "parameters": SINGLE | {"k1_N_m_s_rad": 1e-4}}))
    return folder


@pytest.fixture(scope="module")
def rig(tmp_path_factory):
    return swinging(tmp_path_factory.mktemp("rig"))


@pytest.fixture
def quick(monkeypatch):
    monkeypatch.setattr(
        import_module("symid.discrepancy.explained"),
        "suspects_of",
        lambda model, sizes: [
            s for s in suspects(model, sizes) if s.term.name in ("coulomb_friction", "sensor_offset")
        ],
    )


# ---- recordings ------------------------------------------------------------------------------
def test_labels_are_found_and_refused_by_name(rig):
    recording = read_recording(rig / "recording.csv")
    assert parts_of(recording, None, None) == ("fit", "held_out")
    assert parts_of(recording, (0.0, 8.0), None) == ((0.0, 8.0), None)
    with pytest.raises(DiagnosisError, match="labels of the column split: fit, held_out"):
        parts_of(recording, "fitting", None)
    plain = Recording("plain", recording.time, dict(recording.channels), dict(recording.units))
    with pytest.raises(DiagnosisError, match="it has no column split; give a window"):
        parts_of(plain, None, None)


def test_windows_of_time_go_through_segments_and_stop_at_their_ends(rig):
    recording, model = read_recording(rig / "recording.csv"), rig_model(SINGLE)
    pieces = segments_of(model, recording, (2.0, 9.0))
    assert [(e.time[0], e.time[-1]) for e in pieces] == [(2.0, 3.99), (4.0, 7.99), (8.0, 9.0)]
    with pytest.raises(DiagnosisError, match="no segment of recording has 8 samples"):
        segments_of(model, recording, (100.0, 110.0))


def test_time_that_begins_anew_asks_for_labels(rig):
    r = read_recording(rig / "recording.csv")
    again = Recording("again", r.time % 4.0, dict(r.channels), dict(r.units), segment=r.segment, split=r.split)
    with pytest.raises(DiagnosisError, match="time begins anew .* column split instead: fit, held_out"):
        segments_of(rig_model(SINGLE), again, (0.0, 3.0))
    assert len(segments_of(rig_model(SINGLE), again, "fit")) == 6


def test_long_segments_are_cut_and_many_samples_thinned():
    time = np.arange(0, 60, 0.001)
    r = Recording("long", time, {"link1_angle": np.sin(2 * np.pi * time)}, {"link1_angle": "rad"})
    model = rig_model(SINGLE)
    whole = segments_of(model, r, (0.0, 60.0))
    assert piece_length(whole) == pytest.approx(5.0, rel=0.05)
    data = Data(segments_of(model, r, (0.0, 60.0), 5.0), np.array([1e-3]), driven=False)
    thin = data.thinned()
    assert len(thin.segments) == 12 and 6000 <= thin.samples <= 8000 + 12
    assert Data(whole, np.array([1e-3]), driven=True).thinned().samples == 60000


def test_an_acceleration_of_the_base_is_taken_from_its_position():
    time = np.arange(0, 4, 0.01)
    r = Recording(
        "cart",
        time,
        {"link1_angle": time, "cart_position": 0.1 * np.sin(3 * time)},
        {"link1_angle": "rad", "cart_position": "m"},
    )
    a = with_base_acceleration(r)["cart_acceleration"]
    assert np.abs(a + 0.9 * np.sin(3 * time))[20:-20].max() < 0.02
    still = Recording(
        "cart",
        time,
        {"link1_angle": time, "cart_acceleration": 0 * time},
        {"link1_angle": "rad", "cart_acceleration": "m/s^2"},
    )
    assert set(with_base_acceleration(still).channels) == {"link1_angle"}


# ---- the whole way ---------------------------------------------------------------------------
def test_a_rig_from_the_command_line(rig, tmp_path, capsys, quick):
    out = tmp_path / "a.json"
    assert (
        main(
            [
                "diagnose",
                str(rig / "recording.csv"),
                "--rig",
                str(rig / "rig.json"),
                "--threads",
                "1",
                "--json",
                str(out),
            ]
        )
        == 0
    )
    said = capsys.readouterr().out
    answer = json.loads(out.read_text())
    assert (answer["effects"][0]["name"], answer["effects"][0]["location"]) == ("coulomb_friction", "joint1")
    assert answer["effects"][0]["parameters"]["torque_Nm"]["value"] == pytest.approx(1e-3, rel=0.05)
    assert (
        "Joint 1 is held back by a dry friction" in said
        and "Energy is lost at joint 1" in said
        and "sensors' noise was not stated" in said
    )
    fit = answer["fit"]
    assert len(fit["baseline"]["heldout_rms_rad_of_segments"]) == 2
    assert fit["augmented"]["heldout_rms_rad"] < 0.1 * fit["baseline"]["heldout_rms_rad"] and answer["confirmed"]
    assert not answer["recording"]["sensor_noise_stated"]
    assert 0.5 * STEP / 12**0.5 < answer["recording"]["sensor_noise"]["link1_angle"] < 2 * STEP / 12**0.5
    assert [h["name"] for h in answer["halves"]] == ["coulomb_friction"] and answer["halves"][0]["survives"]


@pytest.mark.slow
@pytest.mark.compiled
def test_a_case_directory_may_leave_out_what_can_be_told(rig, quick):
    (rig / "case.json").write_text(json.dumps({"system": "rig", "parameters": SINGLE}))
    case = read_case(rig)
    assert (case.fit_window, case.held_out_window, case.sensor_noise) == ("fit", "held_out", None)
    finding = diagnose_case(case, threads=1)
    assert finding.effects[0].name == "coulomb_friction"
    (rig / "case.json").write_text(
        json.dumps({"system": "rig", "parameters": SINGLE, "fit_window_s": [0, 16], "heldout_window_s": [16, 32]})
    )
    assert len(diagnose_case(read_case(rig), suspects=[], threads=1).runs["baseline_heldout"].lengths) == 4


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"fit_window_s": [5, 1]}, "fit_window_s must be a start and a later end"),
        ({"angle_noise_rms_rad_approx": -1}, "above zero"),
        ({"segment_s": "four"}, "segment_s must be a number above zero"),
        ({"parameters": {"m1_kg": 1}}, "'a1' .* is missing"),
    ],
)
def test_case_json_of_a_rig_is_checked(rig, tmp_path, change, message):
    (tmp_path / "recording.csv").write_text((rig / "recording.csv").read_text())
    (tmp_path / "case.json").write_text(json.dumps({"system": "rig", "parameters": SINGLE} | change))
    with pytest.raises(SymidError, match=message):
        read_case(tmp_path)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--body", "b.json"], "--body describes a standing person"),
        (["--window", "5"], "--window 5 is no window"),
        (["--window", "9", "5"], "--window 9 5 is no window"),
        (["--window", "fitting"], "no segment is labelled 'fitting'"),
        (["--friction", "joint7"], "no such joint"),
        (["--sensor-noise", "0"], "--sensor-noise 0 is not possible"),
        (["--window", "0", "9", "--held-out-csv", "a.csv"], "--held-out-csv needs a held-out window"),
    ],
)
def test_bad_input_for_a_rig_ends_in_one_sentence(rig, capsys, arguments, message):
    assert main(["diagnose", str(rig / "recording.csv"), "--rig", str(rig / "rig.json"), *arguments]) == 2
    out, err = capsys.readouterr()
    assert out == "" and err.startswith("symid: error: ") and message in err and err.count("\n") == 1


def losing():
    """A pendulum in six pieces with several losses at once and an encoder, as data of a rig."""
    terms = [LIBRARY["viscous_friction"].at("joint1"), LIBRARY["coulomb_friction"].at("joint1")]
    model, values = (
        rig_model(SINGLE),
        {terms[0].parameter_name("coefficient_Nms_rad"): 1e-4, terms[1].parameter_name("torque_Nm"): 6e-4},
    )
    for t in terms:
        model = model.with_term(t)
    time, rng = np.arange(0, 32, 0.01), np.random.default_rng(1)
    y = simulator(model).simulate(values, np.array([1.1, 0.0]), time, substeps=4).y[:, 0] + 2e-4 * rng.standard_normal(
        len(time)
    )
    return Recording(
        "losing",
        time,
        {"link1_angle": y},
        {"link1_angle": "rad"},
        segment=(time // 4).astype(int),
        split=np.where(time < 24, "fit", "held_out"),
    )


@pytest.mark.slow
@pytest.mark.compiled
def test_several_losses_are_told_apart_and_no_clock_is_needed():
    recording, model = losing(), rig_model(SINGLE)
    names = ("viscous_friction", "coulomb_friction", "quadratic_drag", "periodic_torque", "sensor_offset")
    finding = diagnose(
        model,
        recording,
        fit_window="fit",
        held_out="held_out",
        driven=False,
        threads=1,
        suspects=[s for s in suspects(model) if s.term.name in names],
    )
    assert finding.verdict == "missing_physics" and finding.confirmed
    found = {e.name: next(iter(e.parameters.values())) for e in finding.effects}
    assert set(found) == {"viscous_friction", "coulomb_friction"}
    for name, true in (("viscous_friction", 1e-4), ("coulomb_friction", 6e-4)):
        assert abs(found[name][0] - true) < 4 * found[name][1] < 0.1 * true
    assert "Energy is lost at joint 1, and one law is not enough" in finding.words
    assert all(not s.reason for s in finding.halves)


def test_a_frequency_is_found_between_the_simulated_ones():
    """Pieces four seconds long, twenty apart: a fine grid of frequencies from a coarse one."""
    term, model = LIBRARY["periodic_torque"].at("joint1"), rig_model(SINGLE)
    true, sim = {"amplitude_Nm": 2e-4, "frequency_Hz": 0.6437, "phase_rad": 0.4}, simulator(model.with_term(term))
    segments = []
    for k in range(6):
        time = np.arange(0, 4, 0.02) + 20 * k
        run = sim.simulate(
            {term.parameter_name(q): v for q, v in true.items()}, np.array([0.5 - 0.05 * k, 0.0]), time, substeps=4
        )
        segments.append(Segment(time, run.y + 2e-4 * np.random.default_rng(k).standard_normal(run.y.shape), {}))
    data = Data(tuple(segments), np.array([2e-4]), driven=False)
    screen, suspect = Projection(fit_model(model, data), data), Suspect(term)
    best = comb(screen, suspect, sim, 3.0)[0]
    assert best["frequency_Hz"] == pytest.approx(true["frequency_Hz"], abs=0.006)


def test_a_rig_as_python(rig):
    case = rig_case(rig / "recording.csv", rig / "rig.json", friction=["joint1"])
    assert case.model.parameters and case.name == "recording" and not case.driven
