"""What SECURITY.md says: nothing that somebody else wrote becomes code, a hang or a foreign error."""

import ctypes
import json
import pickle
import runpy
import subprocess
from dataclasses import replace

import numpy as np
import pytest
import sympy as sm
from conftest import pendulum, pendulum_recording

import symid as si
from symid.cli import main
from symid.cli.main import BAD_INPUT
from symid.codegen import Program
from symid.codegen.source import generate
from symid.errors import ModelError, RecordingError, SolveError
from symid.files import read_json
from symid.identification.studies.store import StudyDirectory
from symid.model.show import latex_lines
from symid.plots import plot_residual_spectra
from symid.report import report_html, write_report
from symid.report.page import equations

BREAKS_OUT = (
    "a\nint planted = 1; //",
    "a\rint planted;",
    "a\\",
    "a b",
    "a;b",
    "",
    "1a",
    "a\u2028b",
    "a\0b",
    "../a",
    "a" * 9 + "*/",
)


@pytest.fixture
def planted(tmp_path):
    """Code that leaves a trace where it runs."""
    trace = tmp_path / "ran"
    yield f"__import__('pathlib').Path({str(trace)!r}).touch()"
    assert not trace.exists()


@pytest.mark.parametrize("name", BREAKS_OUT)
def test_a_name_is_an_identifier(name):
    model = si.Model("m")
    with pytest.raises(ModelError, match="cannot name a part"):
        setattr(model, name, si.Parameter(unit="m"))


@pytest.mark.parametrize("name", BREAKS_OUT)
def test_no_symbol_leaves_its_comment(name):
    """Programs are made by symid alone, and still."""
    if not name:
        return
    plain, odd = (
        generate(Program(n, (sm.Symbol(n, real=True) ** 2,), (sm.Symbol(n, real=True),))).text for n in ("x", name)
    )
    assert len(odd.split("\n")) == len(plain.split("\n"))
    code = [[line for line in text.splitlines() if not line.startswith("//")] for text in (plain, odd)]
    assert code[0] == code[1]
    assert not any(line.endswith("\\") for line in odd.split("\n") if line.startswith("//"))


def test_a_text_is_no_expression(planted):
    for declare in (
        lambda m: setattr(m, "e", si.Equation(planted)),
        lambda m: setattr(m, "y", si.Output(planted)),
        lambda m: setattr(m, "z", si.Expression(planted)),
        lambda m: m.angle + planted,
        lambda m: m.add_effort("angle", planted),
        lambda m: m.delayed(planted, 0.1),
        lambda m: m.delayed(m.angle, planted),
        lambda m: setattr(m, "c", si.Constraint(planted)),
        lambda m: setattr(m, "o", si.Objective(running=planted)),
        lambda m: setattr(m, "b", si.Boundary(initial={planted: 0})),
    ):
        with pytest.raises((ModelError, TypeError)):
            declare(pendulum())


def test_texts_of_a_model_are_escaped_in_a_notebook():
    model = pendulum()
    evil = "<script>alert(1)</script>"
    model.size = si.Parameter(unit="m", meaning=evil)
    model.extra = si.Output(model.size * model.angle)
    assert evil not in model._repr_html_()


LETTERS = (
    r"\theta_{1,2}",
    r"\bar{k}^{\mathrm{soll}}_h",
    "ü",
    "x'",
    r"\text{left hip}",
    r"w^{(1)}_{0}",
    "T_0",
    r"\dot\phi",
)
NO_LETTERS = (
    r"\href{javascript:alert(1)}{x}",
    r"\hspace{1\"onload=\"x}",
    r"\class{x\"onclick=\"y}{z}",
    r"\style{background:url(http://x)}{y}",
    r"\text{<img src=x onerror=alert(1)>}",
    r"\def\x{\x\x}\x",
    r"a\\b",
    r"\input{x}",
    "$",
    "x_",
    "^2",
    "a}{b",
    "{" * 300,
    "x\ny",
)


@pytest.mark.parametrize("latex", [*LETTERS, *NO_LETTERS])
def test_letters_of_a_part_are_only_printed(latex):
    """MathJax and MathML know links, styles, attributes and macros: a symbol has none of them."""
    model = pendulum()
    if latex in NO_LETTERS:
        with pytest.raises(ModelError, match="is no symbol"):
            model.size = si.Parameter(unit="m", latex=latex)
    else:
        model.size = si.Parameter(unit="m", latex=latex)
        model.extra = si.Expression(model.size * model.angle, unit="m")
        assert "<code>" not in equations(latex_lines(model)) and latex in model._repr_latex_()


