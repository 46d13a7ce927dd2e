"""Turek and Hron's CSM3, an elastic beam that falls in gravity, against the curve of FeatFlow: the first 3 seconds."""

import os

from _scene import SOURCES, Verification, read_columns, run


def frequency(time, values, level):
    """From the first to the last downward passage through a level."""
    passages = [time[i] + (level - values[i]) * (time[i + 1] - time[i]) / (values[i + 1] - values[i])
                for i in range(len(time) - 1) if values[i] > level >= values[i + 1]]
    return (len(passages) - 1) / (passages[-1] - passages[0])


reference = read_columns(os.path.join(SOURCES, "tests", "reference_data", "turek_csm3_featflow.csv"))
n = sum(t < 3 + 1e-9 for t in reference["time"])
history = run("benchmarks/turek_csm3.prm", {"End time": 3, "Output/Fields every": 0})
time = history["time [s]"]

verification = Verification()
verification.check("rows at the reference's times", max(abs(a - b) for a, b in zip(time, reference["time"])), 0, 1e-9)
verification.check("rows", len(time), n, n)
for direction in "xy":
    ours = history[f"tip displacement {direction} [m]"]
    theirs = reference[f"U{direction}"][:n]
    distance = (sum((a - b)**2 for a, b in zip(ours, theirs)) / n)**0.5
    verification.check(f"largest displacement {direction} over the reference's", min(ours) / min(theirs), 0.98, 1.02)
    verification.check(f"rms distance {direction} over the amplitude", distance / -min(theirs), 0, 0.01)
ratio = (frequency(time, history["tip displacement y [m]"], -0.064) /
         frequency(reference["time"][:n], reference["Uy"][:n], -0.064))
verification.check("frequency over the reference's", ratio, 0.998, 1.002)
verification.finish()
