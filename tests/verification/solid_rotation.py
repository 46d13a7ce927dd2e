"""A disc (2D) and a spheroid (3D) of fluid rotate like a solid body in a central field of force: what they lose of
angular momentum and energy per turn, and the error of the pressure, at several spacings.

    solid_rotation.py [study]     the numbers of doc/verification.md

Exact: v = omega x r stays if grad p = rho (omega^2 r_perp - B^2 r), p = 0 at the surface; with B^2 = 2 omega^2 that is
p = rho omega^2 [(R^2 - r_perp^2) / 2 - z^2], on a spheroid of half axes R, R, R / sqrt(2).
"""

import sys
from math import pi

from _scene import Verification, read_summary, run

CENTRE_PRESSURE, TURNS = 2000, 2
THREE = {"Dimension": 3, "Body forces/Expression/Acceleration": "-8*x, -8*y, -8*z",
         "Body forces/Expression/Potential": "4*(x^2 + y^2 + z^2)",
         "Fluid/Pfem/Initial state/Shape": "ellipsoid(0, 0, 0; 1, 1, 0.7071067811865476)",
         "Fluid/Pfem/Initial state/Pressure": "2000*(1 - x^2 - y^2 - 2*z^2)",
         "Fluid/Pfem/Initial state/Velocity": "-2*y, 2*x, 0"}


def measure(dimension, spacing):
    history = run("verification/rotating_disc.prm", {
        "Fluid/Pfem/Spacing": spacing, "Output/Fields every": 0, "End time": TURNS * pi,
        **(THREE if dimension == 3 else {})})
    summary, angular = read_summary(), history["fluid angular momentum z [kg m^2/s]"]
    kinetic, pressure = history["kinetic energy [J]"], history["largest pressure [Pa]"]
    print(f"{dimension}D, spacing {spacing} m: {summary['n_remeshes']} remeshes, {summary['cpu_seconds']:.1f} CPU s, "
          f"energy lost per turn {(1 - history['total energy [J]'][-1] / history['total energy [J]'][0]) / TURNS:.2e}")
    verification.check(f"{dimension}D, spacing {spacing} m: relative mass drift",
                       summary["largest relative mass drift [-]"], 0, 1e-12)
    return {"angular momentum lost per turn": (1 - angular[-1] / angular[0]) / TURNS,
            "kinetic energy lost per turn": (1 - kinetic[-1] / kinetic[0]) / TURNS,
            "largest error of the largest pressure": max(abs(p / CENTRE_PRESSURE - 1) for p in pressure)}


verification = Verification()
cases = {2: (0.1, 0.05, 0.025), 3: (0.2, 0.14, 0.1)} if len(sys.argv) > 1 else {2: (0.1, 0.05), 3: (0.25, 0.18)}
for dimension, spacings in cases.items():
    results = [measure(dimension, spacing) for spacing in spacings]
    for name, bound in {"angular momentum lost per turn": 0.005, "kinetic energy lost per turn": 0.015,
                        "largest error of the largest pressure": 0.1}.items():
        rate = verification.rate(f"{dimension}D, {name}", spacings, [abs(result[name]) for result in results])
        verification.check(f"{dimension}D, {name}", abs(results[-1][name]), 0, bound)
        # the largest pressure of all nodes has the noise of single ones
        verification.check(f"{dimension}D, {name}: rate", rate, 0.6 if "pressure" in name else 1, 4)
verification.finish()
