"""What symid needs for a task: evaluations, first use of a model, identification, memory."""

from __future__ import annotations

from symid.bench.clock import median_ms, peak_memory_mb, processor_seconds
from symid.bench.task import Task


def evaluations(task: Task, backend: str) -> dict:
    """Milliseconds of one evaluation of residual, Jacobian and Hessian over all intervals."""
    from dataclasses import replace

    import numpy as np

    problem = replace(task.identification(), backend=backend)
    program, z = problem.transcription.program, problem.start("random", 0, task.number)
    kernel, arguments = program.interval, program.interval_arguments(z, 0)
    count, index = len(arguments[0]), program._scatter[0]
    residual, jacobian = np.empty((count, kernel.m)), np.empty((count, len(kernel.jacobian_rows)))
    hessian, multipliers = np.zeros(len(program.hessian_rows)), np.ones((count, kernel.m))
    return {
        "intervals": count,
        "residual_ms": median_ms(lambda: kernel.residual(*arguments, out=residual)),
        "jacobian_ms": median_ms(lambda: kernel.jacobian(*arguments, out=jacobian)),
        "hessian_ms": median_ms(lambda: kernel.hessian_into(hessian, index, *arguments, multipliers)),
    }


def first_use(task: Task) -> dict:
    """Seconds until a model that nobody compiled before can be evaluated: the task's, with dry friction."""
    from symid.codegen import compile_program
    from symid.codegen.interval import interval_program
    from symid.mechanics.terms import LIBRARY
    from symid.transcription import Midpoint

    model = task.identification().model
    model = model.with_term(LIBRARY["coulomb_friction"].at("ankle"))
    began = processor_seconds()
    kernel = compile_program(interval_program(model, Midpoint().stencil), backend="c")
    return {"seconds": processor_seconds() - began, **kernel.seconds}


def identification(task: Task, start: str) -> dict:
    """Build and solve, from the "random" or the "default" start."""
    at_start = peak_memory_mb()
    import symid.identification  # imports are reported apart
    import symid.mechanics  # noqa: F401

    imported = processor_seconds()
    task.data  # noqa: B018 - read before the clock starts
    began = processor_seconds()
    problem = task.identification()
    transcription = problem.transcription
    z = problem.start(start, 0, task.number)
    built = processor_seconds()
    result = problem.solve_from(z)
    ended = processor_seconds()
    from symid.identification.sensitivity import outputs_and_targets

    pairs = outputs_and_targets(transcription, result.z)
    rms = (sum(((y - d) ** 2).mean() for y, d in pairs) / len(pairs)) ** 0.5
    return {
        "import": imported,
        "build": built - began,
        "solve": ended - built,
        "total": ended - began,
        "nodes": sum(transcription.layout.intervals) + len(transcription.layout.intervals),
        "iterations": result.iterations,
        "status": result.status_name,
        "rms": float(rms),
        "functions_share": result.seconds["functions"] / result.seconds["total"],
        "memory_mb": peak_memory_mb() - at_start,
        "peak_mb": peak_memory_mb(),
    }
