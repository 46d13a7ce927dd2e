"""A plane pulse of sound in a closed column, in 2D and 3D: velocity and pressure against d'Alembert's solution after
each of its halves has been reflected, and wave speed and amplitude of the halves.

    acoustic_pulse.py [study]     the numbers of doc/verification.md

Linear acoustics, u_tt = c^2 u_xx with u = 0 at the ends: with F the odd and 2 L periodic extension of the velocity at
the start, u = [F(x - c t) + F(x + c t)] / 2 and p = rho c [F(x - c t) - F(x + c t)] / 2.
"""

import sys
from math import exp, sqrt

from _scene import Verification, read_summary, run
from _vtu import read_nodes

LENGTH, DENSITY, SOUND_SPEED, SPEED, CENTRE, WIDTH, TIME = 1, 1000, 10, 1e-5, 0.4, 0.08, 0.12
PLACES = {0.4: -1, 0.8: 1}  # where the halves are at TIME after one reflection each, and which way they go
THREE = {"Dimension": 3, "Fluid/Pfem/Initial state/Shape": "box(0, 0, 0; 1, 0.1, 0.1)",
         "Fluid/Pfem/Walls/Column/Shape": "box(0, 0, 0; 1, 0.1, 0.1)",
         "Fluid/Pfem/Initial state/Velocity": "1e-5*exp(-((x - 0.4)/0.08)^2), 0, 0"}
UNSTABILIZED = {f"Fluid/Pfem/Stabilization/{name}": 0
                for name in ("Density diffusion", "Velocity filter", "Divergence filter")}


def initial(x):
    """F(x): images of the pulse at 2 n L + 0.4 m, and with the other sign at 2 n L - 0.4 m"""
    return SPEED * sum(exp(-((x - 2 * n * LENGTH - CENTRE) / WIDTH)**2) - exp(-((x - 2 * n * LENGTH + CENTRE) / WIDTH)**2)
                       for n in range(-2, 3))


def exact(x, t):
    right, left = initial(x - SOUND_SPEED * t), initial(x + SOUND_SPEED * t)
    return (right + left) / 2, DENSITY * SOUND_SPEED * (right - left) / 2


def measure(dimension, spacing, settings):
    run("verification/acoustic_pulse.prm", {"Fluid/Pfem/Spacing": spacing, **settings,
                                            **(THREE if dimension == 3 else {})})
    nodes = read_nodes("output/fluid-0002.vtu")
    unit = (SPEED, DENSITY * SOUND_SPEED * SPEED)
    square = [0, 0]
    for node in nodes:
        computed = node["velocity"][0], node["pressure"]
        for i, value in enumerate(exact(node["position"][0], TIME)):
            square[i] += ((computed[i] - value) / unit[i])**2 / len(nodes)
    result = {"velocity, rms": sqrt(square[0]), "pressure, rms": sqrt(square[1])}
    shift = amplitude = 0
    for place, way in PLACES.items():
        near = [(node["position"][0] - place, node["pressure"]) for node in nodes
                if abs(node["position"][0] - place) < 2.4 * WIDTH]
        shape = [exp(-(x / WIDTH)**2) for x, _ in near]
        # to first order a pulse a f that is ahead by s is a f - a s f', with f' = -2 x / W^2 f
        ahead = sum(p * f * x for f, (x, p) in zip(shape, near)) / sum((x * f)**2 for f, (x, p) in zip(shape, near))
        high = sum(p * f for f, (x, p) in zip(shape, near)) / sum(f * f for f in shape)
        shift += way * ahead / high * WIDTH**2 / 2 / len(PLACES)
        amplitude += abs(high) * 2 / unit[1] / len(PLACES)
    result["wave speed"] = shift / (SOUND_SPEED * TIME)
    result["amplitude lost"] = 1 - amplitude
    print(f"{dimension}D, spacing {spacing} m: {len(nodes)} nodes, {read_summary()['cpu_seconds']:.1f} CPU s")
    return result


verification = Verification()
if len(sys.argv) > 1:
    cases = {2: (0.02, 0.01, 0.005), 3: (0.0125, 0.00833, 0.00625)}
    all_settings = {"": {}, "no stabilization, ": UNSTABILIZED}
else:
    cases, all_settings = {2: (0.02, 0.01), 3: (0.025, 0.0125)}, {"": {}}
for title, settings in all_settings.items():
    for dimension, spacings in cases.items():
        results = [measure(dimension, spacing, settings) for spacing in spacings]
        rates = [verification.rate(f"{title}{dimension}D, {name}", spacings, [abs(result[name]) for result in results])
                 for name in results[0]]
        verification.check(f"{title}{dimension}D, error of the velocity", results[-1]["velocity, rms"], 0, 0.06)
        verification.check(f"{title}{dimension}D, error of the pressure", results[-1]["pressure, rms"], 0, 0.06)
        verification.check(f"{title}{dimension}D, error of the wave speed", abs(results[-1]["wave speed"]), 0, 0.015)
        verification.check(f"{title}{dimension}D, rate of the velocity", rates[0], 1, 3)
        verification.check(f"{title}{dimension}D, rate of the amplitude", rates[3], 1.5, 4)
verification.finish()
