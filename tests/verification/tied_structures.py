"""Structures tied to each other: three pieces of a bar swing like the whole one. The first is tied to the second by the
coupler, the second to the third in the group that makes equal steps; the exact solution is that of bar_wave.py."""

from math import log2, pi, sin, sqrt

from _scene import Verification, read_summary, run

FREQUENCY = pi / 2 * sqrt(1e5 / 1000)  # k sqrt(E / rho), with a bar of length 1
AMPLITUDE = 0.01 / FREQUENCY


def error(n, fraction):
    """Largest error of the probes over all history times, relative to the amplitude."""
    settings = {f"Structures/{name}/Mesh": f"box({begin}, 0; {end}, 0.1; {round(n * (end - begin))}, 1)"
                for name, begin, end in (("Root", 0, 0.4), ("Middle", 0.4, 0.7), ("End", 0.7, 1))}
    settings |= {f"Structures/{name}/Fraction of the bound": fraction for name in ("Root", "Middle", "End")}
    history = run("verification/tied_bars.prm", settings)
    return max(abs(u - AMPLITUDE * sin(pi / 2 * x) * sin(FREQUENCY * t)) / AMPLITUDE
               for name, x in (("middle", 0.4), ("end", 1.0))
               for t, u in zip(history["time [s]"], history[f"{name} displacement x [m]"]))


verification = Verification()
errors = [error(n, fraction) for n, fraction in ((10, 0.8), (20, 0.4), (40, 0.2))]
print("errors with 10, 20, 40 cells: " + ", ".join(f"{e:.3e}" for e in errors))
verification.check("error with 40 cells", errors[2], 0, 2e-5)
for coarse, fine in zip(errors, errors[1:]):
    verification.check("rate", log2(coarse / fine), 3.6, 4.4)
summary = read_summary()
verification.check("largest displacement drift at joints [m]", summary["largest displacement drift at joints [m]"], 0, 1e-14)
verification.check("largest velocity gap at joints [m/s]", summary["largest velocity gap at joints [m/s]"], 0, 1e-15)
verification.check("interface energy, of the total", abs(summary["interface energy [J]"]) / 0.0025, 0, 1e-14)
verification.finish()
