"""Dynamic-Q against SciPy's SLSQP on a problem of the user's: the lightest two-bar truss.

The bars lead from two supports at (-1, 0) and (1, 0) to a joint at (0, h), where a load pulls down. Variables: the bars'
cross-section a and the height h. The weight is least, the stress at most 1. The optimum is known: h = 1, a = 1/sqrt(2).

PYTHONPATH=build/python /usr/bin/python3 apps/python/examples/own_problem.py build/own_problem.png
"""

import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from scipy.optimize import minimize

import reprise


def weight(v):
    return 2 * v[0] * np.hypot(1, v[1])


stress = {"type": "ineq", "fun": lambda v: v[0] - np.hypot(1, v[1]) / (2 * v[1])}
settings = dict(x0=[2.0, 0.3], bounds=[(0.1, 5), (0.1, 5)], constraints=stress)

for method, name in (("SLSQP", "SciPy's SLSQP"), (reprise.minimize, "Dynamic-Q")):
    path = [settings["x0"]]
    result = minimize(weight, method=method, callback=lambda v: path.append(v.copy()), **settings)
    print(f"{name}: {result.message}, a = {result.x[0]:.6f}, h = {result.x[1]:.6f}, {result.nfev} evaluations")
    plt.semilogy([abs(weight(v) - 2) + 1e-16 for v in path], "o-", label=name)
plt.xlabel("iterate")
plt.ylabel("distance of the weight from 2, its optimum")
plt.legend()
plt.savefig(sys.argv[1] if len(sys.argv) > 1 else "own_problem.png", dpi=150)
