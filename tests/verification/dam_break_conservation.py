"""A dam break with remeshing through impact and splash keeps mass and volume and makes no energy."""

from _scene import Verification, read_summary, run

RISE = "largest energy rise over 0.05 s, relative to the initial potential energy [-]"

verification = Verification()
history = run("cookbooks/dam_break.prm", {"Fluid/Pfem/Spacing": 0.008, "End time": 0.5})
summary = read_summary()
print(f"{summary['n_remeshes']} remeshes, {summary['status']} at {summary['end_time']} s")
verification.check("end time", summary["end_time"], 0.5, 0.5)
verification.check("relative mass drift", summary["largest relative mass drift [-]"], 0, 1e-12)
verification.check("largest interior volume deficit", summary["largest_interior_volume_deficit"], 0, 0.01)
verification.check("energy made in any 0.05 s, of the initial potential energy", summary[RISE], 0, 0.001)
verification.check("energy left, of the initial one", history["total energy [J]"][-1] / history["total energy [J]"][0],
                   0.9, 1.0)

# A remesh that changes more than it may stops the run.
for limit in ("energy gain", "angular momentum change"):
    stopped = run("cookbooks/dam_break.prm", {"Fluid/Pfem/Spacing": 0.01, "End time": 0.2,
                                              f"Fluid/Pfem/Limits/Largest {limit} at a remesh": 1e-9}, expected_exit=2)
    verification.check(f"the limit on the {limit} stops the run at", stopped["time [s]"][-1], 0, 0.19)
verification.finish()
