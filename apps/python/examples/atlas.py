"""A workspace atlas over one parameter: exact areas of M1's workspaces as its platform grows, at three orientations.

PYTHONPATH=build/python /usr/bin/python3 apps/python/examples/atlas.py build/atlas.png
"""

import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import reprise

m1 = reprise.Manipulator.from_file(Path(__file__).resolve().parents[3] / "examples" / "M1.toml")
radii = np.linspace(0.1, 2, 400)
for degrees in (0, 15, 30):
    areas = [
        reprise.constant_orientation_workspace(reprise.collinear([-1, 0, 1, 2, r], m1.lengths), np.radians(degrees)).area
        for r in radii
    ]
    plt.plot(radii, areas, label=f"{degrees}°")
plt.axvline(1, color="#8c8c8c", linewidth=0.8)
plt.annotate("M1", (1, 0), xytext=(3, 3), textcoords="offset points")
plt.xlabel("r, half of the platform [length]")
plt.ylabel("area of the workspace [length²]")
plt.legend(title="orientation")
plt.savefig(sys.argv[1] if len(sys.argv) > 1 else "atlas.png", dpi=150)
