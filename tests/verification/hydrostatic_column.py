"""Water at rest in a tank stays at rest, its pressure that of the depth: errors at three spacings after a second, and
after ten seconds, 40 cells deep in 2D and 10 in 3D."""

from math import log2, sqrt

from _scene import Verification, run
from _vtu import read_nodes

DENSITY, GRAVITY, DEPTH, SOUND_SPEED = 1000, 9.81, 0.2, 20
SPACINGS = (0.02, 0.01, 0.005)


def exact_pressure(y):
    """Hydrostatic pressure [Pa], to second order in compressibility."""
    head = GRAVITY * (DEPTH - y)
    return DENSITY * head * (1 + head / (2 * SOUND_SPEED**2))


def measure(spacing, settings=None):
    """Pressure error at the end, rms over the nodes, relative to rho g H; largest kinetic over the potential energy."""
    history = run("verification/hydrostatic_column.prm", {"Fluid/Pfem/Spacing": spacing, **(settings or {})})
    nodes = read_nodes("output/fluid-0003.vtu")
    square = sum((node["pressure"] - exact_pressure(node["position"][1]))**2 for node in nodes) / len(nodes)
    kinetic = max(history["kinetic energy [J]"]) / history["potential energy [J]"][0]
    return sqrt(square) / (DENSITY * GRAVITY * DEPTH), kinetic


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

LONG = {"End time": 10, "Output/Fields every": 5}
TANKS = {"2D": (0.005, {"Fluid/Pfem/Initial state/Shape": "box(0, 0; 0.1, 0.2)",
                        "Fluid/Pfem/Walls/Tank/Shape": "open box(0, 0; 0.1, 0.3)"}),
         "3D": (0.02, {"Dimension": 3, "Body forces/Gravity/Acceleration": "0, -9.81, 0",
                       "Fluid/Pfem/Initial state/Shape": "box(0, 0, 0; 0.1, 0.2, 0.1)",
                       "Fluid/Pfem/Walls/Tank/Shape": "open box(0, 0, 0; 0.1, 0.3, 0.1)"})}
for title, (spacing, settings) in TANKS.items():
    error, energy = measure(spacing, {**LONG, **settings})
    verification.check(f"{title}, 10 s, pressure error", error, 0, 1e-2)
    verification.check(f"{title}, 10 s, kinetic energy", energy, 0, 1e-6)
verification.finish()
