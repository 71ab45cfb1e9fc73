"""The generated C source of a Program: three functions over all points, and their structure."""

from __future__ import annotations

import hashlib
import json
from dataclasses import dataclass

from symid.codegen.derive import Derived, derive, lowered
from symid.codegen.equations.program import Program
from symid.codegen.straight_line.cprint import PREAMBLE, Statements, foreign_text
from symid.codegen.straight_line.graph import POINT, UNIFORM, Graph

FORMAT = 1  # of the sources: a new number makes every fingerprint new

# Points are taken eight at a time: copied to columns, computed by one vectorised loop, copied
# out. The last block repeats its last point, so that the loop always has eight.
FUNCTION = """
void {name}(ptrdiff_t n, const double *restrict local, ptrdiff_t stride, const double *restrict shared,
        const double *restrict data, const double *restrict constants,
        const double *restrict multipliers, double *restrict out, const int *restrict index)
{{
{uniform}
    for (ptrdiff_t first = 0; first < n; first += BLOCK) {{
        const int count = n - first < BLOCK ? (int)(n - first) : BLOCK;
        {arrays}
        for (int i = 0; i < BLOCK; i++) {{
            const ptrdiff_t k = first + (i < count ? i : count - 1);
            {gather}
        }}
        #pragma omp simd
        for (int i = 0; i < BLOCK; i++) {{
{point}
        }}
        for (int i = 0; i < count; i++) {{
            const ptrdiff_t k = first + i;
            {scatter}
        }}
    }}
}}
"""
STORE = "for (int j = 0; j < {size}; j++) out[k * {size} + j] = value[j][i];"
ACCUMULATE = "for (int j = 0; j < {size}; j++) out[index[k * {size} + j]] += value[j][i];"


@dataclass(frozen=True)
class Source:
    """Generated text with the sizes and structural nonzeros that it has.

    `fingerprint` belongs to the equations; `text` is complete C, starting with fingerprint and
    structure as comments, from which `read` restores everything.
    """

    fingerprint: str
    structure: dict
    text: str

    @classmethod
    def read(cls, text: str) -> Source:
        first, second = text.split("\n", 2)[:2]
        return cls(first.removeprefix("// "), json.loads(second.removeprefix("// ")), text)


def fingerprint(program: Program, graph: Graph, rows: list[int]) -> str:
    """Changes with the equations and the order of their symbols; not with any value."""
    symbols = [[str(s) for s in getattr(program, k)] for k in ("local", "shared", "data", "constants")]
    text = repr((FORMAT, symbols, graph.ops, graph.args, rows)) + foreign_text(graph.foreign_texts.values())
    return hashlib.sha256(text.encode()).hexdigest()[:32]


def generate(program: Program) -> Source:
    """Derive and print `program`, from nothing but its equations."""
    graph, rows, variables = lowered(program)
    return print_source(program, fingerprint(program, graph, rows), derive(graph, rows, variables))


def structure(program: Program, derived: Derived) -> dict:
    """Sizes, and rows and columns of the nonzeros, as plain lists."""
    return {
        "name": program.name,
        "m": len(derived.residual),
        **{f"n_{k}": len(getattr(program, k)) for k in ("local", "shared", "data", "constants")},
        "jacobian": [list(t) for t in derived.jacobian],
        "hessian": [list(t) for t in derived.hessian],
    }


def print_source(program: Program, key: str, derived: Derived) -> Source:
    shape = structure(program, derived)
    legend = [
        f"// {k}[{i}]: {_commented(s)}"
        for k in ("local", "shared", "data", "constants")
        for i, s in enumerate(getattr(program, k))
    ]
    functions = [
        _function("residual", shape, derived.graph, derived.residual, STORE),
        _function("jacobian", shape, derived.graph, list(derived.jacobian.values()), STORE),
        _function("hessian_into", shape, derived.graph, list(derived.hessian.values()), ACCUMULATE),
    ]
    own = PREAMBLE + foreign_text(derived.graph.foreign_texts.values()) + "#define BLOCK 8"
    text = "\n".join([f"// {key}", f"// {json.dumps(shape)}", *legend, own, *functions])
    return Source(key, shape, text)


def _commented(symbol) -> str:
    """A name as a comment holds it: nothing in it can end or prolong the line."""
    return "".join(c if c.isprintable() and c not in "\\?" else "_" for c in str(symbol))


def _function(name: str, shape: dict, graph: Graph, outputs: list[int], scatter: str) -> str:
    sizes = {"local": shape["n_local"], "data": shape["n_data"], "multipliers": shape["m"]}
    keys = [graph.args[k][0] for k in graph.needed(outputs) if graph.ops[k] == "symbol" and graph.level[k] == POINT]
    used = [g for g in sizes if any(key.startswith(g + "[") for key in keys)]
    column = {g: f"{g}_column" for g in used}
    names = {key: f"{column[key.partition('[')[0]]}[{key.partition('[')[2]}[i]" for key in keys}
    body = Statements(graph, outputs, names)
    strides = {"local": "stride", "data": sizes["data"], "multipliers": sizes["multipliers"]}
    arrays = [f"double {column[g]}[{sizes[g]}][BLOCK] __attribute__((aligned(64)));" for g in used]
    arrays.append(f"double value[{max(1, len(outputs))}][BLOCK] __attribute__((aligned(64)));")
    gather = [f"for (int j = 0; j < {sizes[g]}; j++) {column[g]}[j][i] = {g}[k * {strides[g]} + j];" for g in used]
    point = body.declarations(POINT) + [f"value[{j}][i] = {body.expression(k)};" for j, k in enumerate(outputs)]
    return FUNCTION.format(
        name=name,
        uniform="\n".join("    " + s for s in body.declarations(UNIFORM)),
        arrays="\n        ".join(arrays),
        gather="\n            ".join(gather) or "(void)k;",
        point="\n".join(12 * " " + s for s in point),
        scatter=scatter.format(size=len(outputs)) if outputs else "(void)k;",
    )
