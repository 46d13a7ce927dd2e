"""Free slip of a fluid at structures: a layer that slides along a plate pushes it in normal direction only, all momentum
is accounted for, and the obstacle in a dam break bends as with no slip. `free_slip.py study` refines the layer."""

import sys

from _scene import Verification, read_summary, run


def slide(law, spacing=0.01):
    """Impulse on the plate along it, and what of the fluid's momentum is missing, over the fluid's momentum [-]; the
    force across the plate in the second half of the time, over the fluid's weight [-]."""
    history = run("verification/sliding_layer.prm", {
        "Fluid/Pfem/Law at structures": law, "Fluid/Pfem/Spacing": spacing,
        "Structures/Plate/Mesh": f"box(-0.5, -0.02; 1.5, 0; {round(2 / spacing)}, 2)"})
    momentum = history["fluid momentum x [kg m/s]"]
    impulse = 0.01 * sum(history["force on Plate x [N]"])  # means over a row of 10 ms
    weight = 9.81 * history["fluid mass [kg]"][-1]
    late = history["force on Plate y [N]"][len(history["time [s]"]) // 2:]
    pressed = -sum(late) / len(late) / weight
    left_out = history.get("impulse left out along structures x [kg m/s]", [0])[-1]
    print(f"{law}, spacing {spacing} m: the fluid loses {1 - momentum[-1] / momentum[0]:.4f} of its momentum, the plate "
          f"gets {impulse / momentum[0]:.2e}, {left_out / momentum[0]:.4f} is left out, "
          f"{pressed:.3f} of the fluid's weight is on the plate, {read_summary()['cpu_seconds']:.1f} CPU s")
    return impulse / momentum[0], (momentum[-1] + impulse + left_out) / momentum[0] - 1, pressed


def slide_between(law):
    """The impulses along x on the plate and on a lid above, over the fluid's momentum [-]."""
    lid = {"Mesh": "box(-0.5, 0.1; 1.5, 0.12; 200, 2)", "Degree": 1, "Clamp": "top", "Wet boundaries": "bottom",
           "Material/Model": "linear elastic", "Material/Linear elastic/Density": 5000,
           "Material/Linear elastic/Young's modulus": 1e8, "Material/Linear elastic/Poisson's ratio": 0}
    history = run("verification/sliding_layer.prm", {
        "Fluid/Pfem/Law at structures": law, "End time": 0.05,
        **{f"Structures/Lid/{entry}": value for entry, value in lid.items()}})
    return [0.01 * sum(history[f"force on {name} x [N]"]) / history["fluid momentum x [kg m/s]"][0]
            for name in ("Plate", "Lid")]


verification = Verification()
if "study" in sys.argv:
    for law in ("no slip", "free slip"):
        for spacing in (0.01, 0.005, 0.0025):
            slide(law, spacing)
impulse, missing, pressed = slide("no slip")
verification.check("no slip: impulse on the plate", impulse, 0.1, 0.4)
verification.check("no slip: missing momentum", missing, -1e-3, 1e-3)
impulse, missing, pressed = slide("free slip")
verification.check("free slip: force across the plate over the fluid's weight", pressed, 0.9, 1.1)
verification.check("free slip: impulse on the plate", impulse, -1e-5, 1e-5)
verification.check("free slip: missing momentum", missing, -1e-3, 1e-3)

plate, lid = slide_between("Plate: free slip")
verification.check("free slip at the plate only: impulse on the plate", plate, -1e-5, 1e-5)
verification.check("free slip at the plate only: impulse on the lid", lid, 0.02, 0.4)
plate, lid = slide_between("Lid: free slip, Plate: no slip")
verification.check("free slip at the lid only: impulse on the plate", plate, 0.02, 0.4)
verification.check("free slip at the lid only: impulse on the lid", lid, -1e-5, 1e-5)

COARSE = {"End time": 0.3, "Fluid/Pfem/Spacing": 0.008, "Output/Fields every": 0,
          "Structures/Obstacle/Mesh": "box(0.292, 0; 0.304, 0.08; 1, 5)", "Fluid/Pfem/Law at structures": "free slip"}
for name, settings in [
        ("matching", {}), ("own spacing of 5 mm", {"Interface": "non-matching", "Spacing": 0.005}),
        ("structure coarse, m = 5", {"Substeps": 5, "Coarse domain": "second"})]:
    history = run("benchmarks/dam_break_elastic_obstacle_2d.prm",
                  {**COARSE, **{f"Coupling/Gravouil Combescure/{entry}": value for entry, value in settings.items()}})
    summary = read_summary()
    energy = history["total energy [J]"]
    verification.check(f"{name}: peak of the tip [m]", max(history["tip displacement x [m]"]), 0.046, 0.052)
    verification.check(f"{name}: largest energy, of the start", max(energy) / energy[0], 0, 1.001)
    verification.check(f"{name}: interface energy [J]", history["interface energy [J]"][-1], -0.1, 1e-9)
    verification.check(f"{name}: largest velocity gap [m/s]", summary["largest interface velocity gap [m/s]"], 0, 1e-12)
verification.finish()
