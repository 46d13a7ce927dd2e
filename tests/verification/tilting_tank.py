"""Water in a tilting tank, its gravity an expression of time: the momentum of the sloshing against linear theory, at
three spacings. And a constant expression is gravity: the same history, digit by digit."""

import os
from math import cos, log2, pi, sin, tanh

from _scene import SOURCES, Verification, run

DENSITY, GRAVITY, LENGTH, DEPTH = 1000, 9.81, 0.4, 0.2
LARGEST_TILT, TILT_BEGIN, TILT_TIME = 0.02, 0.2, 0.5
SPACINGS = (0.02, 0.01, 0.005)


def tilt(time):
    """As in the parameter file [rad]."""
    part = min(max((time - TILT_BEGIN) / TILT_TIME, 0), 1)
    return LARGEST_TILT * (1 - cos(pi * part)) / 2


def exact_momentum(times):
    """Linear sloshing of an ideal fluid, elevation = sum q_n cos(k_n x), k_n = n pi / L, n odd:
    q_n'' = omega_n^2 (c_n - q_n), omega_n^2 = g k_n tanh(k_n H), c_n = -4 sin(tilt) / (L k_n^2) in balance.
    The momentum along the tank is rho sum q_n' (-2 / k_n^2) [kg m/s]. 19 modes, velocity Verlet of 0.2 ms."""
    step, momentum = 2e-4, [0.] * len(times)
    for k in (n * pi / LENGTH for n in range(1, 39, 2)):
        stiffness, force = GRAVITY * k * tanh(k * DEPTH), -4 / (LENGTH * k**2)
        q = v = done = 0
        for i, time in enumerate(times):
            for done in range(done, round(time / step)):
                v += step / 2 * stiffness * (force * sin(tilt(done * step)) - q)
                q += step * v
                v += step / 2 * stiffness * (force * sin(tilt((done + 1) * step)) - q)
            done = round(time / step)
            momentum[i] -= DENSITY * v * 2 / k**2
    return momentum


def error(spacing):
    """Largest error of the momentum, relative to its largest value."""
    history = run("verification/tilting_tank.prm", {"Fluid/Pfem/Spacing": spacing})
    exact = exact_momentum(history["time [s]"])
    computed = history["fluid momentum x [kg m/s]"]
    return max(abs(a - b) for a, b in zip(computed, exact)) / max(map(abs, exact))


def constant_expression_differs():
    """Number of differing values in the histories of a breaking dam under gravity and under the same expression."""
    with open(os.path.join(SOURCES, "parameter_files/cookbooks/dam_break.prm"), encoding="utf-8") as file:
        text = file.read()
    settings = {"Fluid/Pfem/Initial state/Pressure": "zero", "Fluid/Pfem/Spacing": 0.01, "End time": 0.4,
                "Output/Fields every": 0}
    gravity = run("cookbooks/dam_break.prm", settings, "gravity")
    text = text.replace("Models = gravity", "Models = expression")
    text = text.replace("subsection Gravity", "subsection Expression\n    set Potential = 9.81*y")
    with open("expression.prm", "w", encoding="utf-8") as file:
        file.write(text)
    expression = run(os.path.abspath("expression.prm"), settings, "expression")
    if gravity.keys() != expression.keys() or max(gravity["fluid momentum x [kg m/s]"]) <= 0:
        return float("inf")
    return sum(a != b for name in gravity for a, b in zip(gravity[name], expression[name]))


# Measured: 4.9e-2, 1.9e-2, 9.8e-3 until 1.6 s (1.2 periods after the tilt); rates 1.3 and 1.0.
verification = Verification()
errors = [error(spacing) for spacing in SPACINGS]
for spacing, value in zip(SPACINGS, errors):
    print(f"spacing {spacing} m: momentum error {value:.3e} of the largest momentum")
for coarse, fine in zip(errors, errors[1:]):
    print(f"rate: {log2(coarse / fine):.2f}")
verification.check("error at the finest spacing", errors[-1], 0, 0.015)
verification.check("its mean rate", log2(errors[0] / errors[-1]) / 2, 0.9, 2.5)
verification.check("values in which a constant expression differs from gravity", constant_expression_differs(), 0, 0)
verification.finish()
