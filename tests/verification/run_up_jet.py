"""The jet that a dam break sends up the wall it hits: its speed some 0.03 s after the impact, over that of the front.

A front of speed U that is stopped by a wall turns into an unsteady jet, which may be faster than U and than Ritter's
2 sqrt(g H) for the front itself: in a frame that moves up with the jet's root it leaves as fast as the fluid comes in.
There is no closed solution for this front; what is checked is that the speed is the same on finer meshes. It is that of
the fastest hundredth of the nodes: single nodes at the jet's tip are faster, and the faster the finer the tip.

    run_up_jet.py [study]
"""

import sys
from math import hypot

from _scene import Verification, run
from _vtu import read_nodes

WALL = 0.584
spacings = (0.004, 0.0028, 0.002) if len(sys.argv) > 1 else (0.004, 0.0028)
verification = Verification()
speeds = []
for spacing in spacings:
    history = run("cookbooks/dam_break.prm", {
        "Fluid/Pfem/Spacing": spacing, "End time": 0.28, "Plugin libraries":
            "pfem_fluid, equations_of_state, rheologies, body_forces, time_step_bounds, postprocessors",
        "Postprocessors/Models": "front", "Postprocessors/Front/Direction": "1, 0", "Output/Fields every": 0})
    impact = next(i for i, x in enumerate(history["front position [m]"]) if x > WALL - spacing)
    front = history["largest fluid speed [m/s]"][impact - 2]
    nodes = sorted(hypot(*node["velocity"]) for node in read_nodes("output/fluid-0002.vtu"))
    speeds.append(nodes[-len(nodes) // 100])
    print(f"spacing {spacing} m: the front comes with {front:.2f} m/s at {history['time [s]'][impact]:.3f} s, "
          f"the jet leaves with {speeds[-1]:.2f} m/s; the fastest node has {max(history['largest fluid speed [m/s]']):.2f} m/s")
    verification.check(f"spacing {spacing} m: speed of the jet over that of the front", speeds[-1] / front, 1.7, 2)
verification.check("speed of the jet, change between the finest meshes", abs(speeds[-1] / speeds[-2] - 1), 0, 0.06)
verification.finish()
