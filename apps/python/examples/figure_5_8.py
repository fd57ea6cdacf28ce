"""The best designs for the prescribed workspaces P2 and P3 of the thesis (Figure 5.8), with contours of kappa^-1.

PYTHONPATH=build/python /usr/bin/python3 apps/python/examples/figure_5_8.py build/figure_5_8.png
"""

import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import reprise

examples = Path(__file__).resolve().parents[3] / "examples"
figure, axes = plt.subplots(1, 2, figsize=(9, 4.8), layout="constrained")
for name, panel in zip(("P2", "P3"), axes):
    problem = reprise.read_problem(examples / f"{name}.toml")
    best = reprise.synthesize(problem)
    workspace = reprise.constant_orientation_workspace(best["manipulator"])
    for loops in workspace.boundary(0.01):
        for loop in loops:
            panel.fill(*loop.T, facecolor="none", edgecolor="#0072b2")
    outline = problem.outline(200)
    panel.fill(*outline.T, facecolor="none", edgecolor="#d55e00")
    x, y = np.meshgrid(*(np.linspace(low - 0.3, high + 0.3, 200) for low, high in zip(outline.min(0), outline.max(0))))
    levels = panel.contour(x, y, reprise.kappa_inverse(best["manipulator"], x, y), 8, colors="#8c8c8c", linewidths=0.8)
    panel.clabel(levels, fontsize=7)
    panel.set(title=f"{name}: least kappa$^{{-1}}$ {best['kappa_inverse']['lower']:.4f}", aspect="equal")
    panel.set(xlabel="x [length]", ylabel="y [length]", xlim=x[0, [0, -1]], ylim=y[[0, -1], 0])
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "figure_5_8.png", dpi=150)
