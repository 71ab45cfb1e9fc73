import casadi as ca
from vyasarayani_data import N, noisy, step

x, p = ca.MX.sym("x", 2), ca.MX.sym("p")
f = ca.Function("f", [x, p], [ca.vertcat(x[1], -p * ca.sin(x[0]))])
problem = ca.Opti()
X, P = problem.variable(2, N), problem.variable()
F = f.map(N - 1)((X[:, 1:] + X[:, :-1]) / 2, ca.repmat(P, 1, N - 1))
problem.subject_to(ca.vec(X[:, 1:] - X[:, :-1] - step * F) == 0)
problem.subject_to(problem.bounded(0.1, P, 100))
problem.minimize(step * ca.sumsqr(X[0, :].T - noisy[0]))
problem.set_initial(X, noisy)
problem.set_initial(P, 11)
problem.solver("ipopt", {"expand": True, "print_time": False, "ipopt": {"print_level": 0, "sb": "yes", "tol": 1e-8}})
solution = problem.solve()
objective, iterations = solution.value(P), solution.stats()["iter_count"]
