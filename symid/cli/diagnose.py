"""`symid diagnose`: say what physics a model leaves out of a recording."""

from __future__ import annotations

import argparse
import warnings
from dataclasses import replace
from pathlib import Path

from symid.cli.options import add_recording_arguments, refuse_bad_outputs, show, tell_files
from symid.progress import say

SUMMARY = "find the physics that a model leaves out: where, what, how much, and the proof"
CONTROLLERS = ("pd", "fpd")
PERSON = ("body", "controller", "window")
OF_A_RECORDING = ("body", "controller", "rig", "friction", "window", "held_out", "sensor_noise", "columns")
EXAMPLES = (
    "symid diagnose recording.csv --body body.json --controller fpd --window 0 100 --held-out 100 200 --report a.html",
    "symid diagnose swing.csv --rig rig.json --window fit --held-out held_out --friction joint1 joint2",
    "symid diagnose case --json answer.json --held-out-csv held_out.csv",
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "source",
        metavar="CASE_DIR|RECORDING.csv",
        help="a directory with recording.csv and case.json, or a recording of a standing person or of a rig",
    )
    person = parser.add_argument_group("for the recording of a standing person")
    person.add_argument("--body", metavar="BODY.json", help="body parameters with units in their names")
    person.add_argument("--controller", choices=CONTROLLERS, help="feedback law of the model")
    rig = parser.add_argument_group("for the recording of a rig, a chain of links that hangs from a mount")
    rig.add_argument(
        "--rig",
        metavar="PARAMETERS.json",
        help="masses, lengths and inertias with units in their names: m1_kg, a1_m "
        "(joint to centre of mass), I1_kg_m2, L1_m (joint to joint), m2_kg ..., g_m_s2; null for what is not known; "
        "friction in it is ignored",
    )
    rig.add_argument(
        "--friction",
        nargs="+",
        metavar="JOINT",
        help="joints to which the model gives an unknown viscous friction (default: none, a conservative model)",
    )
    own = parser.add_argument_group("for any recording (a case directory says all of this itself)")
    own.add_argument(
        "--window",
        nargs="+",
        metavar="T",
        help="part to diagnose: two times in s, or a label of the column split (default: its label for fitting)",
    )
    own.add_argument(
        "--held-out",
        nargs="+",
        metavar="T",
        help="part that proves the finding, used once: two times in s, or a label (default: the label for holding out)",
    )
    own.add_argument(
        "--sensor-noise",
        type=float,
        metavar="RAD",
        help="rms of the angle sensors' noise (default: as the recording shows)",
    )
    add_recording_arguments(parser)
    parser.add_argument(
        "--threads", type=int, default=2, metavar="N", help="suspects that are tried at once (default: 2)"
    )
    parser.add_argument("--json", metavar="OUT.json", help="write the finding as JSON")
    parser.add_argument(
        "--experiment",
        metavar="PLAN.json",
        help="for each answer that explains the recording as well, write the experiment that would tell it apart; "
        "`symid simulate --experiment` makes its recording",
    )
    parser.add_argument("--report", metavar="OUT.html", help="write a report with figures")
    parser.add_argument("--held-out-csv", metavar="OUT.csv", help="write the prediction of the held-out window")


def run(arguments: argparse.Namespace) -> int:
    from symid.errors import DiagnosisError

    if arguments.threads < 1:
        raise DiagnosisError(f"--threads {arguments.threads} is not possible; give at least 1")
    _refuse_bad_outputs(arguments)
    source = Path(arguments.source)
    reader = _of_case if source.is_dir() else _of_rig if arguments.rig else _of_person
    with warnings.catch_warnings():
        # A suspect that diverges overflows on its way out; it is dropped, and nobody need hear of it.
        warnings.simplefilter("ignore", RuntimeWarning)
        finding = reader(source, arguments)
    if arguments.json:
        finding.to_json(arguments.json)
    if arguments.experiment:
        _plan(finding, source, arguments)
    if arguments.held_out_csv:
        finding.held_out_csv(arguments.held_out_csv)
    if arguments.report:
        from symid.report import write_diagnosis_report

        write_diagnosis_report(finding, arguments.report, f"Diagnosis of {source.name}", {"recording": source.name})
    tell_files(
        report=arguments.report,
        json=arguments.json,
        experiment=arguments.experiment,
        held_out_csv=arguments.held_out_csv,
    )
    show(str(finding))
    return 0


def _plan(finding, source: Path, arguments: argparse.Namespace) -> None:
    """Write the experiments, with what `symid simulate` needs to build the model again."""
    from symid.discrepancy.design.plan import plan_of
    from symid.files import read_json, write_json

    if source.is_dir():
        facts = read_json(source / "case.json")
    elif arguments.rig:
        facts = {"rig": read_json(arguments.rig), "friction": arguments.friction or []}
    else:
        facts = {"person": read_json(arguments.body), "controller": arguments.controller}
    model = finding.baseline.model
    channels = [c.channel for c in (*model.outputs.values(), *model.inputs.values())]
    plans = [plan_of(e) for e in finding.experiments(_tell)]
    write_json(arguments.experiment, {"system": facts, "channels": channels, "experiments": plans})


