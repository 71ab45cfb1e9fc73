import casadi as ca
import numpy as np

N, h = 501, 10 / 500
x, u = ca.MX.sym("x", 2), ca.MX.sym("u")
f = ca.Function("f", [x, u], [ca.vertcat(x[1], u - 9.81 * ca.sin(x[0]))])
problem = ca.Opti()
X, U = problem.variable(2, N), problem.variable(1, N)
middle = (U[:, 1:] + U[:, :-1]) / 2
F = f.map(N - 1)((X[:, 1:] + X[:, :-1]) / 2, middle)
problem.subject_to(ca.vec(X[:, 1:] - X[:, :-1] - h * F) == 0)
problem.subject_to(problem.bounded(-2, U, 2))
problem.subject_to(X[:, 0] == 0)
problem.subject_to(X[:, -1] == ca.vertcat(np.pi, 0))
problem.minimize(h * ca.sumsqr(middle))
problem.set_initial(X[0, :], np.linspace(0, np.pi, N))
problem.solver("ipopt", {"expand": True, "print_time": False, "ipopt": {"print_level": 0, "sb": "yes", "tol": 1e-8}})
solution = problem.solve()
objective, iterations = solution.value(problem.f), solution.stats()["iter_count"]
