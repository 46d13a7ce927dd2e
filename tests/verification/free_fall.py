"""A block of fluid falls freely through many remeshes: mass is kept and its momentum is m g t, both to round-off."""

from _scene import Verification, read_columns, read_summary, run

GRAVITY = 9.81

verification = Verification()
for dimension, settings in ((2, {}),
                            (3, {"Dimension": 3, "Body forces/Gravity/Acceleration": "0, -9.81, 0",
                                 "Fluid/Pfem/Initial state/Shape": "box(0, 0, 0; 0.2, 0.3, 0.1)"})):
    history = run("verification/free_block.prm", {
        "End time": 0.5, "Output/History every": 0.1, "Fluid/Pfem/Remeshing/Largest strain": 0.01,
        "Fluid/Pfem/Tension": "none", "Fluid/Pfem/Stabilization/Density diffusion": 0.5,
        "Fluid/Pfem/Stabilization/Velocity filter": 0.2, "Fluid/Pfem/Stabilization/Divergence filter": 1.5,
        **settings})
    summary, remeshing = read_summary(), read_columns("output/remeshing.csv")
    expected = -history["fluid mass [kg]"][0] * GRAVITY * history["time [s]"][-1]
    axes = "xyz"[:dimension]
    made = max(sum(abs(change) for change in remeshing[f"momentum change {axis} [kg m/s]"]) for axis in axes)
    across = max(abs(history[f"fluid momentum {axis} [kg m/s]"][-1]) for axis in axes if axis != "y")
    verification.check(f"{dimension}D, remeshes", summary["n_remeshes"], 20, 10000)
    verification.check(f"{dimension}D, relative change of mass", summary["largest relative mass drift [-]"], 0, 1e-12)
    # history.csv has ten digits
    verification.check(f"{dimension}D, relative error of the momentum",
                       abs(history["fluid momentum y [kg m/s]"][-1] / expected - 1), 0, 5e-10)
    verification.check(f"{dimension}D, momentum made at remeshes, relative", made / abs(expected), 0, 1e-10)
    verification.check(f"{dimension}D, momentum across, relative", across / abs(expected), 0, 1e-10)
verification.finish()
