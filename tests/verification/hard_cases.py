"""Every scene of parameter_files/hard_cases ends properly within a minute: mass kept, no energy made, no node outside of
the wall named Tank.

    hard_cases.py [SCENE...]
"""

import os
import re
import sys

from _scene import SOURCES, Verification, read_summary, run
from _vtu import read_nodes

FOLDER = os.path.join(SOURCES, "parameter_files", "hard_cases")
# What walls and body forces do that change with time is work that no energy of the balance holds.
DRIVEN = {"fast_wall", "gravity_reversal", "shaken_flap", "dry_and_wet"}


def tank(text):
    """Corners of the box named Tank, the largest y at infinity if it is open."""
    kind, numbers = re.search(r"subsection Tank\s+set Shape\s*=\s*(open box|box)\(([^)]*)\)", text).groups()
    lower, upper = ([float(number) for number in corner.split(",")] for corner in numbers.split(";"))
    if kind == "open box":
        upper[1] = float("inf")
    return lower, upper


def n_outside(name):
    """Nodes of the last output farther outside of the tank than single precision explains"""
    with open(os.path.join(FOLDER, name + ".prm"), encoding="utf-8") as file:
        lower, upper = tank(file.read())
    last = max(file for file in os.listdir("output") if file.startswith("fluid-"))
    return sum(any(x < low - 1e-6 or x > high + 1e-6 for x, low, high in zip(node["position"], lower, upper))
               for node in read_nodes(os.path.join("output", last)))


verification = Verification()
for name in sys.argv[1:] or sorted(file[:-4] for file in os.listdir(FOLDER) if file.endswith(".prm")):
    history = run(f"hard_cases/{name}.prm")
    summary, energy = read_summary(), history["total energy [J]"]
    reference = max(max(history["kinetic energy [J]"]), max(map(abs, history["potential energy [J]"])))
    volume = next(values for column, values in history.items() if column.startswith("fluid mesh volume"))
    print(f"{name}: {summary['cpu_seconds']:.1f} CPU s, {summary['steps']} steps, {summary['n_remeshes']} remeshes, energy "
          f"{energy[0]:.4g} to {energy[-1]:.4g} J, fastest {max(history['largest fluid speed [m/s]']):.2f} m/s, "
          f"mesh volume {volume[-1] / (volume[0] or max(volume)):.3f} of the first")
    verification.check(f"{name}: finished", summary["status"] == "finished", True, True)
    verification.check(f"{name}: CPU s", summary["cpu_seconds"], 0, 60)
    verification.check(f"{name}: relative mass drift", summary["largest relative mass drift [-]"], 0, 1e-12)
    verification.check(f"{name}: nodes outside", n_outside(name), 0, 0)
    if "interface energy [J]" in history:
        verification.check(f"{name}: energy made at the interface, of the largest",
                           max(history["interface energy [J]"]) / reference, -1, 1e-5)
        if name not in DRIVEN:
            verification.check(f"{name}: largest rise of the energy over 0.05 s, of the largest",
                               summary["largest energy rise over 0.05 s [J]"] / reference, 0, 1e-3)
    if name not in DRIVEN:
        verification.check(f"{name}: energy made, of the largest", (max(energy) - energy[0]) / reference, -1, 1e-3)
verification.finish()
