"""`symid diagnose`: say what physics a model leaves out of a recording."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

SUMMARY = "find the physics that a model leaves out: where, what, how much, and the proof"
CONTROLLERS = ("pd", "fpd")
NEEDED = ("body", "controller", "window")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("source", metavar="CASE_DIR|RECORDING.csv",
                        help="a directory with recording.csv and case.json, or a recording of a standing person")
    own = parser.add_argument_group("for a recording (a case directory says all of this itself)")
    own.add_argument("--body", metavar="BODY.json", help="body parameters with units in their names")
    own.add_argument("--controller", choices=CONTROLLERS, help="feedback law of the model")
    own.add_argument("--window", nargs=2, type=float, metavar=("T0", "T1"), help="part to diagnose, s")
    own.add_argument("--held-out", nargs=2, type=float, metavar=("T0", "T1"), help="part that proves the finding, s; used once")
    own.add_argument("--sensor-noise", type=float, metavar="RAD", help="rms of the angle sensors' noise (default: as the recording says)")
    parser.add_argument("--threads", type=int, default=2, metavar="N", help="suspects that are tried at once (default: 2)")
    parser.add_argument("--json", metavar="OUT.json", help="write the finding as JSON")
    parser.add_argument("--report", metavar="OUT.html", help="write a report with figures")
    parser.add_argument("--held-out-csv", metavar="OUT.csv", help="write the prediction of the held-out window")


def run(arguments: argparse.Namespace) -> int:
    from symid.errors import DiagnosisError

    if arguments.threads < 1:
        raise DiagnosisError(f"--threads {arguments.threads} is not possible; give at least 1")
    _refuse_missing_folders(arguments)
    source = Path(arguments.source)
    finding = _of_case(source, arguments) if source.is_dir() else _of_recording(source, arguments)
    print(finding)
    if arguments.json:
        finding.to_json(arguments.json)
    if arguments.held_out_csv:
        finding.held_out_csv(arguments.held_out_csv)
    if arguments.report:
        from symid.report import write_diagnosis_report
        provenance = {"recording": source.name, "model": finding.baseline.model.name}
        for key, title in (("train", "fit window"), ("heldout", "held-out window")):
            if f"baseline_{key}" in finding.runs:
                time = finding.runs[f"baseline_{key}"].time
                provenance[title] = f"{time[0]:g} to {time[-1]:g} s, {len(time)} samples"
        write_diagnosis_report(finding, arguments.report, f"Diagnosis of {source.name}", provenance)
    return 0


def _of_case(directory: Path, arguments: argparse.Namespace):
    from symid.discrepancy import diagnose_case, read_case
    from symid.errors import DiagnosisError

    given = [f"--{k.replace('_', '-')}" for k in (*NEEDED, "held_out", "sensor_noise") if getattr(arguments, k) is not None]
    if given:
        raise DiagnosisError(f"{directory} is a case directory, whose case.json says what {given[0]} would; leave it out")
    return diagnose_case(read_case(directory), threads=arguments.threads, progress=_tell)


def _of_recording(path: Path, arguments: argparse.Namespace):
    from symid.cli.options import build_model
    from symid.discrepancy import diagnose
    from symid.errors import DiagnosisError
    from symid.recording import read_recording

    missing = [f"--{k}" for k in NEEDED if getattr(arguments, k) is None]
    if missing:
        raise DiagnosisError(f"{path} is no case directory, so {', '.join(missing)} must be given")
    if arguments.sensor_noise is not None and not 0 < arguments.sensor_noise < 1:
        raise DiagnosisError(f"--sensor-noise {arguments.sensor_noise:g} is not possible; give the rms in rad, more than 0")
    model = build_model(arguments.body, arguments.controller)
    return diagnose(model, read_recording(path), fit_window=tuple(arguments.window),
                    held_out=tuple(arguments.held_out) if arguments.held_out else None,
                    sensor_noise=arguments.sensor_noise, threads=arguments.threads, progress=_tell)


def _refuse_missing_folders(arguments: argparse.Namespace) -> None:
    """Before the work, not after it."""
    from symid.errors import DiagnosisError
    for path in (arguments.json, arguments.report, arguments.held_out_csv):
        if path and not Path(path).parent.is_dir():
            raise DiagnosisError(f"{path} cannot be written: the folder {Path(path).parent} does not exist")
    if arguments.held_out_csv and not arguments.held_out and not Path(arguments.source).is_dir():
        raise DiagnosisError("--held-out-csv needs a held-out window; give --held-out T0 T1")


def _tell(text: str) -> None:
    print(text, file=sys.stderr, flush=True)
