"""Between two remeshes the inviscid fluid keeps its energy but for the time integrator's error, of second order in the
step: a block in free fall whose hydrostatic pressure is released, in two and three dimensions."""

from math import log2

from _scene import Verification, read_summary, run

SETTINGS = {2: {}, 3: {"Dimension": 3, "Body forces/Gravity/Acceleration": "0, -9.81, 0",
                       "Fluid/Pfem/Initial state/Shape": "box(0, 0, 0; 0.2, 0.3, 0.1)"}}


def error(dimension, fraction):
    """Largest change of the total energy, relative to the energy of compression at the start."""
    history = run("verification/free_block.prm", {"Fluid/Pfem/Fraction of the bound": fraction, **SETTINGS[dimension]})
    verification.check(f"remeshes in {dimension}D", read_summary()["n_remeshes"], 0, 0)
    energy = history["total energy [J]"]
    return max(abs(e - energy[0]) for e in energy) / history["internal energy [J]"][0]


verification = Verification()
for dimension in SETTINGS:
    errors = [error(dimension, fraction) for fraction in (0.8, 0.4, 0.2)]
    print(f"{dimension}D: errors at 0.8, 0.4, 0.2 of the bound: " + ", ".join(f"{e:.3e}" for e in errors))
    for coarse, fine in zip(errors, errors[1:]):
        verification.check(f"{dimension}D, rate", log2(coarse / fine), 1.8, 2.4)
verification.finish()
