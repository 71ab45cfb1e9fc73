"""CasADi on a task: the equations mapped over the intervals, or the whole program expanded.

`map + JIT` hands Ipopt its own Jacobian and Hessian: those of one interval, mapped, summed by a
constant sparse matrix, everything compiled. That is expert use and CasADi at its best.
"""

from __future__ import annotations

import numpy as np

from symid.bench.clock import median_ms, processor_seconds
from symid.bench.peers import PeerTask, for_peers
from symid.bench.task import Task

SETUPS = ("map + JIT", "expand")
OPTIONS = {
    "ipopt.tol": 1e-6,
    "ipopt.mu_strategy": "adaptive",
    "ipopt.linear_solver": "mumps",
    "ipopt.print_level": 0,
    "ipopt.sb": "yes",
    "ipopt.max_cpu_time": 300.0,
    "print_time": False,
}
COMPILED = {
    "jit": True,
    "compiler": "shell",
    "jit_temp_suffix": True,
    "jit_options": {"flags": ["-O3", "-march=native"], "verbose": False},
}


def identification(task: Task, setup: str) -> dict:
    """Build and solve from the task's random start."""
    import casadi  # noqa: F401 - imports are reported apart

    peer = for_peers(task)
    began = processor_seconds()
    solver = build(peer, setup)
    built = processor_seconds()
    lower, upper = (
        np.concatenate([np.tile(s, peer.nodes), p])
        for s, p in zip(peer.state_bounds, peer.parameter_bounds, strict=True)
    )
    found = solver(x0=start(peer), lbx=lower, ubx=upper, lbg=0, ubg=0)
    ended = processor_seconds()
    states = np.array(found["x"]).ravel()[: -len(peer.start)].reshape(len(peer.noises), *peer.recorded.shape)
    return {
        "build": built - began,
        "solve": ended - built,
        "total": ended - began,
        "iterations": solver.stats()["iter_count"],
        "status": solver.stats()["return_status"],
        "rms": peer.rms(states),
    }


def evaluations(task: Task, setup: str) -> dict:
    """Milliseconds of one evaluation of constraints, Jacobian and Hessian of the program."""
    peer = for_peers(task)
    solver = build(peer, setup)
    z, multipliers = start(peer), np.ones(solver.size1_in("lbg"))
    functions = {
        "residual": ("nlp_g", (z, [])),
        "jacobian": ("nlp_jac_g", (z, [])),
        "hessian": ("nlp_hess_l", (z, [], 1.0, multipliers)),
    }
    return {
        f"{kind}_ms": _evaluation_ms(solver.get_function(name), arguments)
        for kind, (name, arguments) in functions.items()
    }


def build(peer: PeerTask, setup: str):
    """The solver of the task's program."""
    import casadi as ca

    program = _program(ca, peer)
    options = dict(OPTIONS)
    if setup == "expand":
        options["expand"] = True
    else:
        options |= COMPILED | dict(zip(("jac_g", "hess_lag"), _mapped_derivatives(ca, peer, program), strict=True))
    return ca.nlpsol("solver", "ipopt", program, options)


def start(peer: PeerTask) -> np.ndarray:
    """The recorded motion in every episode, then the parameters."""
    return np.concatenate([np.tile(peer.recorded.ravel(), len(peer.noises)), peer.start])


def _interval(ca, peer: PeerTask):
    """One interval: its unknowns (two nodes, parameters), its known numbers, its residual."""
    model = peer.model
    left, right = (ca.SX.sym(name, len(model.states)) for name in ("left", "right"))
    parameters, known = ca.SX.sym("p", len(model.parameters)), ca.SX.sym("known", 1 + len(model.noises))
    middle, rate = (left + right) / 2, (right - left) / peer.step
    values = [*ca.vertsplit(middle), *ca.vertsplit(rate), *ca.vertsplit(parameters), *ca.vertsplit(known)]
    return (
        ca.vertcat(left, right, parameters),
        known,
        ca.vertcat(*peer.function({"sin": ca.sin, "cos": ca.cos})(*values)),
    )


def _known(peer: PeerTask, episode: int) -> np.ndarray:
    middle = (peer.acceleration[:-1] + peer.acceleration[1:]) / 2
    return np.vstack([middle, peer.noises[episode].T])


def _unknowns(ca, peer: PeerTask, z):
    """Per episode (2 n + q, intervals): what each interval sees of the free vector."""
    nodes, n = peer.recorded.shape
    parameters = ca.repmat(z[-len(peer.start) :], 1, nodes - 1)
    for e in range(len(peer.noises)):
        x = ca.reshape(z[e * n * nodes : (e + 1) * n * nodes], n, nodes)
        yield ca.vertcat(x[:, :-1], x[:, 1:], parameters)