def _of_case(directory: Path, arguments: argparse.Namespace):
    from symid.cases import diagnose_case, read_case
    from symid.errors import DiagnosisError

    given = [f"--{k.replace('_', '-')}" for k in OF_A_RECORDING if getattr(arguments, k) is not None]
    if given:
        raise DiagnosisError(
            f"{directory} is a case directory, whose case.json says what {given[0]} would; leave it out"
        )
    case = read_case(directory)
    _warn_of_mistakes(case.model, case.recording)
    return diagnose_case(case, threads=arguments.threads, progress=_tell)


def _of_rig(path: Path, arguments: argparse.Namespace):
    from symid.cases import diagnose_case, rig_case
    from symid.cli.options import with_inputs
    from symid.errors import DiagnosisError

    given = [f"--{k}" for k in ("body", "controller") if getattr(arguments, k) is not None]
    if given:
        raise DiagnosisError(f"{given[0]} describes a standing person and --rig a rig; give one of them")
    _check_noise(arguments)
    case = rig_case(
        path,
        arguments.rig,
        friction=arguments.friction or (),
        fit_window=_part("--window", arguments.window),
        held_out=_part("--held-out", arguments.held_out),
        sensor_noise=arguments.sensor_noise,
        allow_gaps=arguments.allow_gaps,
        columns=arguments.columns,
    )
    case = replace(case, recording=with_inputs(case.recording, case.model, arguments.fill_inputs))
    _warn_of_mistakes(case.model, case.recording)
    if arguments.held_out_csv and case.held_out_window is None:
        raise DiagnosisError("--held-out-csv needs a held-out window; give --held-out T0 T1, or a label")
    return diagnose_case(case, threads=arguments.threads, progress=_tell)


def _of_person(path: Path, arguments: argparse.Namespace):
    from symid.cases.case import parts_of
    from symid.cli.options import build_model, with_inputs
    from symid.discrepancy import diagnose
    from symid.errors import DiagnosisError
    from symid.recording import read_recording

    missing = [f"--{k}" for k in PERSON if getattr(arguments, k) is None]
    if missing:
        raise DiagnosisError(f"{path} is no case directory, so {', '.join(missing)} must be given, or --rig for a rig")
    if arguments.friction:
        raise DiagnosisError(
            "--friction belongs to --rig; a standing person's feedback holds any viscous friction already"
        )
    _check_noise(arguments)
    model = build_model(arguments.body, arguments.controller)
    recording = read_recording(path, allow_gaps=arguments.allow_gaps, columns=arguments.columns)
    recording = with_inputs(recording, model, arguments.fill_inputs)
    _warn_of_mistakes(model, recording)
    fit, held_out = parts_of(
        recording, _part("--window", arguments.window), _part("--held-out", arguments.held_out), str(path)
    )
    return diagnose(
        model,
        recording,
        fit_window=fit,
        held_out=held_out,
        sensor_noise=arguments.sensor_noise,
        threads=arguments.threads,
        progress=_tell,
    )


def _warn_of_mistakes(model, recording) -> None:
    """A mistake of units, signs or columns is not a missing law."""
    from symid.errors import RecordingWarning
    from symid.plausibility import remarks

    for remark in remarks(model, recording):
        warnings.warn(remark, RecordingWarning, stacklevel=2)


def _part(option: str, words: list[str] | None) -> tuple[float, float] | str | None:
    """Two times, or a label."""
    from symid.errors import DiagnosisError

    if words is None or len(words) == 1 and not _is_number(words[0]):
        return words and words[0]
    if len(words) == 2 and all(map(_is_number, words)) and float(words[0]) < float(words[1]):
        return float(words[0]), float(words[1])
    raise DiagnosisError(
        f"{option} {' '.join(words)} is no window; give a start and a later end in seconds, "
        "or a label of the column split"
    )


def _is_number(word: str) -> bool:
    try:
        return abs(float(word)) < float("inf")
    except ValueError:
        return False


def _check_noise(arguments: argparse.Namespace) -> None:
    from symid.errors import DiagnosisError

    if arguments.sensor_noise is not None and not 0 < arguments.sensor_noise < 1:
        raise DiagnosisError(
            f"--sensor-noise {arguments.sensor_noise:g} is not possible; give the rms in rad, more than 0"
        )


def _refuse_bad_outputs(arguments: argparse.Namespace) -> None:
    """Before the work, not after it."""
    from symid.errors import DiagnosisError

    source = Path(arguments.source)
    refuse_bad_outputs(
        arguments.json,
        arguments.experiment,
        arguments.report,
        arguments.held_out_csv,
        read=(source, source / "case.json", source / "recording.csv", arguments.body, arguments.rig, arguments.columns),
    )
    if arguments.held_out_csv and not (arguments.held_out or arguments.rig or Path(arguments.source).is_dir()):
        raise DiagnosisError("--held-out-csv needs a held-out window; give --held-out T0 T1")


def _tell(text: str) -> None:
    say(text)
