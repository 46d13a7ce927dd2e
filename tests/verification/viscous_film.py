"""The shear flow of a film on a floor to which it sticks decays, in 2D and 3D: error of the velocity in the middle.

    viscous_film.py [study]     the numbers of doc/verification.md

Exact for du/dt = nu d2u/dy2 with u = 0 on the floor and du/dy = 0 at the surface y = H:
u = U sin(pi y / (2 H)) exp(-nu (pi / (2 H))^2 t).
"""

import sys
from math import exp, pi, sin, sqrt

from _scene import Verification, read_summary, run
from _vtu import read_nodes

DEPTH, LENGTH, VISCOSITY, SPEED, TIME = 0.1, 3, 0.1, 0.01, 0.08  # m, m, m^2/s, m/s, s
THREE = {"Dimension": 3, "Body forces/Gravity/Acceleration": "0, -1, 0",
         "Fluid/Pfem/Initial state/Shape": "box(0, 0, 0; 3, 0.1, 0.1)",
         "Fluid/Pfem/Initial state/Velocity": "0.01*sin(5*pi*y), 0, 0",
         "Fluid/Pfem/Walls/Floor/Shape": "open box(-1, 0, -1; 4, 0.2, 1)",
         "Fluid/Pfem/Walls/Sides/Shape": "open box(0, -1, 0; 3, 0.2, 0.1)"}


def exact(y):
    k = pi / (2 * DEPTH)
    return SPEED * sin(k * y) * exp(-VISCOSITY * k**2 * TIME)


def error(dimension, spacing):
    """Error of the velocity, rms over the nodes near the middle, relative to the amplitude at the start."""
    run("verification/viscous_film.prm", {"Fluid/Pfem/Spacing": spacing, **(THREE if dimension == 3 else {})})
    nodes = [node for node in read_nodes("output/fluid-0002.vtu") if abs(node["position"][0] - LENGTH / 2) < DEPTH]
    print(f"{dimension}D, spacing {spacing} m: {len(nodes)} nodes near the middle, "
          f"{read_summary()['cpu_seconds']:.1f} CPU s")
    square = sum((node["velocity"][0] - exact(node["position"][1]))**2 for node in nodes) / len(nodes)
    return sqrt(square) / SPEED


verification = Verification()
n_spacings = 3 if len(sys.argv) > 1 else 2
for dimension, spacings in {2: (0.02, 0.01, 0.005), 3: (0.025, 0.018, 0.0125)}.items():
    spacings = spacings[:n_spacings]
    errors = [error(dimension, spacing) for spacing in spacings]
    rate = verification.rate(f"{dimension}D, velocity", spacings, errors)
    verification.check(f"{dimension}D, error of the velocity", errors[-1], 0, 1.5e-3)
    verification.check(f"{dimension}D, rate", rate, 1.3, 3)
verification.finish()
