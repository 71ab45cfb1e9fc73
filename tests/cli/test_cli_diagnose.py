"""`symid diagnose`: words on stdout, progress on stderr, files whole or not at all, one sentence for bad input."""

import json
import re
import subprocess
import sys
from dataclasses import replace
from importlib import import_module
from importlib.metadata import version
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from browser import assert_well_shown, needs_browser
from conftest import ROOT

from symid import plots
from symid.cases import diagnose_case, read_case
from symid.cli import main
from symid.conceal import draw_case, write_case
from symid.discrepancy import suspects
from symid.discrepancy.locate.latent import latent_torques
from symid.estimation.free_run import FreeRun
from symid.mechanics import LIBRARY, DoubleLinkPendulum, FullStatePD
from symid.report import diagnosis_html, page, write_diagnosis_report
from symid.report.experiment import experiment
from symid.simulation import Simulator


@pytest.fixture(scope="module")
def folder(tmp_path_factory) -> Path:
    """A rig whose first sensor is off, as a case directory below and its sealed answer beside."""
    folder = tmp_path_factory.mktemp("concealed")
    write_case(draw_case("rig", [("sensor_offset", "sensor:link1", {"offset_rad": 0.004})], (3, 0)), folder, "r01")
    return folder


def few(case):
    """Suspects enough to be right and to be wrong."""
    return [s for s in suspects(case.model) if s.term.name in ("sensor_offset", "gravity_tilt", "torsional_spring")]


@pytest.fixture(scope="module")
def finding(folder):
    case = read_case(folder / "cases" / "r01")
    return diagnose_case(case, suspects=few(case), threads=1)


@pytest.fixture
def quick(monkeypatch):
    """The commands with few suspects: what they do with a finding is the same."""
    monkeypatch.setattr(
        import_module("symid.discrepancy.explained"),
        "suspects_of",
        lambda model, sizes: [s for s in suspects(model, sizes) if s.term.name == "sensor_offset"],
    )


def test_a_case_directory_ends_in_words_json_report_and_prediction(folder, tmp_path, capsys, quick):
    arguments = ["--json", "r01.json", "--report", "r01.html", "--held-out-csv", "r01_heldout.csv"]
    arguments = [a if a.startswith("--") else str(tmp_path / a) for a in arguments]
    assert main(["diagnose", str(folder / "cases" / "r01"), "--threads", "1", *arguments]) == 0
    out, err = capsys.readouterr()
    assert "sensor of link 1 is off by" in out and "held-out" in out
    assert "fitted" in err and "fitted" not in out
    answer = json.loads((tmp_path / "r01.json").read_text())
    assert answer["verdict"] == "missing_physics"
    (effect,) = answer["effects"]
    assert (effect["name"], effect["location"]) == ("sensor_offset", "sensor:link1")
    offset = effect["parameters"]["offset_rad"]
    assert abs(offset["value"] - 0.004) < 4 * offset["std_error"]
    assert answer["words"] == out.strip()
    assert sorted(p.name for p in tmp_path.iterdir()) == ["r01.html", "r01.json", "r01_heldout.csv"]


def test_the_scorer_takes_the_answer_and_the_prediction(folder, finding, tmp_path, shared):
    scorer = shared / "concealed" / "score.py"
    if not scorer.is_file():
        pytest.skip(f"no scorer at {scorer}")
    finding.to_json(tmp_path / "r01.json")
    finding.held_out_csv(tmp_path / "r01_heldout.csv")
    subprocess.run(
        [
            sys.executable,
            str(scorer),
            "--truth",
            str(folder / "sealed"),
            "--cases",
            str(folder / "cases"),
            "--answers",
            str(tmp_path),
            "--json",
            str(tmp_path / "score.json"),
        ],
        check=True,
        capture_output=True,
    )
    row = json.loads((tmp_path / "score.json").read_text())["cases"][0]
    assert (
        row["top1"] == 1
        and row["location_ok"] == 1
        and row["heldout_source"] == "computed"
        and row["gap_closed"] > 0.95
    )


