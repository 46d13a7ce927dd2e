"""A bar in its first longitudinal mode against the exact solution: errors on three meshes and their rates.

Lumped linear cells with central differences are of second order. For degree 2 the step is refined twice as fast as the
mesh, so that the error in time (second order) falls like the fourth power of h, as does that of the nodes in space.
"""

from math import log2, pi, sin, sqrt

from _scene import Verification, run

FREQUENCY = pi / 2 * sqrt(1e5 / 1000)  # k sqrt(E / rho), with a bar of length 1
AMPLITUDE = 0.01 / FREQUENCY


def error(degree, n_cells, fraction):
    """Largest error of the probes over all history times, relative to the amplitude."""
    history = run("verification/bar_wave.prm", {
        "Structures/Bar/Degree": degree,
        "Structures/Bar/Mesh": f"box(0, 0; 1, 0.1; {n_cells}, 1)",
        "Structures/Bar/Fraction of the bound": fraction})
    return max(abs(u - AMPLITUDE * sin(pi / 2 * x) * sin(FREQUENCY * t)) / AMPLITUDE
               for name, x in (("middle", 0.4), ("end", 1.0))
               for t, u in zip(history["time [s]"], history[f"{name} displacement x [m]"]))


verification = Verification()
for degree, fractions, largest_error, rate in ((1, (0.9, 0.9, 0.9), 5e-4, 1.9), (2, (0.8, 0.4, 0.2), 2e-5, 3.6)):
    errors = [error(degree, n, fraction) for n, fraction in zip((10, 20, 40), fractions)]
    print(f"degree {degree}: errors with 10, 20, 40 cells: " + ", ".join(f"{e:.3e}" for e in errors))
    verification.check(f"degree {degree}, error with 40 cells", errors[2], 0, largest_error)
    for coarse, fine in zip(errors, errors[1:]):
        verification.check(f"degree {degree}, rate", log2(coarse / fine), rate, rate + 0.8)
verification.finish()
