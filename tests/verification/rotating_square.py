"""A square patch of fluid in rotation, without any force. With tension it keeps together: angular momentum and energy
lost by 2 s, at several spacings. Without tension nothing holds it, and every node flies on straight on: the corners
come to R sqrt(1 + omega^2 t^2). With tension there are many remeshes: it is their cost that is measured. Without it,
the fluid expands without end, and what remeshes do to its angular momentum is erratic: the fewer the better."""

import sys
from math import hypot, sqrt

from _scene import Verification, read_summary, run
from _vtu import read_nodes

CORNER, ROTATION = sqrt(0.5), 1  # m, 1/s


def measure(spacing, tension):
    history = run("verification/rotating_square.prm", {
        "Fluid/Pfem/Spacing": spacing, "Fluid/Pfem/Tension": tension, "Output/Fields every": 1,
        "Fluid/Pfem/Remeshing/Largest strain": 0.03 if tension == "allowed" else 0.2})
    summary = read_summary()
    verification.check(f"spacing {spacing} m: relative mass drift", summary["largest relative mass drift [-]"], 0, 1e-12)
    momentum = max(abs(p) for axis in "xy" for p in history[f"fluid momentum {axis} [kg m/s]"])
    verification.check(f"spacing {spacing} m: momentum made, of mass times speed",
                       momentum / history["fluid mass [kg]"][0] / CORNER / ROTATION, 0, 1e-12)
    print(f"tension {tension}, spacing {spacing} m: {summary['n_remeshes']} remeshes, "
          f"{summary['cpu_seconds']:.1f} CPU s, largest deficit {summary['largest_interior_volume_deficit']:.4f}")
    return {"angular momentum lost": 1 - history["fluid angular momentum z [kg m^2/s]"][-1]
            / history["fluid angular momentum z [kg m^2/s]"][0],
            "energy lost": 1 - history["total energy [J]"][-1] / history["total energy [J]"][0]}


verification = Verification()
spacings = (0.04, 0.02, 0.01) if len(sys.argv) > 1 else (0.04, 0.02)
bounds = {"allowed": {"angular momentum lost": 0.006, "energy lost": 0.01},
          "none": {"angular momentum lost": 0.05, "energy lost": 0.02}}
for tension, largest in bounds.items():
    results = [measure(spacing, tension) for spacing in spacings]
    for name, bound in largest.items():
        verification.rate(f"tension {tension}, {name}", spacings, [abs(result[name]) for result in results])
        verification.check(f"tension {tension}, {name}", abs(results[-1][name]), 0, bound)
farthest = max(hypot(*node["position"][:2]) for node in read_nodes("output/fluid-0003.vtu"))
verification.check("without tension, place of the corners over the exact one", farthest / CORNER / sqrt(1 + 2**2),
                   0.96, 1.001)
verification.finish()
