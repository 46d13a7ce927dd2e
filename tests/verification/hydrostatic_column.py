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


# Measured: pressure 1.8e-5, 1.0e-5, 1.0e-5; kinetic energy 5.6e-11, 8.7e-12, 1.1e-12 of the potential one. What is
# left of the pressure error at fine spacings is the initial state's: hydrostatics to second order in compressibility.
verification = Verification()
errors, energies = zip(*(measure(spacing) for spacing in SPACINGS))
for spacing, error, energy in zip(SPACINGS, errors, energies):
    print(f"spacing {spacing} m: pressure error {error:.3e} rho g H, kinetic energy {energy:.3e} of the potential one")
for name, values in (("pressure error", errors), ("kinetic energy", energies)):
    for coarse, fine in zip(values, values[1:]):
        print(f"rate of the {name}: {log2(coarse / fine):.2f}")
verification.check("largest pressure error", max(errors), 0, 4e-5)
verification.check("pressure error, finest over coarsest", errors[-1] / errors[0], 0, 1)
verification.check("largest kinetic energy", max(energies), 0, 2e-10)
verification.check("rate of the kinetic energy", log2(energies[0] / energies[-1]) / 2, 1.5, 6)
verification.finish()
