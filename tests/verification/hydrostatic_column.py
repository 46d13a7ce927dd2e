"""Water at rest in a tank stays at rest for a second, its pressure that of the depth: errors at three spacings."""

from math import log2, sqrt

from _scene import Verification, run
from _vtu import read_nodes

DENSITY, GRAVITY, DEPTH, WIDTH, SOUND_SPEED = 1000, 9.81, 0.2, 0.2, 20
SPACINGS = (0.02, 0.01, 0.005)


def exact_pressure(y):
    """Hydrostatic pressure [Pa], to second order in compressibility."""
    head = GRAVITY * (DEPTH - y)
    return DENSITY * head * (1 + head / (2 * SOUND_SPEED**2))


def measure(spacing):
    """Pressure error at 1 s, rms over the nodes, relative to rho g H; largest kinetic over the potential energy."""
    history = run("verification/hydrostatic_column.prm", {"Fluid/Pfem/Spacing": spacing})
    nodes = read_nodes("output/fluid-0003.vtu")
    square = sum((node["pressure"] - exact_pressure(node["position"][1]))**2 for node in nodes) / len(nodes)
    potential = DENSITY * GRAVITY * WIDTH * DEPTH**2 / 2
    return sqrt(square) / (DENSITY * GRAVITY * DEPTH), max(history["kinetic energy [J]"]) / potential


# Measured: pressure 1.5e-4, 8.6e-5, 3.7e-5; kinetic energy 2.1e-9, 1.4e-9, 5e-10. Bounds: twice that.
verification = Verification()
errors, energies = zip(*(measure(spacing) for spacing in SPACINGS))
for spacing, error, energy in zip(SPACINGS, errors, energies):
    print(f"spacing {spacing} m: pressure error {error:.3e} rho g H, kinetic energy {energy:.3e} of the potential one")
for coarse, fine in zip(errors, errors[1:]):
    print(f"rate of the pressure error: {log2(coarse / fine):.2f}")
verification.check("pressure error at the finest spacing", errors[-1], 0, 8e-5)
verification.check("its mean rate", log2(errors[0] / errors[-1]) / 2, 0.7, 2.5)
verification.check("kinetic energy", max(energies), 0, 4e-9)
verification.finish()
