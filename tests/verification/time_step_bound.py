"""The largest stable step is the one that power iteration finds: at 0.95 of it sound in a block of inviscid fluid without
any dissipation stays bounded for hundreds of steps, at 1.1 of it the run breaks down, in two and three dimensions.
Gershgorin's bound is on the safe side of it."""

from _scene import Verification, read_summary, run

SOUND = {"Body forces/Gravity/Acceleration": "0, 0", "Fluid/Pfem/Initial state/Pressure": "10*sin(20*x)",
         "End time": 0.2, "Fluid/Pfem/Spectral/Iterations": 200}
SETTINGS = {2: {}, 3: {"Dimension": 3, "Body forces/Gravity/Acceleration": "0, 0, 0",
                       "Fluid/Pfem/Initial state/Shape": "box(0, 0, 0; 0.2, 0.3, 0.1)"}}

verification = Verification()
for dimension, settings in SETTINGS.items():
    def sound(fraction, method="power iteration", expected_exit=0):
        history = run("verification/free_block.prm", {
            **SOUND, **settings, "Fluid/Pfem/Fraction of the bound": fraction, "Fluid/Pfem/Spectral/Method": method},
            expected_exit=expected_exit)
        return history["total energy [J]"], read_summary()

    energy, summary = sound(0.95)
    # So close to the bound it is another energy than this one that stays constant; this one stays near it.
    verification.check(f"{dimension}D, 0.95 of the bound: largest energy over the start", max(energy) / energy[0], 1, 1.5)
    verification.check(f"{dimension}D, 0.95 of the bound: least energy over the start", min(energy) / energy[0], 0.5, 1)
    _, broken = sound(1.1, expected_exit=2)
    verification.check(f"{dimension}D, 1.1 of the bound: steps until it breaks down", broken["steps"], 1,
                       summary["steps"] / 2)
    _, safe = sound(0.95, "gershgorin")
    verification.check(f"{dimension}D, step by Gershgorin over the sharp one", summary["steps"] / safe["steps"], 0.3, 1)
verification.finish()
