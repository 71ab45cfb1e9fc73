import casadi as ca
import numpy as np

N = 1001
x, u = ca.MX.sym("x", 3), ca.MX.sym("u")
f = ca.Function("f", [x, u], [ca.vertcat(x[2] * ca.cos(u), -x[2] * ca.sin(u), 9.81 * ca.sin(u))])
problem = ca.Opti()
X, U, T = problem.variable(3, N), problem.variable(1, N), problem.variable()
F = f.map(N - 1)((X[:, 1:] + X[:, :-1]) / 2, (U[:, 1:] + U[:, :-1]) / 2)
problem.subject_to(ca.vec(X[:, 1:] - X[:, :-1] - T / (N - 1) * F) == 0)
problem.subject_to(problem.bounded(0, X[2, :], 50))
problem.subject_to(problem.bounded(-1.57, U, 1.57))
problem.subject_to(problem.bounded(0.5, T, 10))
problem.subject_to(X[:, 0] == 0)
problem.subject_to(X[:2, -1] == ca.vertcat(10, -6))
problem.minimize(T)
problem.set_initial(X, np.vstack([np.linspace(0, 10, N), np.linspace(0, -6, N), np.full(N, 5)]))
problem.set_initial(U, 0.5)
problem.set_initial(T, 2)
problem.solver("ipopt", {"expand": True, "print_time": False, "ipopt": {"print_level": 0, "sb": "yes", "tol": 1e-8}})
solution = problem.solve()
objective, iterations = solution.value(problem.f), solution.stats()["iter_count"]
