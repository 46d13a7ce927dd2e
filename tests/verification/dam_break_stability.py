"""A dam break at 0.95 of Gershgorin's bound on the step stays bounded through impact and splash, on raw Delaunay meshes
and for several random lattices."""

from _scene import Verification, read_summary, run

RISE = "largest energy rise over 0.05 s, relative to the initial potential energy [-]"

verification = Verification()
for seed in (1, 2, 3):
    history = run("cookbooks/dam_break.prm", {"Fluid/Pfem/Spacing": 0.008, "Fluid/Pfem/Fraction of the bound": 0.95,
                                              "Fluid/Pfem/Initial state/Seed": seed})
    summary = read_summary()
    verification.check(f"seed {seed}: end time", summary["end_time"], 0.8, 0.8)
    verification.check(f"seed {seed}: energy made in any 0.05 s, of the initial potential energy", summary[RISE], 0, 0.001)
    verification.check(f"seed {seed}: relative mass drift", summary["largest relative mass drift [-]"], 0, 1e-12)
    verification.check(f"seed {seed}: largest speed [m/s]", max(history["largest fluid speed [m/s]"]), 2, 10)
verification.finish()
