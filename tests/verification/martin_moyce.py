"""The surge front of a collapsing column against the experiment of Martin and Moyce (1952), n^2 = 2, a = 57.15 mm.

The scaling is theirs, T = t sqrt(2 g / a), Z = front / a. The front's speed is compared: in the experiments a gate had
to open, which shifts their time by a constant that is printed, not bounded. So is the experiment of Koshizuka and Oka
(1996), of which only the places every 0.39 in T are published. `martin_moyce.py study` varies what could shift it.
"""

import os
import sys
from math import sqrt

from _scene import SOURCES, Verification, read_columns, run

WIDTH, GRAVITY = 0.05715, 9.81
FIRST, LAST = 1.5, 3.5


def time_of(times, places, place):
    """When the front passes a place, linear between the points."""
    for i in range(1, len(places)):
        if places[i] >= place:
            return times[i - 1] + (times[i] - times[i - 1]) * (place - places[i - 1]) / (places[i] - places[i - 1])
    raise ValueError(f"the front comes only to Z = {places[-1]}, not to {place}")


def speed(curve):
    """dZ/dT between FIRST and LAST"""
    return (LAST - FIRST) / (time_of(*curve, LAST) - time_of(*curve, FIRST))


experiments = {}
for name, file in (("Martin and Moyce", "martin_moyce_n2_2_a225_pysph.csv"),
                   ("Koshizuka and Oka", "koshizuka_oka_exp_pysph.csv")):
    columns = read_columns(os.path.join(SOURCES, "tests/reference_data", file))
    experiments[name] = (columns["T"], columns["Z"])
    print(f"{name}: speed of the front {speed(experiments[name]):.3f}")


def front_of(settings):
    history = run("verification/martin_moyce.prm", settings)
    return ([t * sqrt(2 * GRAVITY / WIDTH) for t in history["time [s]"]],
            [x / WIDTH for x in history["front position [m]"]])


def compare(title, front):
    """Prints how far the front is ahead of the experiments; returns its speed over Martin and Moyce's."""
    for name, curve in experiments.items():
        offsets = [time_of(*curve, z) - time_of(*front, z) for z in (1.5, 2, 2.5, 3, 3.5)]
        print(f"{title}: ahead of {name} in T by {min(offsets):.2f} to {max(offsets):.2f}")
    return speed(front) / speed(experiments["Martin and Moyce"])


def gate(velocity):
    """A gate in front of the column that is lifted [m/s]."""
    return {f"Fluid/Pfem/Walls/Gate/{entry}": value for entry, value in
            (("Shape", "box(0.05715, -0.01; 0.06115, 0.25)"), ("Fluid side", "outside"), ("Law", "free slip"),
             ("Translation", f"0; {velocity}*t"))}


verification = Verification()
for spacing in (0.004, 0.002):
    ratio = compare(f"spacing {spacing} m", front_of({"Fluid/Pfem/Spacing": spacing}))
    verification.check(f"spacing {spacing} m: speed of the front over Martin and Moyce's", ratio, 0.94, 1.06)
if "study" in sys.argv:
    for settings in ({"Spacing": 0.001}, {"Tait/Sound speed": 40}, {"Tait/Sound speed": 80}, {"Initial state/Seed": 2},
                     {"Initial state/Seed": 3}, {"Stabilization/Velocity filter": 0},
                     {"Stabilization/Density diffusion": 0}, {"Walls/Tank/Law": "no slip"},
                     {"Walls/Tank/Law": "no slip", "Spacing": 0.001}):
        title = ", ".join(f"{entry} = {value}" for entry, value in settings.items())
        ratio = compare(title, front_of({f"Fluid/Pfem/{entry}": value for entry, value in settings.items()}))
        print(f"{title}: speed {ratio:.3f}")
    for velocity in (1, 2, 4):
        print(f"gate, {velocity} m/s: speed {compare(f'gate, {velocity} m/s', front_of(gate(velocity))):.3f}")
verification.finish()
