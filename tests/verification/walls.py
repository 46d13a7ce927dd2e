"""Walls: what they feel from water at rest and in motion, a moving tank against a shaking one, a gate that opens."""

from math import pi, sin

from _scene import Verification, run

GRAVITY = 9.81


def forces(history, direction):
    """Sum of the forces on all walls [N], row by row."""
    columns = [values for name, values in history.items()
               if name.startswith("force on ") and name.endswith(f" {direction} [N]")]
    return [sum(row) for row in zip(*columns)]


def imbalance(history):
    """Largest change of momentum from row to row that is neither gravity's nor the walls', over the largest momentum."""
    worst = largest = 0
    times, mass = history["time [s]"], history["fluid mass [kg]"][0]
    for direction, gravity in (("x", 0), ("y", GRAVITY)):
        momentum, force = history[f"fluid momentum {direction} [kg m/s]"], forces(history, direction)
        largest = max(largest, max(map(abs, momentum)))
        for i in range(1, len(times)):
            step = times[i] - times[i - 1]
            worst = max(worst, abs(momentum[i] - momentum[i - 1] + step * (mass * gravity + force[i])))
    return worst / largest


def mean(values):
    return sum(values) / len(values)


def water_at_rest(verification):
    history = run("verification/hydrostatic_column.prm", {"End time": 0.5, "Fluid/Pfem/Spacing": 0.02})
    weight = history["fluid mass [kg]"][0] * GRAVITY
    verification.check("force on the tank over the weight", -mean(history["force on Tank y [N]"]) / weight, 0.999, 1.001)
    verification.check("its moment over weight times half the width",
                       -mean(history["moment on Tank z [N m]"]) / (weight * 0.1), 0.999, 1.001)


def submerged_cylinder(verification):
    history = run("verification/submerged_cylinder.prm")
    weight = history["fluid mass [kg]"][0] * GRAVITY
    buoyancy = 1000 * GRAVITY * 12 * 0.05**2 * sin(pi / 12)
    # Measured: 0.99995, 0.99996, 0.010, 2.3e-6
    verification.check("buoyancy over that of the cylinder's volume",
                       mean(history["force on Cylinder y [N]"]) / buoyancy, 0.98, 1.02)
    verification.check("force on all walls over the weight", -mean(forces(history, "y")) / weight, 0.999, 1.001)
    verification.check("largest moment on the cylinder over buoyancy times radius",
                       max(map(abs, history["moment on Cylinder z [N m]"])) / (buoyancy * 0.05), 0, 0.05)
    verification.check("kinetic energy over the potential one",
                       history["kinetic energy [J]"][-1] / history["potential energy [J]"][0], 0, 1e-5)


def moving_tank(verification):
    settings = {"Fluid/Pfem/Initial state/Pressure": "1000*9.81*(0.2 - y)*(1 + 9.81*(0.2 - y)/800)"}
    moving = run("verification/moving_tank.prm", settings)
    shaken = run("verification/tilting_tank.prm",
                 {**settings, "End time": 1, "Output/History every": 0.02,
                  "Body forces/Expression/Acceleration": "-0.02*(2*pi)^2*cos(2*pi*t), -9.81"})
    mass = moving["fluid mass [kg]"][0]
    tank_momentum = [mass * 0.04 * pi * sin(2 * pi * time) for time in moving["time [s]"]]
    largest = max(map(abs, shaken["fluid momentum x [kg m/s]"]))
    difference = max(abs(a - b - c) for a, b, c in zip(moving["fluid momentum x [kg m/s]"], tank_momentum,
                                                       shaken["fluid momentum x [kg m/s]"])) / largest
    energies = [energy - work for energy, work in zip(moving["total energy [J]"], moving["work of walls [J]"])]
    # Measured: 2.4e-3; 9.8e-4
    verification.check("moving tank against a shaken one, momentum in the tank's frame", difference, 0, 0.005)
    verification.check("energy gained beyond the work of the walls, over the largest work",
                       (max(energies) - energies[0]) / max(moving["work of walls [J]"]), 0, 3e-3)
    verification.check("momentum that nothing accounts for", imbalance(moving), 0, 1e-9)


def gate(verification):
    history = run("verification/gate.prm")
    closed = [i for i, time in enumerate(history["time [s]"]) if 0 < time < 0.1]
    exact = 1000 * GRAVITY * 0.3**2 / 2 * (1 + GRAVITY * 0.3 / (3 * 20**2))
    verification.check("force on the closed gate over rho g H^2 / 2",
                       mean([history["force on Gate x [N]"][i] for i in closed]) / exact, 0.999, 1.001)
    verification.check("force on the gate when it is away", abs(history["force on Gate x [N]"][-1]), 0, 1e-9)
    verification.check("momentum of the water then [kg m/s]", history["fluid momentum x [kg m/s]"][-1], 20, 60)
    verification.check("momentum that nothing accounts for", imbalance(history), 0, 1e-9)


check = Verification()
water_at_rest(check)
submerged_cylinder(check)
moving_tank(check)
gate(check)
breaking = run("cookbooks/dam_break.prm", {"Fluid/Pfem/Spacing": 0.01, "End time": 0.6, "Output/Fields every": 0})
check.check("dam break: momentum that nothing accounts for", imbalance(breaking), 0, 1e-9)
check.finish()
