"""opty on a task of one episode: SymPy equations, compiled by opty, solved through cyipopt."""

from __future__ import annotations

import numpy as np
from sympy import Matrix
from sympy.physics.mechanics import dynamicsymbols

from symid.bench.clock import processor_seconds
from symid.bench.peers import for_peers
from symid.bench.task import Task

OPTIONS = {
    "tol": 1e-6,
    "mu_strategy": "adaptive",
    "linear_solver": "mumps",
    "max_iter": 3000,
    "print_level": 0,
    "sb": "yes",
}


def identification(task: Task) -> dict:
    """Build and solve from the task's random start."""
    import opty

    peer = for_peers(task)
    began = processor_seconds()
    states, rates, parameters, (drive, *noises) = peer.symbols
    x = [dynamicsymbols(s.name) for s in states]
    u = dynamicsymbols(drive.name)
    named = dict(zip(states, x, strict=True)) | {drive: u} | dict.fromkeys(noises, 0)
    named |= {rate: v.diff() for rate, v in zip(rates, x, strict=True)}
    nodes, outputs = len(peer.recorded), peer.targets.shape[1]

    def objective(free):
        return peer.step * np.sum((free[: outputs * nodes].reshape(outputs, nodes).T - peer.targets) ** 2)

    def gradient(free):
        out = np.zeros_like(free)
        difference = free[: outputs * nodes].reshape(outputs, nodes) - peer.targets.T
        out[: outputs * nodes] = 2 * peer.step * difference.ravel()
        return out

    rows = [r.xreplace(named) for r in peer.rows]
    problem = opty.Problem(
        objective,
        gradient,
        Matrix(rows),
        x,
        nodes,
        peer.step,
        known_trajectory_map={u: peer.acceleration},
        integration_method="midpoint",
        bounds={
            name: tuple(b)
            for name, b in zip(
                (*x, *parameters), np.vstack([peer.state_bounds.T, peer.parameter_bounds.T]), strict=True
            )
        },
    )
    order = [parameters.index(p) for p in problem.collocator.parameters]
    for name, value in OPTIONS.items():
        problem.add_option(name, value)
    built = processor_seconds()
    found, info = problem.solve(np.concatenate([peer.recorded.T.ravel(), peer.start[order]]))
    ended = processor_seconds()
    trajectory = found[: nodes * len(x)].reshape(1, len(x), nodes).transpose(0, 2, 1)
    return {
        "build": built - began,
        "solve": ended - built,
        "total": ended - began,
        "iterations": len(problem.obj_value) - 1,
        "status": info["status_msg"].decode(),
        "rms": peer.rms(trajectory),
    }
