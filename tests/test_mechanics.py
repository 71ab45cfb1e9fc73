"""Equations of motion: conservation, linearisation, published eigenvalues, independent derivations."""

import json
from pathlib import Path

import numpy as np
import pytest
import sympy as sm

from symid.mechanics import PD, DoubleLinkPendulum, FullStatePD

SHARED = Path(__file__).parents[2] / "shared"
needs_shared = pytest.mark.skipif(not SHARED.is_dir(), reason="needs the folder 'shared' beside the checkout")
BODY = DoubleLinkPendulum(0.84, 0.47, 0.33, 22.7, 48.4, 1.72, 3.29)


def closed_loop_matrix(model, values):
    """State matrix at upright, references zero, with zero input: x' = -(df/dx')^-1 (df/dx) x."""
    zero = {c.symbol: 0 for c in (*model.inputs.values(), *model.noises.values())}
    zero |= {c.symbol: c.value for c in model.constants.values()}
    zero |= {model[k].symbol: v * (not k.startswith("ref")) for k, v in values.items()}
    x = [s.symbol for s in model.states.values()]
    dx = [s.dot for s in model.states.values()]
    zero |= dict.fromkeys(x + dx, 0)
    f = sm.Matrix(model.residual())
    fx, fdx = (np.array(f.jacobian(v).xreplace(zero).evalf(), dtype=float) for v in (x, dx))
    return -np.linalg.solve(fdx, fx)


@needs_shared
def test_published_eigenvalues_follow_from_published_gains():
    body = DoubleLinkPendulum.from_json(SHARED / "recordings/standing_subject05/body.json")
    results = json.loads((SHARED / "reference/paper_results.json").read_text())["results"]
    checked = 0
    for result in results:
        if "eigenvalues_re_im" not in result:
            continue
        law = {"PD": PD(), "FPD": FullStatePD()}[result["controller"]]
        model = body.with_feedback(law)
        found = np.linalg.eigvals(closed_loop_matrix(model, result["gains_mean"]))
        for re, im in result["eigenvalues_re_im"]:
            nearest = min(found, key=lambda s: abs(s - complex(re, im)))
            assert abs(nearest - complex(re, im)) < 6e-4 * abs(complex(re, im))
            checked += 1
    assert checked == 32
