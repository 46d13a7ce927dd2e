"""A dam break bends an elastic obstacle, in two dimensions at a coarse spacing of 8 mm: the first peak of its tip, and
what the interface makes of the energy. The published curves are compared at a finer spacing, in the benchmark."""

from _scene import Verification, read_summary, run

verification = Verification()
history = run("benchmarks/dam_break_elastic_obstacle_2d.prm", {
    "End time": 0.35, "Fluid/Pfem/Spacing": 0.008, "Structures/Obstacle/Mesh": "box(0.292, 0; 0.304, 0.08; 1, 5)",
    "Output/Fields every": 0.1})
summary = read_summary()
times, tip = history["time [s]"], history["tip displacement x [m]"]
peak = max(range(len(tip)), key=tip.__getitem__)
onset = next(t for t, u in zip(times, tip) if u > 0.001)
print(f"onset (1 mm) at {onset:.3f} s, peak {1000 * tip[peak]:.1f} mm at {times[peak]:.3f} s, "
      f"largest velocity gap {max(history['interface velocity gap [m/s]']):.1e} m/s")
verification.check("end time", summary["end_time"], 0.35, 0.35)
verification.check("first peak of the tip [m]", tip[peak], 0.040, 0.056)
verification.check("time of the peak [s]", times[peak], 0.20, 0.28)
verification.check("onset [s]", onset, 0.12, 0.17)
verification.check("largest number of substeps", max(history["interface substeps [-]"]), 1, 1)
verification.check("largest interface energy [J]", max(abs(e) for e in history["interface energy [J]"]), 0, 1e-9)
verification.check("relative mass drift", summary["largest relative mass drift [-]"], 0, 1e-12)

# The same with an interface of its own spacing, and with either body making five steps in one of the other.
peak_of_matching = tip[peak]
coarse = {"End time": 0.3, "Fluid/Pfem/Spacing": 0.008, "Output/Fields every": 0.1,
          "Structures/Obstacle/Mesh": "box(0.292, 0; 0.304, 0.08; 1, 5)"}
for name, settings, allowed in [
        ("own spacing of 5 mm", {"Interface": "non-matching", "Spacing": 0.005}, 0.03),
        ("fluid coarse, m = 5", {"Substeps": 5, "Coarse domain": "first"}, 0.05),
        ("structure coarse, m = 5", {"Substeps": 5, "Coarse domain": "second"}, 0.05)]:
    coupling = {f"Coupling/Gravouil Combescure/{entry}": value for entry, value in settings.items()}
    history = run("benchmarks/dam_break_elastic_obstacle_2d.prm", {**coarse, **coupling})
    summary = read_summary()
    ratio = max(history["tip displacement x [m]"]) / peak_of_matching
    verification.check(f"{name}: peak of the tip, of the matching one", ratio, 1 - allowed, 1 + allowed)
    verification.check(f"{name}: interface energy [J]", history["interface energy [J]"][-1], -0.1, 1e-9)
    verification.check(f"{name}: largest velocity gap [m/s]", summary["largest interface velocity gap [m/s]"], 0, 1e-12)
    verification.check(f"{name}: largest drift [m]", summary["largest interface displacement drift [m]"], 0, 1e-15)
    taken_back = summary["largest interface displacement taken back [m]"]
    verification.check(f"{name}: largest way back [m]", taken_back, 0, 1e-4 if "Substeps" in settings else 1e-12)

# A structure of a hundredth of the fluid's density: without the shared mass it gains energy.
history = run("benchmarks/dam_break_elastic_obstacle_2d.prm",
              {**coarse, "Structures/Obstacle/Material/Saint Venant Kirchhoff/Density": 10})
verification.check("density ratio 0.01: energy at the end, of the start",
                   history["total energy [J]"][-1] / history["total energy [J]"][0], 0.9, 1)
verification.check("density ratio 0.01: peak of the tip [m]", max(history["tip displacement x [m]"]), 0.035, 0.055)

# In 3D at 12 mm the stable steps of fluid and structure are close to each other: a rule that lets both count all of
# the mass at the interface makes energy here (10 % of the initial potential energy, a peak of 62 mm).
history = run("cookbooks/dam_break_elastic_obstacle.prm", {
    "End time": 0.3, "Fluid/Pfem/Spacing": 0.012,
    "Structures/Obstacle/Mesh": "box(0.292, 0, 0; 0.304, 0.08, 0.15; 1, 4, 6)", "Output/Fields every": 0})
summary = read_summary()
rise = summary["largest energy rise over 0.05 s, relative to the initial potential energy [-]"]
verification.check("3D: first peak of the tip [m]", max(history["tip displacement x [m]"]), 0.043, 0.056)
verification.check("3D: energy rise over 0.05 s, of the initial potential energy", rise, 0, 0.005)
verification.check("3D: interior volume deficit", summary["largest_interior_volume_deficit"], 0, 0.02)
verification.finish()
