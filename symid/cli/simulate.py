"""`symid simulate`: make a recording of a standing person whose controller is known, or of a planned experiment."""

from __future__ import annotations

import argparse
import json
import math
from pathlib import Path

from symid.cli.options import add_model_arguments, add_recording_arguments, build_model, refuse_bad_outputs
from symid.errors import RecordingError

SUMMARY = "simulate a standing person under a known controller and write a recording"
EXAMPLES = (
    "symid simulate made.csv --body body.json --controller fpd --parameters gains.json",
    "symid simulate next.csv --experiment plan.json --truth rival",
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("output", metavar="RECORDING.csv", help="file to write")
    add_model_arguments(parser, required=False)
    parser.add_argument(
        "--experiment",
        metavar="PLAN.json",
        help="make the recording of an experiment that `symid diagnose --experiment` planned, of any system",
    )
    parser.add_argument(
        "--number", type=int, default=1, metavar="K", help="which experiment of the plan (default: the first, 1)"
    )
    parser.add_argument(
        "--truth", choices=("finding", "rival"), default="finding", help="which answer is true (default: finding)"
    )
    parser.add_argument(
        "--parameters",
        metavar="PARAMETERS.json",
        help="name: SI value of each parameter; what `symid identify --json` writes will do",
    )
    parser.add_argument(
        "--platform",
        metavar="OTHER.csv",
        help="recording whose platform acceleration is used (default: random pulses from --seed)",
    )
    add_recording_arguments(parser)
    parser.add_argument("--duration", type=float, metavar="S", help="s (default: 120, or that of --platform)")
    parser.add_argument(
        "--rate", type=float, metavar="HZ", help="samples per second (default: 50, or that of --platform)"
    )
    parser.add_argument(
        "--torque-noise",
        type=float,
        default=4.0,
        metavar="NM",
        help="standard deviation of each joint's torque noise, N m (default: 4)",
    )
    parser.add_argument(
        "--sensor-noise",
        type=float,
        default=3e-4,
        metavar="RAD",
        help="standard deviation on the recorded angles, rad (default: 0.0003)",
    )
    parser.add_argument("--seed", type=int, default=0, help="of the platform's pulses and all noise (default: 0)")


def run(arguments: argparse.Namespace) -> int:
    from symid.files import write_atomically
    from symid.synthetic import csv_text, standing_recording

    given = (arguments.experiment, arguments.body, arguments.parameters, arguments.platform, arguments.columns)
    refuse_bad_outputs(arguments.output, read=given)
    if arguments.experiment:
        return _planned(arguments)
    if arguments.body is None or arguments.parameters is None:
        raise RecordingError("simulate: give --body and --parameters, or --experiment with a plan")
    model = build_model(arguments.body, arguments.controller)
    parameters = read_parameters(arguments.parameters, model)
    platform, duration, rate = _platform(arguments)
    duration, rate = arguments.duration or duration, arguments.rate or rate
    for option, value in (
        ("--duration", duration),
        ("--rate", rate),
        ("--torque-noise", arguments.torque_noise),
        ("--sensor-noise", arguments.sensor_noise),
    ):
        if not (math.isfinite(value) and value >= 0) or (value == 0 and "noise" not in option):
            raise RecordingError(f"simulate: {option} {value:g} is not possible; give a positive number")
    recording = standing_recording(
        model,
        parameters,
        duration=duration,
        rate=rate,
        seed=arguments.seed,
        platform=platform,
        torque_noise=arguments.torque_noise,
        sensor_noise=arguments.sensor_noise,
    )
    write_atomically(arguments.output, csv_text(recording))
    print(
        f"{arguments.output}: {len(recording)} samples, {duration:g} s at {rate:g} Hz, "
        f"{model.name}, seed {arguments.seed}"
    )
    return 0


def _planned(arguments: argparse.Namespace) -> int:
    """Make the recording of a planned experiment."""
    from symid.cases.plan import refuse_no_plan
    from symid.discrepancy.design.plan import recording_of
    from symid.files import read_json, write_atomically
    from symid.synthetic import csv_text

    plan = read_json(arguments.experiment)
    refuse_no_plan(plan, Path(arguments.experiment))
    plans = plan["experiments"]
    if not 1 <= arguments.number <= len(plans):
        raise RecordingError(
            f"{arguments.experiment}: has {len(plans)} experiments, so --number {arguments.number} is none of them"
        )
    chosen = plans[arguments.number - 1]
    model = _model_of_plan(plan["system"], plan["channels"])
    recording = recording_of(chosen, model, arguments.truth, arguments.seed)
    write_atomically(arguments.output, csv_text(recording))
    print(
        f"{arguments.output}: {len(recording)} samples, {chosen['words']}, as if the {arguments.truth} were true, "
        f"seed {arguments.seed}"
    )
    return 0


def _model_of_plan(system: dict, channels: list[str]):
    """The model that was diagnosed: of a case, a rig or a person."""
    from symid.mechanics import model_of, rig_model

    if "rig" in system:
        return rig_model(system["rig"], channels, system["friction"])
    if "person" in system:
        return build_model(system["person"], system["controller"])
    return model_of(system, channels)


def _platform(arguments: argparse.Namespace):
    """The motion to use, and duration [s] and rate [Hz] where the command line gives none."""
    from symid.recording import fill_gaps, read_recording
    from symid.synthetic import DURATION, RATE, GivenPlatform

    if arguments.platform is None:
        return None, DURATION, RATE
    recording = read_recording(arguments.platform, allow_gaps=arguments.allow_gaps, columns=arguments.columns)
    if arguments.fill_inputs is not None:
        recording = fill_gaps(recording, arguments.fill_inputs, "platform_acceleration")
    start, end = recording.interval
    moving = GivenPlatform(recording.time - start, recording["platform_acceleration"])
    return moving, end - start, 1 / recording.even_step("simulate --platform")


def read_parameters(path: str, model) -> dict[str, float]:
    """Values of all parameters of `model` from JSON: plain numbers, or the document that identify writes.

    Raises
    ------
    RecordingError : the file is no such JSON, or a parameter is missing, unknown or no finite number.
    """
    from symid.files import read_json

    content = read_json(path)
    content = content.get("parameters", content) if isinstance(content, dict) else content
    if not isinstance(content, dict):
        raise RecordingError(f'{path}: a JSON object such as {{"kp_ankle": 900}} is expected')
    values = {k: v["value"] if isinstance(v, dict) and "value" in v else v for k, v in content.items()}
    wrong = [f"'{k}' is missing" for k in model.parameters if k not in values]
    wrong += [f"'{k}' is no parameter of {model.name}" for k in values if k not in model.parameters]
    wrong += [
        f"'{k}' must be a finite number, found {json.dumps(v)}"
        for k, v in values.items()
        if isinstance(v, bool) or not isinstance(v, (int, float)) or not math.isfinite(v)
    ]
    if wrong:
        raise RecordingError(f"{path}: " + "; ".join(wrong))
    return values
