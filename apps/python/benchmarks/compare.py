"""Speed beside numpy and SciPy, in one run: kappa^-1 at many poses, exact areas, and the synthesis for P2.

PYTHONPATH=build/python /usr/bin/python3 apps/python/benchmarks/compare.py

Times are the least of several runs, of one thread where it can be chosen. Each pair answers the same question.
"""

import math
import os
import time
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
import numpy as np
from scipy.optimize import minimize

import reprise

examples = Path(__file__).resolve().parents[3] / "examples"
m1 = reprise.Manipulator.from_file(examples / "M1.toml")


def seconds(function, repetitions=5):
    times = []
    for _ in range(repetitions):
        begin = time.perf_counter()
        function()
        times.append(time.perf_counter() - begin)
    return min(times)


def numpy_kappa_inverse(manipulator, x, y, phi):
    """The printed normalisation, eq. (5.13): 3 legs, rows [s_x, s_y, p x s] of unit vectors; 3 / (|J|_F |J^-1|_F)."""
    c, s = math.cos(phi), math.sin(phi)
    rows = []
    for base, platform in zip(manipulator.base_joints, manipulator.platform_joints):
        px, py = c * platform[0] - s * platform[1], s * platform[0] + c * platform[1]
        dx, dy = x + px - base[0], y + py - base[1]
        length = np.sqrt(dx * dx + dy * dy)
        dx /= length
        dy /= length
        rows.append((dx, dy, px * dy - py * dx))
    (a, b, c1), (d, e, f), (g, h, i) = rows
    cofactors = [
        e * i - f * h, c1 * h - b * i, b * f - c1 * e,
        f * g - d * i, a * i - c1 * g, c1 * d - a * f,
        d * h - e * g, b * g - a * h, a * e - b * d,
    ]
    determinant = a * cofactors[0] + b * cofactors[3] + c1 * cofactors[6]
    size = sum(v * v for row in rows for v in row)
    return 3 * np.abs(determinant) / np.sqrt(size * sum(v * v for v in cofactors))


def kappa():
    random = np.random.default_rng(1)
    x, y = random.uniform(0.3, 1.7, (2, 1_000_000))
    ours = reprise.kappa_inverse(m1, x, y)
    difference = np.abs(ours - numpy_kappa_inverse(m1, x, y, 0.0)).max()
    return (
        f"kappa^-1 at 1e6 positions (largest difference {difference:.1e})",
        seconds(lambda: reprise.kappa_inverse(m1, x, y)),
        seconds(lambda: numpy_kappa_inverse(m1, x, y, 0.0)),
    )


def areas():
    exact = reprise.constant_orientation_workspace(m1).area

    def grid(n=2200):
        x = (np.arange(n)[:, None] + 0.5) * 2 / n
        y = (np.arange(n)[None, :] + 0.5) * 4 / n - 2
        inside = True
        for base, platform, (low, high) in zip(m1.base_joints, m1.platform_joints, m1.lengths):
            square = (x + platform[0] - base[0]) ** 2 + (y + platform[1] - base[1]) ** 2
            inside = inside & (square >= low * low) & (square <= high * high)
        return inside.mean() * 8

    def many():
        for _ in range(1000):
            reprise.constant_orientation_workspace(m1)

    error = abs(grid() - exact)
    return f"area of M1's workspace (grid of numpy: error {error:.0e})", seconds(many) / 1000, seconds(grid, 3)


def synthesis(points=1000):
    problem = reprise.read_problem(examples / "P2.toml")
    outline = problem.outline(points)
    x, y = outline[:, 0], outline[:, 1]
    limits = problem.manipulator.lengths

    def rows(v):
        """kappa^-2 and the squared lengths at all points, with their exact derivatives by v from complex steps."""
        x_c, y_c, x_d, x_e, r = v[:5]
        base = [(x_c, y_c), (x_d, y_c), (x_e, y_c)]
        sides = [-r, -r, r]
        out, j = [], []
        for (bx, by), side in zip(base, sides):
            dx, dy = x + side - bx, y - by
            square = dx * dx + dy * dy
            length = np.sqrt(square)
            out.append(square)
            j.append((dx / length, dy / length, side * dy / length))
        (a, b, c), (d, e, f), (g, h, i) = j
        cofactors = [
            e * i - f * h, c * h - b * i, b * f - c * e, f * g - d * i, a * i - c * g, c * d - a * f,
            d * h - e * g, b * g - a * h, a * e - b * d,
        ]
        determinant = a * cofactors[0] + b * cofactors[3] + c * cofactors[6]
        size = sum(t * t for row in j for t in row)
        return 9 * determinant**2 / (size * sum(t * t for t in cofactors)), out

    def constraints(v):
        square, lengths = rows(v)
        parts = [square - v[5] ** 2]
        for length, (low, high) in zip(lengths, limits):
            parts += [length - low * low, high * high - length]
        return np.concatenate(parts)

    def jacobian(v):
        result = np.empty((7 * len(x), 6))
        for k in range(6):
            moved = v.astype(complex)
            moved[k] += 1e-30j
            result[:, k] = constraints(moved).imag / 1e-30
        return result

    start = np.append(problem.design, 0.5)
    settings = dict(jac=lambda v: np.array([0, 0, 0, 0, 0, -1.0]), method="SLSQP", options={"ftol": 1e-12, "maxiter": 200})

    def scipy():
        return minimize(lambda v: -v[5], start, constraints={"type": "ineq", "fun": constraints, "jac": jacobian}, **settings)

    ours = reprise.synthesize(problem, points=points)["kappa_inverse"]["upper"]
    theirs = scipy().x[5]
    return (
        f"synthesis for P2, {points} points, proof included (optima {ours:.7f} and {theirs:.7f})",
        seconds(lambda: reprise.synthesize(problem, points=points)),
        seconds(scipy, 3),
    )


print(f"{'':<78} {'reprise':>10} {'other':>10} {'ratio':>8}")
for measure in (kappa, areas, synthesis):
    what, own, other = measure()
    print(f"{what:<78} {own:>8.2e} s {other:>8.2e} s {other / own:>7.1f}")
