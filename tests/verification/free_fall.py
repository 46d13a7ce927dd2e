"""A block of fluid falls freely through many remeshes: mass is kept and its momentum is m g t, both to round-off; and a
block without pressure that is not improved by shifts of its nodes falls as a rigid body: through remeshes when a wall
moves somewhere, and without one else."""

from math import dist

from _scene import Verification, read_columns, read_summary, run
from _vtu import read_nodes

GRAVITY, SPACING = 9.81, 0.02
STABILIZED = {"End time": 0.5, "Output/History every": 0.1, "Fluid/Pfem/Tension": "none",
              "Fluid/Pfem/Stabilization/Density diffusion": 0.5, "Fluid/Pfem/Stabilization/Velocity filter": 0.2,
              "Fluid/Pfem/Stabilization/Divergence filter": 1.5}
RIGID = {"Output/Fields every": 0.5, "Fluid/Pfem/Initial state/Pressure": "zero",
         "Fluid/Pfem/Volume conservation/Centroid shift": 0}
WALL = "Fluid/Pfem/Walls/Far wall/"


def largest_change(dimension):
    """Largest distance of a node at the end from one at the start, less the fall; in spacings."""
    fall = GRAVITY * STABILIZED["End time"]**2 / 2
    start, end = ([node["position"][:dimension] for node in read_nodes(f"output/fluid-000{i}.vtu")] for i in (1, 2))
    return max(min(dist((x, y + fall, *z), place) for place in start) for x, y, *z in end) / SPACING


verification = Verification()
for dimension, settings, far_wall in (
        (2, {}, {WALL + "Shape": "line(9, 0; 9, 1)", WALL + "Translation": "t; 0"}),
        (3, {"Dimension": 3, "Body forces/Gravity/Acceleration": "0, -9.81, 0",
             "Fluid/Pfem/Initial state/Shape": "box(0, 0, 0; 0.2, 0.3, 0.1)"},
         {WALL + "Shape": "sheet(0, 1; 9, 0; 9, 1)", WALL + "Translation": "t; 0; 0"})):
    history = run("verification/free_block.prm", {"Fluid/Pfem/Remeshing/Largest strain": 0.01, **STABILIZED, **settings})
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
    twice = {"Fluid/Pfem/Remeshing/Largest strain": 0.01, "Fluid/Pfem/Remeshing/Strained part": 1}
    run("verification/free_block.prm", {**twice, **STABILIZED, **settings})
    verification.check(f"{dimension}D, remeshes over those before when all cells may be strained twice as much",
                       read_summary()["n_remeshes"] / summary["n_remeshes"], 0.2, 0.8)
    run("verification/free_block.prm", {**STABILIZED, **RIGID, **settings})
    verification.check(f"{dimension}D without pressure and shifts, alone: remeshes", read_summary()["n_remeshes"], 0, 0)
    run("verification/free_block.prm",
        {**STABILIZED, **RIGID, **settings, **far_wall, WALL + "Fluid side": "both"})
    verification.check(f"{dimension}D without pressure and shifts, remeshes", read_summary()["n_remeshes"], 20, 10000)
    # fields are written in single precision
    verification.check(f"{dimension}D without pressure and shifts, change of the nodes' places, spacings",
                       largest_change(dimension), 0, 1e-5)
verification.finish()
