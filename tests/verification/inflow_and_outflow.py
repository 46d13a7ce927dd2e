"""A plug of fluid comes in through an opening and leaves through an outflow: mass, momentum and energy are what has come
in less what has gone. The mass that has come in is rho Q t but for half a layer at most, with rho Q t = rho A times the
way of the plug."""

from _scene import Verification, read_summary, run

FREE = {"Body forces/Gravity/Acceleration": "0, 0", "Fluid/Pfem/Inflows/Jet/Speed": 1, "Output/Fields every": 0}
JET_3D = {
    "Dimension": 3, "Body forces/Gravity/Acceleration": "0, 0, 0", "Fluid/Pfem/Spacing": 0.01,
    "Fluid/Pfem/Walls/Container/Shape": "open box(0, 0, 0; 0.3, 0.3, 0.3)",
    "Fluid/Pfem/Inflows/Jet/Normal": "0, -1, 0", "Output/Fields every": 0}
OPENINGS = {
    "disc(0.15, 0.25, 0.15; 0.04)": 3.14159265358979 * 0.04 ** 2,
    "rectangle(0.1, 0.25, 0.1; 0.2, 0.25, 0.1; 0.1, 0.25, 0.16)": 0.1 * 0.06}
DENSITY = 1000


def way_of_cookbook(time):
    """Of the plug of filling_jet.prm: its speed rises to 1 m/s within 0.1 s; it stops at 0.8 s."""
    return 5 * time ** 2 if time < 0.1 else 0.05 + min(time, 0.8) - 0.1


def check(name, history, spacing, area, way):
    times, mass_in = history["time [s]"], history["mass through Jet [kg]"]
    layer = DENSITY * area * spacing
    largest = max(abs(m - DENSITY * area * way(t)) for t, m in zip(times, mass_in))
    print(f"{name}: {mass_in[-1]:.6g} kg came in, rho Q t is {DENSITY * area * way(times[-1]):.6g} kg")
    verification.check(f"{name}: mass off by layers", largest / layer, 0, 0.55)
    verification.check(f"{name}: mass at the end, relative",
                       mass_in[-1] / (DENSITY * area * way(times[-1])), 0.99, 1.01)
    # history.csv has ten digits; the drift is exact.
    gone = history.get("mass through Drain [kg]", [0] * len(times))
    verification.check(f"{name}: fluid mass less what came in, relative", max(
        abs(m - i + g) for m, i, g in zip(history["fluid mass [kg]"], mass_in, gone)) / mass_in[-1], 0, 1e-9)
    verification.check(f"{name}: relative mass drift", read_summary()["largest relative mass drift [-]"], 0, 1e-12)


verification = Verification()

history = run("cookbooks/filling_jet.prm", {"Output/Fields every": 0})
check("filling", history, 0.005, 0.04, way_of_cookbook)
net = [e - r for e, r in zip(history["total energy [J]"], history["energy received through openings [J]"])]
verification.check("filling: energy above what came in, of all that came in",
                   max(net) / history["energy received through openings [J]"][-1], 0, 1e-3)
verification.check("filling: energy made within 0.05 s, of all that came in",
                   read_summary()["largest energy rise over 0.05 s [J]"] /
                   history["energy received through openings [J]"][-1], 0, 1e-3)

# Without gravity, and at a steady speed, nothing changes the jet on its way to the drain.
DRAIN = {"Fluid/Pfem/Outflows/Drain/Shape": "box(0, 0; 0.3, 0.1)"}
cases = [("2D", {**FREE, **DRAIN}, 0.005, 0.04)]
cases += [(text, {**FREE, **JET_3D, "Fluid/Pfem/Outflows/Drain/Shape": "box(0, 0, 0; 0.3, 0.15, 0.3)",
                  "Fluid/Pfem/Inflows/Jet/Opening": text}, 0.01, area) for text, area in OPENINGS.items()]
for name, settings, spacing, area in cases:
    history = run("cookbooks/filling_jet.prm", {**settings, "End time": 0.7})
    check(name, history, spacing, area, lambda time: time)
    verification.check(f"{name}: mass that has gone, of what came in",
                       history["mass through Drain [kg]"][-1] / history["mass through Jet [kg]"][-1], 0.4, 0.9)
    largest = max(abs(p) for p in history["fluid momentum y [kg m/s]"])
    verification.check(f"{name}: momentum that openings do not explain, relative", max(
        abs(p - r) for d in "xy" for p, r in zip(history[f"fluid momentum {d} [kg m/s]"],
                                                 history[f"momentum received through openings {d} [kg m/s]"]))
                       / largest, 0, 1e-12)
    net = [e - r for e, r in zip(history["total energy [J]"], history["energy received through openings [J]"])]
    verification.check(f"{name}: energy that openings do not explain, of the largest", max(abs(e) for e in net)
                       / max(history["kinetic energy [J]"]), 0, 1e-9)
verification.finish()
