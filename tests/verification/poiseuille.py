"""Poiseuille flow between two plates that starts from rest, in the middle of a long plug, in 2D and 3D: error of the
velocity at several spacings, while it develops and when it has nearly developed.

    poiseuille.py [study]     the numbers of doc/verification.md

Exact (G. K. Batchelor, An Introduction to Fluid Dynamics, section 4.3, for plates at x = 0 and W):
v = -g / (2 nu) x (W - x) + sum over odd n of 4 g W^2 / (nu pi^3 n^3) sin(n pi x / W) exp(-nu n^2 pi^2 t / W^2).
"""

import sys
from math import exp, pi, sin, sqrt

from _scene import Verification, read_summary, run
from _vtu import read_nodes

WIDTH, LENGTH, GRAVITY, VISCOSITY = 0.1, 1.2, 1, 0.1  # m, m, m/s^2, m^2/s
LARGEST = GRAVITY * WIDTH**2 / 8 / VISCOSITY
TIMES = (0.01, 0.05)
THREE = {"Dimension": 3, "Body forces/Gravity/Acceleration": "0, -1, 0",
         "Fluid/Pfem/Initial state/Shape": "box(0, 0, 0; 0.1, 1.2, 0.1)",
         "Fluid/Pfem/Walls/Plates/Shape": "box(0, -1, -1; 0.1, 2, 1)"}


def exact(x, t):
    return -GRAVITY / (2 * VISCOSITY) * x * (WIDTH - x) + sum(
        4 * GRAVITY * WIDTH**2 / (VISCOSITY * (pi * n)**3) * sin(n * pi * x / WIDTH)
        * exp(-VISCOSITY * (n * pi / WIDTH)**2 * t) for n in range(1, 40, 2))


def measure(dimension, spacing, time):
    run("verification/poiseuille.prm", {"Fluid/Pfem/Spacing": spacing, "End time": time, "Output/Fields every": time,
                                        **(THREE if dimension == 3 else {})})
    nodes = [node for node in read_nodes("output/fluid-0002.vtu") if abs(node["position"][1] - LENGTH / 2) < WIDTH]
    print(f"{dimension}D, spacing {spacing} m: {len(nodes)} nodes, {read_summary()['cpu_seconds']:.1f} CPU s")
    return sqrt(sum((node["velocity"][1] - exact(node["position"][0], time))**2 for node in nodes) / len(nodes)) / LARGEST


verification = Verification()
n_spacings = 3 if len(sys.argv) > 1 else 2
for dimension, spacings in {2: (0.02, 0.01, 0.005), 3: (0.02, 0.014, 0.01)}.items():
    spacings = spacings[:n_spacings]
    for time in TIMES:
        errors = [measure(dimension, spacing, time) for spacing in spacings]
        rate = verification.rate(f"{dimension}D, velocity at {time} s, of the largest", spacings, errors)
        verification.check(f"{dimension}D, error of the velocity at {time} s", errors[-1], 0, 0.015)
        verification.check(f"{dimension}D, its rate", rate, 1.2, 4)
verification.finish()