def test_an_equation_that_cannot_be_set_is_written():
    assert equations(["x_1_2 <b>", "y &= 2"]).count("<math") == 1 == equations(["x_1_2 <b>"]).count("x_1_2 &lt;b&gt;")


@pytest.mark.parametrize("text", ["[" * 100_000, "{", "\xff", '{"a": ' + "9" * 400 + "}", "9" * 5000])
def test_json_that_is_none(tmp_path, text):
    file = tmp_path / "odd.json"
    file.write_bytes(text.encode("latin-1"))
    with pytest.raises(RecordingError, match="odd.json: is not JSON: ") as told:
        read_json(file)
    assert len(str(told.value)) < 400


@pytest.mark.parametrize(
    "content",
    [
        '{"format": "symid study 1", "solves": []}',
        '{"format": "symid study 1", "solves": {"a": 1}}',
        '{"format": "symid study 1"}',
        "[]",
        "[" * 100_000,
        '{"format": [[]], "solves": {}}',
        "\0",
    ],
)
def test_a_register_of_solves_that_is_none(tmp_path, content):
    (tmp_path / "study.json").write_text(content)
    with pytest.raises(SolveError, match="study.json .*give another directory") as told:
        StudyDirectory(tmp_path, {"a": {"key": "k"}})
    assert len(str(told.value)) < 500


def test_a_pickle_in_a_store_is_not_opened(tmp_path):
    """Its sums are right: an attacker can compute them."""
    from symid.identification.studies.store import FORMAT, _sha256, _text

    class Touch:
        def __reduce__(self):
            return subprocess.run, (["touch", str(tmp_path / "ran")],)

    np.savez(tmp_path / "k.npz", z=np.array([Touch()], dtype=object))
    (tmp_path / "k.npz").write_bytes(arrays := (tmp_path / "k.npz").read_bytes())
    content = {"format": FORMAT, "row": {}, "result": {}}
    content["sha256"] = {"content": _sha256(_text(content)), "arrays": _sha256(arrays)}
    (tmp_path / "k.json").write_text(json.dumps(content))
    (tmp_path / "study.json").write_text(json.dumps({"format": FORMAT, "solves": {"a": {"key": "k"}}}))
    assert StudyDirectory(tmp_path, {"a": {"key": "k"}}).get("k") is None
    assert not (tmp_path / "ran").exists()
    pickle.loads(pickle.dumps(Touch()))
    assert (tmp_path / "ran").exists()  # the trap works


@pytest.mark.parametrize(
    "arguments",
    [
        ["identify", "r", "--body", "b", "--episodes", "99999999999999999999"],
        ["identify", "r", "--body", "b", "--starts", "9" * 300],
        ["identify", "r", "--body", "b", "--time-limit", "nan"],
        ["identify", "r", "--body", "b", "--seed", "-1"],
        ["simulate", "o", "--body", "b", "--parameters", "p", "--duration", "1e300"],
        ["identify", "r", "--body", "b", "--noise", "inf"],
        ["simulate", "o", "--body", "b", "--parameters", "p", "--duration", "1e6", "--rate", "1e6"],
        ["conceal", "o", "--count", "9" * 20],
        ["diagnose", "r", "--threads", "9" * 20],
    ],
)
def test_numbers_beyond_all_use_are_refused_at_once(arguments, capsys):
    assert main(arguments) == BAD_INPUT
    told = capsys.readouterr().err
    assert "is not possible; give" in told or "are more than" in told
    assert len(told) < 200


@pytest.mark.parametrize(
    ("header", "words"),
    [
        (",".join(["time_s"] + [f"channel {i} without any unit at all" for i in range(40)]), "and 35 more"),
        (",".join(["time_s"] + ["a_m"] * 300), "occurs twice.*and 294 more"),
        ("time_s," + "x" * 5000, r"\.\.\."),
    ],
)
def test_a_header_with_many_mistakes_is_told_briefly(tmp_path, header, words):
    columns = header.count(",") + 1
    (tmp_path / "r.csv").write_text("\n".join([header, *(",".join([str(k)] * columns) for k in range(2))]))
    with pytest.raises(RecordingError, match=words) as told:
        si.read_recording(tmp_path / "r.csv")
    assert len(str(told.value)) < 2000


