"""The flow in a closed channel under a moving lid, its walls with Navier slip: the velocity profile far from the ends
against the exact one, errors at three spacings and the rate."""

from math import log2, sqrt

from _scene import Verification, run
from _vtu import read_nodes

HEIGHT, LENGTH, SPEED, SLIP_LENGTH = 0.1, 0.6, 0.02, 0.02
SPACINGS = (0.02, 0.01, 0.005)


def exact_velocity():
    """u = A y^2 + B y + b B from u'' = const with u = b u' at the floor, U - u = b u' at the lid, and no net flow."""
    h, b = HEIGHT, SLIP_LENGTH
    lid = (h**2 + 2 * b * h, h + 2 * b)      # times A and B: U
    flow = (h**3 / 3, h**2 / 2 + b * h)      # times A and B: 0
    determinant = lid[0] * flow[1] - lid[1] * flow[0]
    A, B = SPEED * flow[1] / determinant, -SPEED * flow[0] / determinant
    return lambda y: A * y**2 + B * y + b * B


def error(spacing):
    """Root mean square error of the velocity along the channel in its middle fifth, relative to the lid's."""
    run("verification/navier_slip.prm", {"Fluid/Pfem/Spacing": spacing})
    exact = exact_velocity()
    squares = [(node["velocity"][0] - exact(node["position"][1]))**2 for node in read_nodes("output/fluid-0002.vtu")
               if abs(node["position"][0] - LENGTH / 2) < LENGTH / 10]
    return sqrt(sum(squares) / len(squares)) / SPEED


# Measured: 2.9e-2, 4.5e-3, 1.8e-3; rates 2.7 and 1.3.
verification = Verification()
errors = [error(spacing) for spacing in SPACINGS]
for spacing, value in zip(SPACINGS, errors):
    print(f"spacing {spacing} m: error of the velocity {value:.3e} of the lid's")
for coarse, fine in zip(errors, errors[1:]):
    print(f"rate: {log2(coarse / fine):.2f}")
verification.check("error at the finest spacing", errors[-1], 0, 0.004)
verification.check("its mean rate", log2(errors[0] / errors[-1]) / 2, 1.5, 3)
verification.finish()
