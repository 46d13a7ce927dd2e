"""An elastic block floats: its mean place is that of Archimedes, and all momentum is accounted for, step by step.
`floating_block.py study` refines fluid and block together."""

import sys

from _scene import Verification, read_summary, run

# Draught 0.1 m for half the density; with the level rising around the block it sinks d from 0.08 m: 0.08 + d + 2 d / 3.
SINKS = 0.02 / (1 + 0.4 / 0.6)


def mean_place(history):
    """Mean over the full periods between the first and the last upward passage of the mean of both corners."""
    times = history["time [s]"]
    place = [(a + b) / 2 for a, b in zip(history["left displacement y [m]"], history["right displacement y [m]"])]
    passages = [i for i in range(1, len(place)) if place[i - 1] < -SINKS <= place[i]]
    period = place[passages[0]:passages[-1]]
    print(f"{len(passages) - 1} periods of {(times[passages[-1]] - times[passages[0]]) / (len(passages) - 1):.3f} s")
    return sum(period) / len(period)


def lost_momentum(history):
    """Largest change of all momentum in a direction that neither the walls nor gravity explain, relative to
    the weight over the whole time."""
    mass = history["fluid mass [kg]"][0] + 0.4 * 0.2 * 500
    largest = 0
    for x, gravity in (("x", 0.), ("y", -9.81)):
        impulse = 0
        for i in range(1, len(history["time [s]"])):
            impulse += (history["time [s]"][i] - history["time [s]"][i - 1]) * \
                (mass * gravity - history[f"force on Tank {x} [N]"][i])
            momentum = history[f"fluid momentum {x} [kg m/s]"][i] + history[f"Block momentum {x} [kg m/s]"][i]
            largest = max(largest, abs(momentum - impulse))
    return largest / (mass * 9.81 * history["time [s]"][-1])


def simulate(spacing):
    n = round(0.4 / spacing)
    history = run("verification/floating_block.prm", {
        "Output/Digits": 16,
        "Fluid/Pfem/Spacing": spacing, "Structures/Block/Mesh": f"box(0.3, 0.32; 0.7, 0.52; {n}, {n // 2})"})
    place, summary = mean_place(history), read_summary()
    print(f"spacing {spacing} m: mean place {place:.5f} m, exact {-SINKS:.5f} m, momentum lost {lost_momentum(history):.1e}, "
          f"energy kept {history['total energy [J]'][-1] / history['total energy [J]'][0]:.5f}, interior deficit "
          f"{max(map(abs, history['interior volume deficit [-]'])):.1e}, {summary['cpu_seconds']:.1f} CPU s")
    return history, place, summary


verification = Verification()
if "study" in sys.argv:
    for spacing in (0.04, 0.02, 0.01):
        simulate(spacing)
history, place, summary = simulate(0.02)
verification.check("mean place, error relative to the draught", (-place - SINKS) / 0.1, -0.02, 0.02)
verification.check("momentum that nothing explains", lost_momentum(history), 0, 1e-12)
verification.check("relative mass drift", summary["largest relative mass drift [-]"], 0, 1e-12)
verification.check("nodes put back out of the block", summary["nodes_put_back_out_of_structures"], 0, 0)
verification.finish()
