"""The solver for chains: against dense algebra, with unstable dynamics, singular, and inside Ipopt beside MUMPS."""

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from kkt_matrices import Solver, chain
from nlp_problems import hs071, tracking

from symid import kkt
from symid.codegen import build
from symid.errors import SolveError
from symid.ipopt_solver import solve_nlp

pytest.importorskip("cyipopt", reason="cyipopt is absent: run `python -m symid.setup_ipopt`")
pytestmark = pytest.mark.compiled


def check(matrix: np.ndarray, threads: int = 1, tolerance: float = 1e-9) -> np.ndarray:
    """Compare with dense algebra; one step of refinement, as Ipopt takes at least one."""
    solver = Solver(matrix, threads)
    assert solver.info[0] == 0
    assert solver.factorise(matrix) == (0, int((np.linalg.eigvalsh(matrix) < 0).sum()))
    right = np.random.default_rng(0).normal(size=len(matrix))
    x = solver.solve(right)
    x += solver.solve(right - matrix @ x)
    scale = abs(matrix).sum(axis=1).max() * abs(x).max() + abs(right).max()
    assert abs(matrix @ x - right).max() <= tolerance * scale
    kkt.end()
    return x


@settings(max_examples=40, deadline=None)
@given(
    seed=st.integers(0, 10**6),
    nodes=st.integers(1, 20),
    states=st.integers(1, 7),
    border=st.integers(0, 12),
    episodes=st.integers(1, 4),
    linked=st.booleans(),
    window=st.integers(1, 4),
    threads=st.integers(1, 3),
)
def test_any_chain_is_solved_with_the_right_inertia(seed, nodes, states, border, episodes, linked, window, threads):
    rng = np.random.default_rng(seed)
    check(chain(rng, nodes, states, border, episodes, linked=linked, window=window), threads)


@pytest.mark.parametrize("growth", [1e10, 1e30, 1e80])
@pytest.mark.parametrize("curvature", [1.0, 1e-6])
def test_motion_that_grows_and_decays_beyond_all_digits_is_solved(growth, curvature):
    rng, nodes = np.random.default_rng(1), 60
    turn = np.linalg.qr(rng.normal(size=(4, 4)))[0]
    rates = growth ** (np.array([1, 0.3, -0.5, -1]) / nodes)
    check(chain(rng, nodes, 4, 6, step=turn @ np.diag(rates) @ turn.T, curvature=curvature))


@pytest.mark.parametrize(
    ("nodes", "states", "border", "episodes"),
    [(1, 4, 0, 1), (1, 1, 0, 1), (2, 1, 1, 1), (60, 2, 0, 1), (1, 3, 5, 4), (200, 1, 3, 1), (3, 20, 0, 2)],
)
def test_degenerate_chains(nodes, states, border, episodes):
    check(chain(np.random.default_rng(2), nodes, states, border, episodes))


def test_a_diagonal_matrix_and_noise_at_every_node():
    check(np.diag([3.0, -2.0, 1e-9, 5.0]))
    rng, base = np.random.default_rng(3), chain(np.random.default_rng(3), 30, 2, 2)
    rows = 29 * 2  # a slack for every equation: process noise
    noise = np.zeros((len(base), rows))
    noise[-rows:] = np.eye(rows)
    n = len(base) - rows
    full = np.block(
        [
            [base[:n, :n], np.zeros((n, rows)), base[:n, n:]],
            [np.zeros((rows, n)), np.diag(rng.uniform(1, 2, rows)), np.eye(rows)],
            [base[n:, :n], np.eye(rows), np.zeros((rows, rows))],
        ]
    )
    check(full)


def test_equations_that_repeat_make_it_singular():
    matrix = chain(np.random.default_rng(4), 40, 3, 4)
    last = matrix[-1].copy()
    double = np.block([[matrix, last[:, None]], [last[None], np.zeros((1, 1))]])
    solver = Solver(double)
    status, negative = solver.factorise(double)
    assert status == 3
    assert solver.info[1] == len(double) - 1
    assert negative == (np.linalg.eigvalsh(matrix) < 0).sum()
    kkt.end()


def test_not_a_number_is_refused_without_delay():
    matrix = chain(np.random.default_rng(5), 50, 4, 3)
    solver = Solver(matrix)
    bad = matrix.copy()
    bad[7, 7] = np.nan
    assert solver.factorise(bad)[0] == -5
    assert solver.factorise(matrix)[0] == 0
    kkt.end()


def test_any_number_of_threads_gives_the_same_bits():
    matrix = chain(np.random.default_rng(6), 12, 4, 5, 5, linked=True)
    one, two, five = (check(matrix, threads) for threads in (1, 2, 5))
    assert (one == two).all()
    assert (one == five).all()


@pytest.mark.slow
def test_any_width_of_vectors_gives_the_same_bits(monkeypatch):
    """Where products are not fused, which the width does not decide."""
    from symid.kkt import library

    matrix, found = chain(np.random.default_rng(6), 12, 4, 5, 5, linked=True), []
    cached, flags = (library.library_path, library._library), library.FLAGS
    for width in (2, 4, 8):
        monkeypatch.setattr(library, "FLAGS", (*flags, "-ffp-contract=off", f"-DWIDTH={width}"))
        for function in cached:
            function.cache_clear()
        found.append(check(matrix))
    for function in cached:
        function.cache_clear()
    assert (found[0] == found[1]).all() and (found[0] == found[2]).all()


def test_work_grows_linearly_and_the_border_is_found():
    fills = []
    for nodes in (40, 80):
        matrix = chain(np.random.default_rng(7), nodes, 4, 6)
        Solver(matrix).factorise(matrix)
        done = kkt.end()
        assert done.border == 6
        fills.append(done.fill)
    assert fills[1] < 2.1 * fills[0]


@pytest.mark.parametrize("hessian", ["exact", "limited-memory"])
def test_ipopt_ends_in_the_same_optimum_with_both_solvers(hessian):
    ours, theirs = (solve_nlp(tracking(), hessian=hessian, linear_solver=name) for name in ("chain", "mumps"))
    assert ours.solved
    assert ours.iterations == theirs.iterations
    np.testing.assert_allclose(ours.z, theirs.z, atol=1e-7)
    np.testing.assert_allclose(ours.multipliers, theirs.multipliers, atol=1e-6)
    assert (ours.linear_solver.name, theirs.linear_solver.name) == ("chain", "mumps")
    assert ours.linear_solver.factorisations >= ours.iterations
    assert solve_nlp(hs071(), linear_solver="chain").objective == pytest.approx(17.0140173, abs=1e-6)


def test_without_a_compiler_mumps_works_and_says_why(monkeypatch):
    monkeypatch.setenv("CC", "/nowhere/cc")
    build._identity.cache_clear()
    kkt.library_path.cache_clear()
    try:
        result = solve_nlp(tracking(), linear_solver="auto")
        assert result.solved
        assert result.linear_solver.name == "mumps"
        assert "compiler" in result.linear_solver.reason
        with pytest.raises(SolveError, match="'chain' is not possible.*compiler"):
            solve_nlp(tracking(), linear_solver="chain")
    finally:
        kkt.library_path.cache_clear()
