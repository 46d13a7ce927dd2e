"""A drop in a central field of force oscillates as an ellipse (2D) or ellipsoid (3D): potential and kinetic energy,
which are the semi-axes and their speeds, pressure, and angular momentum, against the exact motion.

    oscillating_drop.py [study]     the numbers of doc/verification.md

Exact motion of an incompressible drop: x_i = a_i(t) / a_i(0) X_i in each direction i. Then the acceleration is
x_i a_i'' / a_i, and p = q (1 - sum x_i^2 / a_i^2), zero on the surface, gives a_i'' = 2 q / (rho a_i) - B^2 a_i. That
the volume stays, sum a_i' / a_i = 0, gives 2 q / rho sum 1 / a_i^2 = sum (a_i' / a_i)^2 + dim B^2. (In 2D: J. J.
Monaghan and A. Rafiee, Int. J. Numer. Meth. Fluids 71 (2013) 537.)
"""

import sys
from math import pi, sqrt

from _exact import runge_kutta
from _scene import Verification, read_summary, run

RADIUS, DENSITY, FORCE = 1, 1000, 1  # B = 1/s
RATES = {2: (1, -1), 3: (1, -0.5, -0.5)}  # a_i' at the start [m/s]


def pressure_of(axes, speeds):
    """2 q / rho [m^2/s^2], q the pressure at the centre"""
    return ((sum((v / a)**2 for a, v in zip(axes, speeds)) + len(axes) * FORCE**2) / sum(1 / a**2 for a in axes))


def slope(state):
    n = len(state) // 2
    axes, speeds = state[:n], state[n:]
    q = pressure_of(axes, speeds)
    return [*speeds, *(q / a - FORCE**2 * a for a in axes)]


def rms(errors):
    return sqrt(sum(e * e for e in errors) / len(errors))


def measure(dimension, spacing, settings):
    """Errors of one run, relative to the potential energy at the start, and to the largest pressure."""
    extra = {} if dimension == 2 else {
        "Dimension": 3, "Body forces/Expression/Acceleration": "-x, -y, -z",
        "Body forces/Expression/Potential": "0.5*(x^2 + y^2 + z^2)",
        "Fluid/Pfem/Initial state/Shape": "sphere(0, 0, 0; 1)",
        "Fluid/Pfem/Initial state/Pressure": "750*(1 - x^2 - y^2 - z^2)",
        "Fluid/Pfem/Initial state/Velocity": "x, -0.5*y, -0.5*z"}
    history = run("verification/oscillating_drop.prm", {"Fluid/Pfem/Spacing": spacing, **extra, **settings})
    times, mass = history["time [s]"], history["fluid mass [kg]"][0]
    states = runge_kutta(slope, [RADIUS] * dimension + list(RATES[dimension]), times)
    # the mean of x^2 over an ellipse is a^2 / 4, over an ellipsoid a^2 / 5
    part = mass / (dimension + 2) / 2
    exact = {"potential": [part * FORCE**2 * sum(a * a for a in s[:dimension]) for s in states],
             "kinetic": [part * sum(v * v for v in s[dimension:]) for s in states]}
    start = exact["potential"][0]
    errors = {f"{name} energy": rms([(computed - e) / start for computed, e in
                                     zip(history[f"{name} energy [J]"], values)]) for name, values in exact.items()}
    # the largest pressure of history.csv is the noisiest there is
    pressures = [DENSITY / 2 * pressure_of(s[:dimension], s[dimension:]) for s in states]
    errors["pressure at the centre"] = rms([(p - e) / max(pressures) for p, e in
                                            zip(history["largest pressure [Pa]"], pressures)])
    total = history["total energy [J]"]
    errors["energy lost"] = 1 - total[-1] / total[0]
    verification.check(f"{dimension}D, spacing {spacing} m: energy gained", max(total) / total[0] - 1, 0, 1e-3)
    print(f"{dimension}D, spacing {spacing} m: {read_summary()['n_remeshes']} remeshes, "
          f"{read_summary()['cpu_seconds']:.1f} CPU s, mass {mass / DENSITY / (pi * (4 / 3 if dimension == 3 else 1)):.4f} "
          f"of the exact, largest deficit {read_summary()['largest_interior_volume_deficit']:.4f}")
    return errors


verification = Verification()
if len(sys.argv) > 1:
    cases, settings = {2: (0.1, 0.05, 0.025), 3: (0.2, 0.1, 0.07)}, {"Output/Fields every": 0}
else:
    cases, settings = {2: (0.1, 0.05), 3: (0.2, 0.1)}, {"Output/Fields every": 0, "End time": 4}
for dimension, spacings in cases.items():
    results = [measure(dimension, spacing, settings) for spacing in spacings]
    for name, bound in {"potential energy": 0.03, "kinetic energy": 0.01, "pressure at the centre": 0.1,
                        "energy lost": 0.02}.items():
        rate = verification.rate(f"{dimension}D, {name}", spacings, [result[name] for result in results])
        verification.check(f"{dimension}D, {name}: error", results[-1][name], 0, bound)
        # the largest pressure of all nodes has the noise of single ones, which falls with the spacing at best
        verification.check(f"{dimension}D, {name}: rate", rate, 0.7 if name.startswith("pressure") else 1, 3.5)
verification.finish()
