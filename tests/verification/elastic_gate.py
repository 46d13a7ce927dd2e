"""The elastic gate against the measured displacement of its tip (Antoci, Gallati and Sibilla, 2007) and against a
computation with the same linear material. `elastic_gate.py study` compares all published curves at three spacings; the
test stops after the peak, at a coarse spacing."""

import os
import sys

from _scene import SOURCES, Verification, read_columns, read_summary, run

REFERENCES = os.path.join(SOURCES, "tests", "reference_data")


def interpolate(times, values, t):
    i = max(1, next((k for k, u in enumerate(times) if u >= t), len(times) - 1))
    return values[i - 1] + (t - times[i - 1]) / (times[i] - times[i - 1]) * (values[i] - values[i - 1])


def distance(history, name, axis, end, point="tip"):
    """Root mean square difference to a published curve over the latter's points up to `end`, of its largest value."""
    curve = read_columns(os.path.join(REFERENCES, f"antoci_gate_etvf_{axis}_displacement_{name}.csv"))
    points = [(t, u) for t, u in zip(curve["time_s"], curve["value"]) if 0 <= t <= end]
    column = history[f"{point} displacement {axis} [m]"]
    squares = [(interpolate(history["time [s]"], column, t) - u)**2 for t, u in points]
    return (sum(squares) / len(squares))**0.5 / max(u for _, u in points)


def simulate(spacing, end):
    n = round(0.04 / spacing)
    history = run("benchmarks/elastic_gate.prm", {
        "Fluid/Pfem/Spacing": spacing, "Structures/Gate/Mesh": f"box(0.1, 0; 0.105, 0.079; 1, {n})", "End time": end,
        "Output/Fields every": 0})
    summary = read_summary()
    print(f"spacing {spacing} m: nodes put back out of the gate {summary['nodes_put_back_out_of_structures']}, interior "
          f"deficit {summary['largest_interior_volume_deficit']:.1e}, {summary['cpu_seconds']:.0f} CPU s")
    for point in ("upstream", "tip", "downstream"):
        x, y = (history[f"{point} displacement {axis} [m]"] for axis in "xy")
        peak = max(range(len(x)), key=x.__getitem__)
        print(f"  {point}: peak x {1000 * x[peak]:.1f} mm, y {1000 * y[peak]:.1f} mm at {history['time [s]'][peak]:.3f} s "
              "(measured 46.4, 17.1 mm at 0.16 s)")
        for name in ("antoci_2007_experiment", "ng_2020_sph_vcpm_alpha_1", "khayyer_2018_isph_sph", "yang_2012_sph_fem"):
            print(f"    distance to {name}: x {distance(history, name, 'x', end, point):.3f}, "
                  f"y {distance(history, name, 'y', end, point):.3f} of its largest value")
    return history, summary


verification = Verification()
if "study" in sys.argv:
    for spacing in (0.005, 0.0025, 0.00125):
        simulate(spacing, 0.4)
end = 0.2
history, summary = simulate(0.005, end)
energy = history["total energy [J]"]
verification.check("x against a computation with this material, of its peak",
                   distance(history, "ng_2020_sph_vcpm_alpha_1", "x", end), 0, 0.1)
verification.check("y against another one, of its peak", distance(history, "yang_2012_sph_fem", "y", end), 0, 0.1)
verification.check("energy made, relative", max(energy) / energy[0] - 1, -1, 1e-4)
verification.check("interior volume deficit", summary["largest_interior_volume_deficit"], 0, 0.02)
verification.check("relative mass drift", summary["largest relative mass drift [-]"], 0, 1e-12)
verification.finish()