@pytest.mark.slow
def test_the_report_says_it_all_without_a_file_beside_it(finding, tmp_path):
    path = write_diagnosis_report(finding, tmp_path / "report.html", "My rig", {"recording": "rig.csv"})
    html = path.read_text()
    assert html.index(finding.words.split(" ")[0]) < html.index("<table")
    for part in (
        "My rig",
        "Missing physics",
        "sensor offset",
        "held-out window",
        "torsional spring",
        "rig.csv",
        "What is left",
    ):
        assert part in html
    assert html.count("data:image/png;base64,") == 8  # four figures, each for a wide and a narrow screen
    assert not re.search(r'(src|href)="(?!data:)', html)
    assert f"symid {version('symid')}" in html and "command" in html and "doi:" in html


@pytest.mark.slow
def test_the_report_on_a_model_that_is_right_shows_no_improvement(tmp_path):
    write_case(draw_case("rig", [], (1, 0)), tmp_path, "r01")
    case = read_case(tmp_path / "cases" / "r01")
    html = diagnosis_html(diagnose_case(case, suspects=few(case)[:1], threads=1))
    assert "Adequate: nothing" in html and "What is missing" not in html and "improved, RMS" not in html


@needs_browser
def test_in_a_browser_the_report_is_whole(finding, tmp_path):
    assert_well_shown(write_diagnosis_report(finding, tmp_path / "report.html"), figures=4)


def test_forces_of_one_unit_have_one_scale(finding):
    latent = latent_torques(finding.baseline, finding.runs["baseline_train"])
    details = [axes for axes in plots.plot_latent(latent).axes if axes.get_ylim()[0] < 0]
    assert len({axes.get_ylim() for axes in details}) == 1 and len(details) == len(latent)
    assert len({axes.get_ylabel().split("[")[1] for axes in plots.plot_latent(latent).axes if axes.get_ylabel()}) == 1


def test_a_fit_to_fewer_samples_leaves_the_pieces_of_the_recording_apart(finding):
    """Where a piece begins anew nothing pushes, however the fit was thinned."""
    run, fit = finding.runs["baseline_train"], finding.baseline
    thinned = replace(fit, innovations=tuple(s[::2] for s in fit.innovations))
    assert len(run.lengths) > 1
    np.testing.assert_allclose(latent_torques(thinned, run)[0].torque, latent_torques(fit, run)[0].torque)


def test_figures_show_the_numbers_of_the_finding(finding):
    (scores,) = plots.plot_scores(finding).axes
    dots = [line.get_xydata() for line in scores.lines if line.get_marker() == "o"]
    behind = [x for x, _ in sorted(np.vstack(dots), key=lambda xy: xy[1])]
    ranked = sorted((c.score for c in finding.ranking), reverse=True)[:12]
    np.testing.assert_allclose(behind, ranked[0] - np.array(ranked))
    assert "found" in [t.get_text() for t in scores.figure.legends[0].get_texts()]
    scores.figure.set_size_inches(page.NARROW, scores.figure.get_size_inches()[1])
    scores.figure.draw_without_rendering()
    boxes = [t.get_window_extent() for t in [*scores.get_xticklabels(), scores.figure._supxlabel]]
    assert all(box.x0 >= 0 and box.x1 <= scores.figure.bbox.x1 for box in boxes)
    ends = sorted((box.x0, box.x1) for box in boxes[:-1])
    assert all(a[1] < b[0] for a, b in zip(ends[:-1], ends[1:], strict=True))
    panels = plots.plot_before_after(finding).axes
    recorded, before, after = panels[0].lines
    run = finding.runs["augmented_train"]
    start = int(np.argmin(np.abs(run.time - after.get_xdata()[0])))
    np.testing.assert_allclose(after.get_ydata(), np.degrees(run.simulated[start : start + len(after.get_ydata()), 0]))
    assert [line.get_label() for line in (recorded, before, after)] == ["recorded", "model as given", "improved"]
    assert panels[0].get_ylabel().endswith("[deg]")
    held_out, other = panels[1].lines[0].get_ydata(), np.degrees(finding.runs["baseline_heldout"].recorded[:, 0])
    assert np.isin(held_out, other).all()  # in the unit of the label, which stands at the fit window alone
    assert len(plots.plot_spectra(finding).axes[0].lines) == 2


@pytest.mark.slow
def test_a_number_of_the_finding_is_the_same_wherever_the_report_says_it(finding):
    """Of a moment the words say a mean over many peaks, the fit itself one of these."""
    (effect,) = finding.named
    said = replace(effect, parameters={k: (1.5 * v, e) for k, (v, e) in effect.parameters.items()})
    html = diagnosis_html(replace(finding, effects=(said,), halves=()))
    (value,) = re.findall(r"offset ([\d.]+ ± [^<]+)<", html)
    assert f'sensor offset, the sensor of link 1: offset</small></td><td class=""></td><td class="">{value}<' in html
    assert ">on both halves<" in diagnosis_html(finding) and ">on both halves<" not in html


