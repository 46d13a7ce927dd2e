"""The shear flow of a film on a floor decays, in 2D and 3D, where it sticks to the floor (half of a Poiseuille flow) and
in 2D where it slips with friction (Navier): error of the velocity in the middle.

    viscous_film.py [study]     the numbers of doc/verification.md

Exact for du/dt = nu d2u/dy2 with u = b du/dy on the floor (b the slip length, 0: no slip) and du/dy = 0 at the surface
y = H: u = U cos(k (H - y)) exp(-nu k^2 t), where k b tan(k H) = 1; for b = 0 k = pi / (2 H).
"""

import sys
from math import cos, exp, pi, sqrt, tan

from _exact import root
from _scene import Verification, read_summary, run
from _vtu import read_nodes

DEPTH, VISCOSITY, SPEED, TIME = 0.1, 0.1, 0.01, 0.08  # m, m^2/s, m/s, s
LENGTH = {2: 6, 3: 3}  # m
THREE = {"Dimension": 3, "Body forces/Gravity/Acceleration": "0, -1, 0",
         "Fluid/Pfem/Initial state/Shape": "box(0, 0, 0; 3, 0.1, 0.1)",
         "Fluid/Pfem/Walls/Floor/Shape": "open box(-1, 0, -1; 4, 0.2, 1)",
         "Fluid/Pfem/Walls/Sides/Shape": "open box(0, -1, 0; 3, 0.2, 0.1)"}


def wave_number(slip_length):
    """k [1/m] of the slowest decay"""
    if slip_length == 0:
        return pi / (2 * DEPTH)
    return root(lambda k: k * slip_length * tan(k * DEPTH) - 1, 1e-6 / DEPTH, (pi / 2 - 1e-9) / DEPTH)


def error(dimension, spacing, slip_length):
    """Error of the velocity, rms over the nodes near the middle, relative to the amplitude at the start."""
    k = wave_number(slip_length)
    settings = dict(THREE) if dimension == 3 else {}
    settings["Fluid/Pfem/Initial state/Velocity"] = f"{SPEED}*cos({k}*({DEPTH} - y)), 0" + (", 0" if dimension == 3 else "")
    if slip_length > 0:
        settings.update({"Fluid/Pfem/Walls/Floor/Law": "navier slip", "Fluid/Pfem/Walls/Floor/Slip length": slip_length})
    run("verification/viscous_film.prm", {"Fluid/Pfem/Spacing": spacing, **settings})
    nodes = [node for node in read_nodes("output/fluid-0002.vtu") if abs(node["position"][0] - LENGTH[dimension] / 2) < DEPTH]
    print(f"{dimension}D, spacing {spacing} m: {len(nodes)} nodes near the middle, "
          f"{read_summary()['cpu_seconds']:.1f} CPU s")
    amplitude = SPEED * exp(-VISCOSITY * k**2 * TIME)
    square = sum((node["velocity"][0] - amplitude * cos(k * (DEPTH - node["position"][1])))**2 for node in nodes)
    return sqrt(square / len(nodes)) / SPEED


verification = Verification()
n_spacings = 3 if len(sys.argv) > 1 else 2
for dimension, spacings, slip_length in ((2, (0.02, 0.01, 0.005), 0), (2, (0.02, 0.01, 0.005), DEPTH),
                                         (3, (0.025, 0.018, 0.0125), 0)):
    title = f"{dimension}D, slip length {slip_length} m"
    errors = [error(dimension, spacing, slip_length) for spacing in spacings[:n_spacings]]
    rate = verification.rate(f"{title}, velocity", spacings[:n_spacings], errors)
    verification.check(f"{title}, error of the velocity", errors[-1], 0, 1.5e-3)
    verification.check(f"{title}, rate", rate, 1.3, 3)
verification.finish()
