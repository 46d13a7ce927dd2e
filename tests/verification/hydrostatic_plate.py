"""The deflection of an elastic plate under a column of water at rest against the exact static one of a thin clamped plate.
`hydrostatic_plate.py study` refines fluid and plate together."""

import sys

from _scene import Verification, read_summary, run


def exact_deflection(poissons_ratio):
    load = 9.81 * (1000 * 2 + 2700 * 0.05)  # [Pa]
    stiffness = 67.5e9 * 0.05**3 / (12 * (1 - poissons_ratio**2))  # D [N m]
    return -load / (384 * stiffness)


def error(spacing, poissons_ratio):
    n = round(0.5 / spacing)
    history = run("verification/hydrostatic_plate.prm", {
        "Fluid/Pfem/Spacing": spacing, "Structures/Plate/Mesh": f"box(0, -0.05; 1, 0; {n}, 1)",
        "Structures/Plate/Material/Linear elastic/Poisson's ratio": poissons_ratio})
    late = [u for t, u in zip(history["time [s]"], history["middle displacement y [m]"]) if t > 0.05]
    mean, exact = sum(late) / len(late), exact_deflection(poissons_ratio)
    print(f"spacing {spacing} m, Poisson's ratio {poissons_ratio}: deflection {mean:.4e} m, range "
          f"{max(late) - min(late):.1e} m, exact {exact:.4e} m, {read_summary()['cpu_seconds']:.1f} CPU s")
    return mean / exact - 1


verification = Verification()
if "study" in sys.argv:
    for spacing in (0.1, 0.05, 0.025):
        error(spacing, 0.34)
for poissons_ratio in (0.34, 0.3):
    verification.check(f"Poisson's ratio {poissons_ratio}: relative error of the deflection", error(0.05, poissons_ratio),
                       -0.02, 0.02)
verification.finish()
