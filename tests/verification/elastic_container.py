"""The filling of an elastic container against published curves of its lowest point. The test stops after the first
oscillations; `elastic_container.py study` goes to their end."""

import os
import sys

from _scene import SOURCES, Verification, read_columns, read_summary, run

REFERENCES = os.path.join(SOURCES, "tests", "reference_data")
NAMES = ("cerquaglia", "franci", "meduri")
end = 10 if "study" in sys.argv else 1.7
history = run("benchmarks/elastic_container.prm", {"End time": end, "Output/Fields every": 0})
summary = read_summary()
times, lowest = history["time [s]"], history["lowest displacement y [m]"]


def extremes(times, values, begin, end):
    """Smallest value and its time, in a span of time."""
    return min((u, t) for t, u in zip(times, values) if begin <= t <= end)


def mean(times, values, begin, end):
    points = [u for t, u in zip(times, values) if begin <= t <= end]
    return sum(points) / len(points)


published = {}
for name in NAMES:
    curve = read_columns(os.path.join(REFERENCES, f"vertical_container_fspc_{name}.csv"))
    published[name] = curve["time_s"], curve["value_m"]
for name, (t, u) in list(published.items()) + [("computed", (times, lowest))]:
    depth, when = extremes(t, u, 0.9, 1.2)
    print(f"{name}: first dip {depth:.3f} m at {when:.3f} s, mean from 1.3 to 1.7 s {mean(t, u, 1.3, 1.7):.3f} m"
          + (f", from 8 to 10 s {mean(t, u, 8, 10):.3f} m" if end == 10 else ""))
print(f"{summary['cpu_seconds']:.0f} CPU s, interior deficit {summary['largest_interior_volume_deficit']:.1e}")

verification = Verification()
verification.check("status is finished", summary["status"] == "finished", True, True)


def check(name, value, values, slack):
    """Within the spread of the published values, and `slack` for reading them off a plot."""
    verification.check(name, value, min(values) - slack, max(values) + slack)


def check_dip(name, begin, end):
    depth, when = extremes(times, lowest, begin, end)
    dips = [extremes(t, u, begin, end) for t, u in published.values()]
    check(f"{name} [m]", depth, [d for d, _ in dips], 0.02)
    check(f"{name}, its time [s]", when, [w for _, w in dips], 0.02)


def check_mean(begin, end):
    check(f"mean from {begin} to {end} s [m]", mean(times, lowest, begin, end),
          [mean(t, u, begin, end) for t, u in published.values()], 0.02)


check_dip("first dip", 0.9, 1.2)
check_mean(1.3, 1.7)
if end == 10:
    highest = [max(v for s, v in zip(t, u) if 2.5 <= s <= 2.9) for t, u in [*published.values(), (times, lowest)]]
    check("highest [m]", highest[-1], highest[:-1], 0.02)
    check_dip("next dip", 2.9, 3.3)
    check_mean(8, 10)
verification.check("relative mass drift", summary["largest relative mass drift [-]"], 0, 1e-12)
verification.finish()