def _program(ca, peer: PeerTask) -> dict:
    nodes, n = peer.recorded.shape
    unknown, known, residual = _interval(ca, peer)
    rows = ca.Function("interval", [unknown, known], [residual]).map(nodes - 1)
    z = ca.MX.sym("z", peer.nodes * n + len(peer.start))
    constraints, objective = [], 0
    for e, seen in enumerate(_unknowns(ca, peer, z)):
        constraints.append(ca.vec(rows(seen, _known(peer, e))))
        outputs = ca.reshape(z[e * n * nodes : (e + 1) * n * nodes], n, nodes)[: peer.targets.shape[1], :]
        objective += peer.step * ca.sumsqr(outputs - peer.targets.T)
    constraints += [z[e * n * nodes :][:n] - z[(e + 1) * n * nodes :][:n] for e in range(len(peer.noises) - 1)]
    return {"x": z, "f": objective, "g": ca.vertcat(*constraints)}


def _mapped_derivatives(ca, peer: PeerTask, program: dict) -> tuple:
    """`jac_g` and `hess_lag` from the derivatives of one interval."""
    nodes, n = peer.recorded.shape
    size, rows = program["x"].numel(), program["g"].numel()
    unknown, known, residual = _interval(ca, peer)
    weights = ca.SX.sym("weights", n)
    first = ca.jacobian(residual, unknown)
    second = ca.triu(ca.hessian(ca.dot(weights, residual), unknown)[0])
    slopes = ca.Function("slopes", [unknown, known], [ca.vertcat(*first.nonzeros())]).map(nodes - 1)
    bends = ca.Function("bends", [unknown, known, weights], [ca.vertcat(*second.nonzeros())]).map(nodes - 1)

    z, p, factor, lam = (ca.MX.sym(name, k) for name, k in (("z", size), ("p", 0), ("factor", 1), ("lam", rows)))
    (row, col), (upper, lower) = (map(np.array, m.sparsity().get_triplet()) for m in (first, second))
    jacobian, hessian = [], []  # (values, rows, columns)
    for e, seen in enumerate(_unknowns(ca, peer, z)):
        columns = _columns(peer, e)
        at = e * n * (nodes - 1)
        own = at + n * np.arange(nodes - 1)
        jacobian.append((ca.vec(slopes(seen, _known(peer, e))), own + row[:, None], columns[col]))
        multipliers = ca.reshape(lam[at : at + n * (nodes - 1)], n, nodes - 1)
        hessian.append((ca.vec(bends(seen, _known(peer, e), multipliers)), columns[upper], columns[lower]))
        outputs = e * n * nodes + np.add.outer(np.arange(peer.targets.shape[1]), n * np.arange(nodes))
        hessian.append((ca.repmat(2 * peer.step * factor, outputs.size, 1), outputs, outputs))
    for e in range(len(peer.noises) - 1):  # equal initial states
        own = len(peer.noises) * n * (nodes - 1) + e * n + np.arange(n)
        both = e * n * nodes + np.array([[0], [n * nodes]]) + np.arange(n)
        jacobian.append((ca.DM(np.tile([1.0, -1.0], n)), np.vstack([own, own]), both))
    constraints = ca.Function("rows", [program["x"]], [program["g"]])(z)
    return (
        ca.Function("jac_g", [z, p], [constraints, _sparse(ca, jacobian, rows, size)], ["x", "p"], ["g", "jac_g_x"]),
        ca.Function(
            "hess_lag",
            [z, p, factor, lam],
            [_sparse(ca, hessian, size, size)],
            ["x", "p", "lam_f", "lam_g"],
            ["triu_hess_gamma_x_x"],
        ),
    )


def _columns(peer: PeerTask, episode: int) -> np.ndarray:
    """(2 n + q, intervals) places in the free vector of what each interval sees."""
    nodes, n = peer.recorded.shape
    left = np.add.outer(np.arange(n), n * np.arange(nodes - 1)) + episode * n * nodes
    parameters = peer.nodes * n + np.arange(len(peer.start))
    return np.vstack([left, left + n, np.tile(parameters[:, None], nodes - 1)])


def _sparse(ca, parts: list, rows: int, columns: int):
    """A sparse matrix from parts of (values, row of each, column of each); repeated entries are summed.

    Rows and columns are (entries, intervals); values run through the entries of an interval first.
    """
    key = np.concatenate([(c.astype(np.int64) * rows + r).T.ravel() for _, r, c in parts])
    values = ca.vertcat(*[v for v, _, _ in parts])
    places, target = np.unique(key, return_inverse=True)
    if len(places) == len(key):
        values = values[np.argsort(target).tolist()]
    else:
        values = ca.mtimes(
            ca.DM.triplet(target.tolist(), list(range(len(key))), ca.DM.ones(len(key)), len(places), len(key)), values
        )
    return ca.MX(ca.Sparsity.triplet(rows, columns, (places % rows).tolist(), (places // rows).tolist()), values)


def _evaluation_ms(function, arguments: tuple) -> float:
    import casadi as ca

    buffer, call = function.buffer()
    given = [np.array(ca.DM(a).nonzeros()) for a in arguments]
    room = [np.zeros(function.nnz_out(i)) for i in range(function.n_out())]
    for i, a in enumerate(given):
        if a.size:
            buffer.set_arg(i, memoryview(a))
    for i, a in enumerate(room):
        buffer.set_res(i, memoryview(a))
    return median_ms(call)
