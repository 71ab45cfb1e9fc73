"""The measurements as text: medians, ratios, and whether each target is met."""

from __future__ import annotations

import statistics
from collections.abc import Iterator

from symid.bench.measure import middle, stopped

EVALUATION_MS = {"symid, C": 0.4, "symid, NumPy": 6.0}
FIRST_USE_S = 1.5
FASTER_THAN_CASADI = {"random": 8.0, "default": 25.0}
"""From the same random start, and from the start that symid makes of the recording."""
FASTER_THAN_OPTY = 50.0
FASTER_THAN_MUMPS = 1.8
"""In linear systems; below, the solver for chains would not be worth its place as the default."""
FUNCTIONS_SHARE = 0.05
MEMORY_MB = 400.0


def table(found: dict) -> str:
    """All of what `measure` found."""
    parts = [*_evaluations(found), "", *_solves(found), "", *_verdicts(found)]
    parts += [
        f"{name} is not installed: no comparison with it (pip install 'symid[bench]')" for name in found["absent"]
    ]
    return "\n".join(parts)


def _evaluations(found: dict) -> Iterator[str]:
    kinds = ("residual", "jacobian", "hessian")
    intervals = found["evaluations"]["symid, C"]["intervals"]
    yield f"{f'one evaluation, {intervals} intervals':<34}" + "".join(f"{k + ' ms':>14}" for k in kinds)
    for side, row in found["evaluations"].items():
        yield f"{side:<34}" + "".join(f"{row[k + '_ms']:>14.3f}" for k in kinds)


def _solves(found: dict) -> Iterator[str]:
    for label, sides in found["solves"].items():
        title = f"{label} (median of {len(next(iter(sides.values())))})"
        heads = "".join(f"{head:>11}" for head in ("build s", "solve s", "total s", "iterations", "RMS"))
        yield f"{title:<40}{heads}   of each start: total s (iterations, RMS)"
        for side, runs in sides.items():
            yield (
                f"{side:<40}{middle(runs, 'build'):>11.2f}{middle(runs, 'solve'):>11.2f}{middle(runs, 'total'):>11.2f}"
                f"{middle(runs, 'iterations'):>11.0f}{middle(runs, 'rms'):>11.6f}   "
                + ", ".join(stopped(r) or f"{r['total']:.2f} ({r['iterations']}, {r['rms']:.6f})" for r in runs)
            )


def ratio(slow: list[list[dict]], fast: list[dict]) -> float:
    """How many times faster: median over random starts of the best of `slow` over `fast`, build and solve."""
    return statistics.median(min(r["total"] for r in rs) / f["total"] for *rs, f in zip(*slow, fast, strict=True))


def _verdicts(found: dict) -> Iterator[str]:
    """One line per target."""
    for side, most in EVALUATION_MS.items():
        row = found["evaluations"][side]
        yield line(f"slowest evaluation, {side}", max(v for k, v in row.items() if k.endswith("_ms")), "ms", most)
    chain, mumps = (found["linear"][solver]["ms"] for solver in ("chain", "mumps"))
    yield line(
        f"linear systems, {chain:.1f} ms an iteration: MUMPS / symid",
        mumps / chain,
        "x",
        FASTER_THAN_MUMPS,
        at_least=True,
    )
    yield line("first use of a new model", middle(found["first_use"], "seconds"), "s", FIRST_USE_S)
    for label, sides in found["solves"].items():
        casadi = [runs for side, runs in sides.items() if side.startswith("CasADi")]
        for kind, least in FASTER_THAN_CASADI.items():
            if casadi and f"symid, {kind} start" in sides:
                yield line(
                    f"{label}: {kind} start, CasADi's best / symid",
                    ratio(casadi, sides[f"symid, {kind} start"]),
                    "x",
                    least,
                    at_least=True,
                )
        if "opty" in sides:
            yield line(
                f"{label} / symid",
                ratio([sides["opty"]], sides["symid, random start"]),
                "x",
                FASTER_THAN_OPTY,
                at_least=True,
            )
    alone = next(iter(found["solves"].values()))["symid, random start"]
    yield line(
        "generated functions' share of the solve", 100 * middle(alone, "functions_share"), "%", 100 * FUNCTIONS_SHARE
    )
    yield line("memory above the interpreter's start", max(r["memory_mb"] for r in alone), "MB", MEMORY_MB)
    new, known = found["first_identification"]["total"], middle(alone[:1], "total")
    yield f"{'identification that compiles first / the same later':<62}{new / known:>9.2f} x"
    yield f"{'imports of symid':<62}{middle(alone, 'import'):>9.2f} s"


def line(what: str, value: float, unit: str, target: float, at_least: bool = False) -> str:
    met = value >= target if at_least else value <= target
    sign, verdict = ">=" if at_least else "<=", "met" if met else "NOT MET"
    return f"{what:<62}{value:>9.3g} {unit:<3} target {sign} {target:g}: {verdict}"