@pytest.mark.compiled
def test_a_hidden_torque_is_located_in_time_place_size_and_sign():
    """A push at the ankle: there, then, as large, and not at the hip."""
    case = draw_case(
        "standing", [("external_push", "ankle", {"peak_Nm": 40.0, "start_s": 20.0, "duration_s": 0.6})], (8, 0)
    )
    from symid.estimation.fitting.cold_start import fit_model
    from symid.estimation.free_run import free_run
    from symid.estimation.signals.data import Data
    from symid.estimation.signals.windows import segments_between

    s = case.setup
    segments = segments_between(s.model, case.recording.time, dict(case.recording.channels), s.windows[0])
    data = Data(segments, np.full(2, s.sensor_noise), True)
    fit = fit_model(s.model, data, dict(s.parameters))
    ankle, hip = latent_torques(fit, free_run(fit, data))
    assert (ankle.place, ankle.unit, hip.place) == ("ankle", "N*m", "hip")
    peak = int(np.argmax(np.abs(ankle.torque)))
    assert abs(ankle.time[peak] - 20.3) < 0.15
    assert 25 < ankle.torque[peak] < 55
    during = (ankle.time > 20) & (ankle.time < 20.6)
    assert ankle.torque[during].mean() == pytest.approx(20, rel=0.25)  # the mean of sin^2 is a half
    assert abs(hip.torque[during].mean()) < 0.25 * ankle.torque[during].mean()


def test_a_hidden_torque_of_a_model_with_a_delay_stays_finite():
    """The states of a delay and what it delays are nearly one: their covariance has no inverse."""
    folder = ROOT / "data" / "standing_synthetic"
    body = DoubleLinkPendulum.from_json(folder / "body.json")
    model = body.with_feedback(FullStatePD()).with_term(LIBRARY["feedback_delay"].at("global"))
    values = json.loads((folder / "truth.json").read_text())["parameters"] | {"feedback_delay_global_delay_s": 0.05}
    sway = 0.002 * np.column_stack([np.sin(0.06 * np.arange(1500)), np.cos(0.04 * np.arange(1500))])
    inputs = dict.fromkeys(model.inputs, 0.0)
    run = FreeRun(0.02 * np.arange(1500), sway, 0 * sway, np.ones(2), (1500,), mean_inputs=inputs)
    for force in latent_torques(SimpleNamespace(model=model, simulator=Simulator(model), values=values), run):
        assert np.abs(force.torque).max() < 5 and 0 < force.error.min() and force.error.max() < 5


def test_every_law_has_an_experiment_that_would_split_it_from_its_likes():
    told = {name: experiment(name) for name in LIBRARY}
    assert all(len(text) > 20 for text in told.values())
    assert told["feedback_delay"] != told["coulomb_friction"]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["nowhere"], "nowhere is no case directory, so --body, --controller, --window must be given"),
        (["nowhere.csv", "--body", "none.json", "--controller", "pd", "--window", "0", "5"], "none.json"),
        (["{case}", "--window", "0", "5"], "case.json says what --window would"),
        (["{case}", "--threads", "0"], "--threads 0 is not possible"),
        (["{case}", "--json", "no/such/folder/a.json"], "the folder no/such/folder does not exist"),
        (["nowhere.csv", "--held-out-csv", "a.csv"], "--held-out-csv needs a held-out window"),
        (["{empty}"], "is no case: it has no case.json"),
        (
            ["nowhere.csv", "--body", "b", "--controller", "pd", "--window", "0", "5", "--sensor-noise", "-1"],
            "--sensor-noise -1 is not possible",
        ),
    ],
)
def test_bad_input_ends_in_one_sentence(folder, tmp_path, capsys, arguments, message):
    places = {"case": folder / "cases" / "r01", "empty": tmp_path}
    assert main(["diagnose", *(a.format(**places) for a in arguments)]) == 2
    out, err = capsys.readouterr()
    assert out == "" and err.startswith("symid: error: ") and message in err and err.count("\n") == 1
    assert list(tmp_path.iterdir()) == []