def test_many_violations_and_many_channels_are_told_briefly():
    model = si.Model("m")
    for i in range(300):
        setattr(model, f"p{i}", si.Parameter(unit="m"))
    with pytest.raises(ModelError, match="and .* more") as told:
        model.check()
    assert len(str(told.value)) < 3000 and len(told.value.violations) > 300
    time = np.arange(10.0)
    recording = si.Recording("r", time, {f"c{i}": time for i in range(500)}, {f"c{i}": "m" for i in range(500)})
    with pytest.raises(RecordingError, match="and 488 more"):
        recording["zzz"]


EVIL = 'a*\\\n/ int planted = 1; //\u2028 \\users \\N{x} ??/ """ \nimport planted\n"""'


@pytest.mark.parametrize("name", ["2 links", "double", "é", "*/ int planted; /*", "a\nint planted;", EVIL])
def test_texts_of_an_exported_model_stay_in_their_comments(tmp_path, name):
    """What compiles and runs is the same, whatever the model and its parts mean."""
    model = si.Model(name)
    model.x = si.State(unit="m", meaning=EVIL)
    model.decay = si.Constant(0.5, unit="1/s", meaning=EVIL)
    model.law = si.Equation(model.x.dot + model.decay * model.x)
    model.y = si.Output(model.x, meaning=EVIL)
    si.export(model, tmp_path / "m.c")
    si.export(model, tmp_path / "m.py")
    flags = ["-std=c99", "-trigraphs", "-Wall", "-Wno-trigraphs", "-Werror", "-shared", "-fPIC"]
    subprocess.run(["cc", *flags, "m.c", "-o", "m.so", "-lm"], cwd=tmp_path, check=True)
    assert not hasattr(ctypes.CDLL(str(tmp_path / "m.so")), "planted")
    assert runpy.run_path(str(tmp_path / "m.py"))["rates"](0.0, [2.0]) == -1.0


def test_texts_of_a_recording_are_escaped_in_a_report(tmp_path):
    """A recording is named after its file, and files may have any name."""
    evil = "<img src=x onerror=alert(1)>{{7*7}}</title><script>alert(1)</script>"
    recording = replace(pendulum_recording(duration=1.0, noise=0.01), name=evil, source=evil, history=(evil,))
    solution = si.Identification(pendulum(), recording).solve()
    write_report(solution, tmp_path / "r.html")
    for text in ((tmp_path / "r.html").read_text(), recording._repr_html_(), solution.problem._repr_html_()):
        assert "<img src=x" not in text and "<script>alert" not in text and "{{7*7}}" in text


def test_dollars_in_names_are_no_formulas_in_figures():
    """matplotlib sets what stands between two as mathematics, and refuses what it does not understand."""
    evil = r"a $\frac{$ b $x^$"
    time = np.linspace(0, 1, 60)
    recording = si.Recording(evil, time, {evil: np.cos(3 * time)}, {evil: "rad"})
    model = si.Model(evil)
    model.angle, model.rate = si.State(unit="rad"), si.State(unit="rad/s")
    model.stiffness = si.Parameter(unit="1/s^2", bounds=(0, 20), meaning=evil)
    model.law = si.Equation({0: model.angle.dot - model.rate, 1: model.rate.dot + model.stiffness * model.angle})
    model.seen = si.Output(model.angle, channel=evil)
    solution = si.Identification(model, recording).solve(2, max_iterations=5, check=False)
    assert "</html>" in report_html(solution)
    spectra = plot_residual_spectra(solution)
    assert spectra.png() == spectra.png()  # what the first drawing wrote at the ticks is a formula in the second


@pytest.mark.parametrize("name", ["ｘ", "ſ", "µ", "ﬁ"])
def test_a_name_is_the_one_that_python_reads(name):
    """Python reads these letters as others (NFKC): m.ｘ and setattr(m, 'ｘ') would be two parts that look alike."""
    model = si.Model("m")
    with pytest.raises(ModelError, match="cannot name a part"):
        setattr(model, name, si.Parameter(unit="m"))
