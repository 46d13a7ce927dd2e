"""The largest stable step is the one that power iteration finds: at 0.95 of it sound in a block of inviscid fluid without
any dissipation stays bounded for hundreds of steps, at 1.1 of it the run breaks down, in two and three dimensions.
Gershgorin's bound is on the safe side of it. So it is in a dam break through its impact, where tension is allowed: at
0.8 no energy is made, at 1.3 the run breaks down within a few steps. Without tension even 1.3 is bounded: where the
pressure is cut off at zero nothing can grow."""

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


def dam_break(fraction, tension, expected_exit=0):
    run("cookbooks/dam_break.prm", {
        "Fluid/Pfem/Spacing": 0.008, "End time": 0.4, "Fluid/Pfem/Tension": tension,
        "Fluid/Pfem/Fraction of the bound": fraction, "Fluid/Pfem/Spectral/Method": "power iteration",
        "Fluid/Pfem/Spectral/Iterations": 100}, expected_exit=expected_exit)
    return read_summary()


RISE = "largest energy rise over 0.05 s, relative to the initial potential energy [-]"
for fraction, tension in ((0.8, "none"), (0.8, "allowed"), (1.3, "none")):
    verification.check(f"dam break, {fraction} of the bound, tension {tension}: energy made in any 0.05 s",
                       dam_break(fraction, tension)[RISE], 0, 1e-3)
verification.check("dam break, 1.3 of the bound, tension allowed: steps until it breaks down",
                   dam_break(1.3, "allowed", expected_exit=2)["steps"], 1, 200)
verification.finish()
