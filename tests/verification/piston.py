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


IN_3D = {"Dimension": 3, "Fluid/Pfem/Initial state/Shape": "box(0, 0, 0; 1, 0.2, 0.2)",
         "Fluid/Pfem/Initial state/Velocity": "1e-4, 0, 0", "Fluid/Pfem/Walls/Tube/Shape": "box(-1, 0, 0; 2, 0.2, 0.2)",
         "Structures/Piston/Initial velocity": "1e-4*(1.2-x)/0.2, 0, 0", "Output/Probes": "face: Piston(1, 0.1, 0.1)"}


def error(density, spacing, dim=2, settings=None):
    n = round(0.2 / spacing)
    mesh = f"box(1, 0; 1.2, 0.2; {n}, {n})" if dim == 2 else f"box(1, 0, 0; 1.2, 0.2, 0.2; {n}, {n}, {n})"
    history = run("verification/piston.prm", {
        **(IN_3D if dim == 3 else {}), "Fluid/Pfem/Spacing": spacing, "Structures/Piston/Mesh": mesh,
        "Structures/Piston/Material/Linear elastic/Density": density, **(settings or {})})
    energy = history["total energy [J]"]
    exact, measured = exact_frequency(density), measured_frequency(history)
    print(f"{dim}D, density {density} kg/m^3, spacing {spacing} m: omega {measured:.4f}, exact {exact:.4f} rad/s, "
          f"energy kept {energy[-1] / energy[0]:.4f}, at most {max(energy) / energy[0]:.4f}, "
          f"m at most {max(history['interface substeps [-]']):.0f}, {read_summary()['cpu_seconds']:.1f} CPU s")
    return measured / exact - 1, max(energy) / energy[0] - 1, energy[-1] / energy[0] - 1


verification = Verification()
for density in (10, 100, 1000, 10000):
    deviation, made, _ = error(density, 0.05)
    verification.check(f"density ratio {density / 1000}: relative error of the frequency", deviation, -0.01, 0.01)
    verification.check(f"density ratio {density / 1000}: energy made, relative", made, -1, 1e-4)
# Without the fluid's dissipation: the nodes of the piston on the wall may make no energy.
section = "Fluid/Pfem/Stabilization"
inviscid = {f"{section}/Density diffusion": 0, f"{section}/Velocity filter": 0, f"{section}/Divergence filter": 0}
for dim in (2, 3):
    _, made, left = error(10, 0.1, dim, inviscid)
    verification.check(f"{dim}D, nothing dissipates: energy made, relative", made, -1, 1e-4)
    verification.check(f"{dim}D, nothing dissipates: change of the energy, relative", left, -1e-4, 1e-4)
if "study" in sys.argv:
    spacings = (0.1, 0.05, 0.025)
    for density in (10, 1000):
        errors = [abs(error(density, spacing)[0]) for spacing in spacings]
        verification.rate(f"frequency, density {density} kg/m^3", spacings, errors)
verification.finish()
