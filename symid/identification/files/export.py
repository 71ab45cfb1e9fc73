"""An identified model as a file that needs no symid: C, a Python module, or LaTeX."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np

from symid import checked
from symid.codegen.standalone import c_text, python_text
from symid.errors import ModelError
from symid.files import write_atomically
from symid.identification.solution import Solution
from symid.model import Model
from symid.model.show import latex_lines, letters


def export(what: Solution | Model, path: str | Path) -> None:
    """Write the identified model to `path`; the suffix says how.

    ``.c``: self-contained C99 with the functions rates, outputs and step. ``.py``: a module with the same functions,
    which needs NumPy alone. ``.tex``: equations and a table of the values, in the letters of `model.show`.

    Parameters
    ----------
    what : a solved Solution, whose parameters become constants; or a Model (as C or Python without free parameters).

    Raises
    ------
    ModelError
        `what` is neither, was not solved, has parameters of single recordings, or the suffix is another.
    CodegenError
        The model has delays, algebraic variables or free parameters, which such a function cannot hold.

    Examples
    --------
    >>> si.export(problem.solve(), "loop.c")  # doctest: +SKIP
    """
    path = checked.path(path, "export", ModelError)
    if path.suffix not in TEXTS:
        raise ModelError(f"export: {path.name} ends with none of {', '.join(TEXTS)}; the suffix says what is written")
    if not isinstance(what, (Solution, Model)):
        raise ModelError(f"export: give a Solution or a Model, not {type(what).__name__}")
    if isinstance(what, Solution) and not what.solved:
        raise ModelError(f"export: the problem was not solved: {what.message}")
    write_atomically(path, TEXTS[path.suffix](what))


def _fixed(what: Solution | Model) -> Model:
    if isinstance(what, Model):
        return what
    own = [name for name in what.values if "[" in name]
    if own:
        raise ModelError(
            f"export: {', '.join(own)} belong to single recordings; give the values that you mean with model.fixed()"
        )
    return what.model.fixed(**what.values)


def tex_text(what: Solution | Model) -> str:
    """Equations in an aligned block, and a table: letter, name, value, standard error, unit, meaning."""
    model = what if isinstance(what, Model) else what.model
    names, rows = letters(model), []
    found = {} if isinstance(what, Model) else what.parameters.to_dict("index")
    for name, part in (model.parameters | model.constants).items():
        known = found.get(name) or {"value": getattr(part, "value", np.nan), "std_error": np.nan}
        numbers = [_number(known["value"]), _number(known["std_error"])]
        cells = [f"${names[part.symbol]}$", _plain(name), *numbers, _plain(part.unit), _plain(part.meaning)]
        rows.append(" & ".join(cells) + r" \\")
    head = "symbol & name & value & std. error & unit & meaning" + r" \\ \hline"
    equations = " \\\\\n".join(latex_lines(model))
    return "\n".join(
        [
            f"% {model.name}; needs amsmath",
            r"\begin{align*}",
            equations,
            r"\end{align*}",
            r"\begin{tabular}{llrrll}",
            head,
            *rows,
            r"\end{tabular}",
            "",
        ]
    )


def _number(value: float) -> str:
    return f"{value:.6g}" if np.isfinite(value) else "--"


def _plain(text: str) -> str:
    """Text that LaTeX prints as it is."""
    marks = {"\\": r"\textbackslash{}", "^": r"\^{}", "~": r"\~{}"}
    return "".join(marks.get(c, "\\" + c if c in "_%&#${}" else c) for c in text)


TEXTS: dict[str, Callable[[Solution | Model], str]] = {
    ".c": lambda what: c_text(_fixed(what)),
    ".py": lambda what: python_text(_fixed(what)),
    ".tex": tex_text,
}
