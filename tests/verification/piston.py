"""A piston on a fluid column against the exact frequency, added mass included, for densities of the solid from 0.01 to 10
of the fluid's. `piston.py study` refines the light one."""

import sys
from math import pi, sqrt, tan

from _scene import Verification, read_summary, run

FLUID_LENGTH, FLUID_SPEED, FLUID_DENSITY = 1.0, 50.0, 1000.0
SOLID_LENGTH, MODULUS = 0.2, 1e5


def exact_frequency(density):
    """First root omega [rad/s] of Z_f tan(omega L_f / c_f) = Z_s cot(omega L_s / c_s), by bisection."""
    speed = sqrt(MODULUS / density)

    def difference(omega):
        return (FLUID_DENSITY * FLUID_SPEED * tan(omega * FLUID_LENGTH / FLUID_SPEED) -
                density * speed / tan(omega * SOLID_LENGTH / speed))
    low, high = 1e-6, min(pi / 2 * FLUID_SPEED / FLUID_LENGTH, pi / 2 * speed / SOLID_LENGTH) * (1 - 1e-9)
    for _ in range(100):
        middle = (low + high) / 2
        low, high = (middle, high) if difference(middle) < 0 else (low, middle)
    return low


def measured_frequency(history):
    """From the zeros of the face's displacement between the first and the last one."""
    times, values = history["time [s]"], history["face displacement x [m]"]
    zeros = [a + (b - a) * u / (u - w) for a, b, u, w in zip(times, times[1:], values, values[1:]) if a > 0 and u * w < 0]
    return pi * (len(zeros) - 1) / (zeros[-1] - zeros[0])


def error(density, spacing):
    n = round(0.2 / spacing)
    history = run("verification/piston.prm", {
        "Fluid/Pfem/Spacing": spacing, "Structures/Piston/Mesh": f"box(1, 0; 1.2, 0.2; {n}, {n})",
        "Structures/Piston/Material/Linear elastic/Density": density})
    energy = history["total energy [J]"]
    exact, measured = exact_frequency(density), measured_frequency(history)
    print(f"density {density} kg/m^3, spacing {spacing} m: omega {measured:.4f}, exact {exact:.4f} rad/s, "
          f"energy kept {energy[-1] / energy[0]:.4f}, at most {max(energy) / energy[0]:.4f}, "
          f"m at most {max(history['interface substeps [-]']):.0f}, {read_summary()['cpu_seconds']:.1f} CPU s")
    return measured / exact - 1, max(energy) / energy[0] - 1


verification = Verification()
for density in (10, 100, 1000, 10000):
    deviation, made = error(density, 0.05)
    verification.check(f"density ratio {density / 1000}: relative error of the frequency", deviation, -0.02, 0.02)
    verification.check(f"density ratio {density / 1000}: energy made, relative", made, -1, 0.01)
if "study" in sys.argv:
    spacings = (0.1, 0.05, 0.025)
    for density in (10, 1000):
        errors = [abs(error(density, spacing)[0]) for spacing in spacings]
        verification.rate(f"frequency, density {density} kg/m^3", spacings, errors)
verification.finish()
