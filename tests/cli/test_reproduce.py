"""The article's cases, their table, and the command that runs them."""

import json

import numpy as np
import pandas as pd
import pytest

from symid.cli import main
from symid.errors import SymidError
from symid.reproduce import CASES, Reproduction, comparison, late_feedback, late_feedback_text, notes
from symid.reproduce.article import chosen
from symid.reproduce.run import Finding, problem


def test_there_are_the_twelve_cases_of_the_article():
    assert list(CASES) == [
        "PD-1",
        "PD-2",
        "PD-3",
        "PD-4",
        "FPD-1",
        "FPD-2",
        "FPD-3",
        "FPD-4",
        "NN-1",
        "NN-6",
        "NN-8",
        "NN-10",
    ]
    assert all(len(c.rms_deg) == 10 and list(c.rms_deg) == sorted(c.rms_deg) for c in CASES.values())


def test_facts_are_those_of_the_reference(shared):
    reference = json.loads((shared / "reference" / "paper_results.json").read_text())["results"]
    for row in reference:
        case = CASES[f"{row['controller']}-{row['episodes']}"]
        assert case.rms_deg == tuple(row["rms_deg_sorted"])
        assert (case.eigenvalue_percent, case.forward_percent) == (
            row["eigenvalue_stable_percent"],
            row["forward_stable_percent"],
        )
        assert {k: v[0] for k, v in case.gains.items()} == row.get("gains_mean", {})


def test_cases_are_chosen_by_name_or_controller():
    assert [c.name for c in chosen(["nn", "PD-3", "NN-6"])] == ["NN-1", "NN-6", "NN-8", "NN-10", "PD-3"]
    assert len(chosen(None)) == 12
    with pytest.raises(SymidError, match="no case 'PD-7'.*PD-"):
        chosen(["PD-7"])


def test_gains_of_the_article_are_parameters_of_the_models(shared):
    body, recording = _material(shared)
    for case in CASES.values():
        one = problem(case, body, recording, draw=3)
        assert set(case.gains) <= set(one.model.parameters)
        assert one.episodes.count == case.episodes and (case.episodes == 1 or one.episodes.seed == 3)


def _material(shared):
    from symid import mechanics
    from symid.recording import read_recording

    folder = shared / "recordings" / "standing_subject05"
    return mechanics.DoubleLinkPendulum.from_json(folder / "body.json"), read_recording(folder / "recording_50hz.csv")


class _Best:
    """As much of a Solution as a table reads."""

    def __init__(self, model, values):
        self.model, self.values, self.solved, self.fit = model, values, True, {"rms_deg": {"all": 1.1}}


class _Stability:
    eigenvalue_percent, forward_percent = 70.0, 50.0


def test_every_number_stands_beside_the_articles(shared):
    case = CASES["PD-3"]
    model = problem(case, *_material(shared)).model
    best = _Best(model, {k: mean + 2 * spread for k, (mean, spread) in case.gains.items()})
    starts = pd.DataFrame(
        {"solved": [True, False, True, True], "rms_deg": [1.1, np.nan, 1.2, 1.105]}
        | {k: [v, v, 2 * v, case.gains[k][0]] for k, v in best.values.items()}
    )
    table = comparison(Reproduction((Finding(case, 4, starts, best, _Stability()),), {}, "multisine"))
    assert np.allclose(table["deviation"].dropna(), (table["here"] - table["article"]).dropna())
    gains = table[table["quantity"].isin(case.gains)]
    # The first and the last start are good ones, the third is not.
    assert np.allclose(gains["deviation"] / gains["spread"], 1) and set(gains["where"]) == {"table 1"}
    assert np.allclose(gains["best"], list(best.values.values())) and np.allclose(gains["sd"], gains["spread"])
    here = table.set_index("quantity")["here"]
    assert here["solved starts"] == pytest.approx(75) and here["median rms of the solved starts"] == pytest.approx(
        1.105
    )
    assert set(table["noise_seed"]) == {4} and "table 3" in set(table["where"])


@pytest.mark.parametrize(
    ("distribution", "words"),
    [
        ("multisine", "used here: orthogonal random-phase multisines"),
        ("uniform", "used here: uniform\n"),
        ("gaussian", "used here: Gaussian with a standard deviation of 0.25 N m"),
    ],
)
def test_what_was_chosen_is_said(distribution, words):
    said = notes(distribution).replace("\n    ", " ")
    for word in (words, "uniform", "Gaussian", "activation", "initial state", "3.1416", "ridge"):
        assert word in said


def test_a_missing_recording_is_one_sentence(capsys, tmp_path, monkeypatch):
    monkeypatch.setattr("symid.fetch.SOURCE", "http://127.0.0.1:1/")
    assert main(["reproduce", "--recordings", str(tmp_path)]) == 2
    assert "cannot be downloaded" in capsys.readouterr().err
    assert main(["reproduce", "--starts", "0"]) == 2
    assert not list(tmp_path.iterdir())


def test_one_case_from_the_command_line(capsys, tmp_path, shared):
    folder = shared / "recordings" / "standing_subject05"
    assert main(["reproduce", "--only", "NN-1", "--quick", "--recordings", str(folder), "--output", str(tmp_path)]) == 0
    table = pd.read_csv(tmp_path / "comparison.csv").set_index("quantity")
    assert table.loc["rms of the best start", "here"] <= 0.384
    assert sorted(p.name for p in tmp_path.iterdir()) == ["comparison.csv", "figure_2.png", "starts.png"]
    assert "Figure 2" in capsys.readouterr().out


@pytest.mark.slow
def test_a_late_feedback_stands_beside_the_articles(shared):
    table = late_feedback(*_material(shared)).set_index("law")
    assert table["solved"].all() and np.isnan(table.loc["FPD", "delay_ms"])
    late = table.loc["FPD with delay"]
    assert 30 < late["delay_ms"] < 90 and 0 < late["std_error_ms"] < 15
    assert table.loc["FPD", "rms_deg"] == pytest.approx(0.955313, abs=1e-5) and late["rms_deg"] < 0.94
    assert table["held_out_rms_deg"].between(1.3, 1.4).all()
    assert "held out: 260 to 300 s" in late_feedback_text(table.reset_index())
