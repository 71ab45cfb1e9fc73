"""What symid needs for a task: evaluations, first use of a model, identification, memory."""

from __future__ import annotations

from symid.bench.clock import median_ms, peak_memory_mb, processor_seconds
from symid.bench.task import Task
from symid.errors import SolveError


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
    from symid.codegen.equations.interval import interval_program
    from symid.mechanics.missing.terms import LIBRARY
    from symid.transcription import Midpoint

    model = task.identification().model
    model = model.with_term(LIBRARY["coulomb_friction"].at("ankle"))
    began = processor_seconds()
    kernel = compile_program(interval_program(model, Midpoint().stencil), backend="c")
    return {"seconds": processor_seconds() - began, **kernel.seconds}


def identification(task: Task, start: str) -> dict:
    """Build and solve as a user's call does, from the "random" or the "default" start.

    What the peers are given, the model's equations, is not measured here either; nor are imports, which are reported
    apart, with those of SciPy that are made at first use.
    """
    at_start = peak_memory_mb()
    import scipy.fft
    import scipy.interpolate
    import scipy.optimize  # noqa: F401

    import symid.mechanics  # noqa: F401
    from symid.identification import Solve
    from symid.identification.studies.worker import solve_here

    imported = processor_seconds()
    problem = task.identification()
    began = processor_seconds()
    transcription = problem.transcription
    built = processor_seconds()
    steps: list[float] = []
    outcome = solve_here(Solve(problem, start, task.number), lambda _: steps.append(processor_seconds()))
    ended = processor_seconds()
    if outcome.result is None:
        raise SolveError(outcome.row.message)
    seconds = outcome.result.seconds
    return {
        "import": imported,
        "build": built - began,
        "solve": ended - built,
        "total": ended - began,
        "nodes": sum(transcription.layout.intervals) + len(transcription.layout.intervals),
        "iterations": outcome.row.iterations,
        "iteration": (steps[-1] - steps[0]) / max(1, len(steps) - 1),
        "status": outcome.row.status,
        "rms": outcome.row.rms,
        "functions_share": seconds["functions"] / seconds["total"],
        "memory_mb": peak_memory_mb() - at_start,
        "peak_mb": peak_memory_mb(),
    }
