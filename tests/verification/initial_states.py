"""The fluid at time 0: mass and angular momentum of bodies of revolution, bodies that are hydrostatic each on its own, and
pools that stay at rest, one of them with a spacing that varies."""

from math import log2, pi
import os

from _scene import Verification, read_summary, run
from _vtu import read_nodes

SCENE = "cookbooks/dam_break.prm"
STATE = "Fluid/Pfem/Initial state/"
GRAVITY, DENSITY, SOUND_SPEED = 9.81, 1000, 30
verification = Verification()


def start(settings):
    """The first row of the history; `output` then holds the fields at time 0."""
    return {name: column[0] for name, column in run(SCENE, {"End time": 1e-4, **settings}).items()}


# A disc and a ball of radius R that turn about their middle: mass and angular momentum m R^2 / 2, 2/5 m R^2.
RADIUS = 0.1
BODIES = {
    2: {STATE + "Shape": f"sphere(0.2, 0.2; {RADIUS})", STATE + "Velocity": "0.2 - y, x - 0.2"},
    3: {STATE + "Shape": f"sphere(0.2, 0.2, 0.2; {RADIUS})", STATE + "Velocity": "0.2 - y, x - 0.2, 0", "Dimension": 3,
        "Body forces/Gravity/Acceleration": "0, -9.81, 0",
        "Fluid/Pfem/Walls/Tank/Shape": "open box(0, 0, 0; 0.4, 0.4, 0.4)"}}
for dimension, settings in BODIES.items():
    exact_mass = DENSITY * (pi * RADIUS ** 2 if dimension == 2 else 4 / 3 * pi * RADIUS ** 3)
    exact_angular = exact_mass * RADIUS ** 2 * (0.5 if dimension == 2 else 0.4)
    errors = []
    for n in (8, 16) if dimension == 3 else (8, 16, 32):
        row = start({**settings, "Fluid/Pfem/Spacing": RADIUS / n, STATE + "Pressure": "zero"})
        about_origin = row["fluid angular momentum z [kg m^2/s]"]
        # The middle does not move but for what the lattice leaves: its share is taken off.
        about_middle = (about_origin - 0.2 * row["fluid momentum y [kg m/s]"] + 0.2 * row["fluid momentum x [kg m/s]"])
        mass_error, error = row["fluid mass [kg]"] / exact_mass - 1, about_middle / exact_angular - 1
        print(f"{dimension}D, R = {n} h: mass off by {100 * mass_error:.3f} %, angular momentum by {100 * error:.3f} %")
        verification.check(f"{dimension}D, R = {n} h: relative error of the mass", abs(mass_error), 0, 2e-3)
        errors.append(abs(error))
    for coarse, fine in zip(errors, errors[1:]):
        verification.check(f"{dimension}D, rate of the angular momentum", log2(coarse / fine), 1.5, 3)

# A drop above a pool, each with zero pressure at its own top.
start({STATE + "Shape": "half space(0.3, 0.1; 0, 1) + sphere(0.3, 0.2; 0.06)", "Fluid/Pfem/Spacing": 0.01})
errors = []
for node in read_nodes(os.path.join("output", "fluid-0001.vtu")):
    top = 0.1 if node["position"][1] < 0.12 else 0.26
    head = GRAVITY * (top - node["position"][1])
    exact = DENSITY * head * (1 + 0.5 * head / SOUND_SPEED ** 2)
    errors.append(abs(node["pressure"] - exact) / (DENSITY * GRAVITY * 0.1))
verification.check("pool and drop: largest error of the pressure, of that at the floor", max(errors), 0, 0.01)

# Pools wider than high stay at rest.
POOL = {STATE + "Shape": "half space(0.3, 0.1; 0, 1)", "Output/Fields every": 0, "End time": 1,
        "Fluid/Pfem/Walls/Tank/Shape": "open box(0, 0; 0.4, 0.3)"}
for name, spacing in ("uniform", "0.01"), ("graded", "0.006 + 0.08*y"):
    history = run(SCENE, {**POOL, "Fluid/Pfem/Spacing": spacing})
    verification.check(f"{name} pool: largest kinetic energy, of the potential energy",
                       max(history["kinetic energy [J]"]) / history["potential energy [J]"][0], 0, 1e-9)
    verification.check(f"{name} pool: mass over density times volume", history["fluid mass [kg]"][0] / 40, 1, 1.002)
    print(f"{name} pool: {read_summary()['fluid_nodes']} nodes")
verification.finish()
