"""A pulse of sound from a fluid into a solid: the energies that are reflected and transmitted against the exact ones, for
an impedance three times the fluid's and one of a third, with nodes that match and with coarser and finer ones.
`acoustic_pulse_into_solid.py study` refines."""

import sys

from _scene import Verification, read_summary, run


def nodes_on_bar(spacing):
    """Their name in what is printed; no spacing [m]: they match."""
    return "match" if spacing is None else f"{spacing:.4g}"


def coefficients(n, density, modulus, n_substeps, spacing=None):
    """Reflected and transmitted pressure over the incoming one [-], from the energies after the pulse has met the solid."""
    height = 4 / n
    interface = {} if spacing is None else {"Coupling/Gravouil Combescure/Interface": "non-matching",
                                            "Coupling/Gravouil Combescure/Spacing": spacing}
    history = run("verification/acoustic_pulse_into_solid.prm", {
        "Fluid/Pfem/Spacing": 1 / n, "Structures/Bar/Mesh": f"box(1, 0; 2, {height}; {n}, 4)",
        "Fluid/Pfem/Initial state/Shape": f"box(0, 0; 1, {height})",
        "Fluid/Pfem/Walls/Column/Shape": f"box(0, 0; 2.5, {height})",
        "Structures/Bar/Material/Linear elastic/Density": density,
        "Structures/Bar/Material/Linear elastic/Young's modulus": modulus,
        "Coupling/Gravouil Combescure/Substeps": n_substeps, **interface})
    total = [k + i + s for k, i, s in zip(history["kinetic energy [J]"], history["internal energy [J]"],
                                          history["strain energy [J]"])]
    solid = history["Bar kinetic energy [J]"][-1] + history["Bar strain energy [J]"][-1]
    momentum = history["fluid momentum x [kg m/s]"][-1]
    reflected = (1 if momentum < 0 else -1) * ((total[-1] - solid) / total[0])**0.5
    impedance_ratio = (density * modulus)**0.5 / 1e4
    transmitted = (solid / total[0] * impedance_ratio)**0.5  # energy flux p^2 / Z
    print(f"{n} cells per length, nodes {nodes_on_bar(spacing)}, Z_s / Z_f = {impedance_ratio:.3f}: "
          f"reflected {reflected:.4f}, transmitted {transmitted:.4f}, energy kept {total[-1] / total[0]:.5f}, "
          f"m {max(history['interface substeps [-]']):.0f}, {read_summary()['cpu_seconds']:.1f} CPU s")
    return reflected - (impedance_ratio - 1) / (impedance_ratio + 1), \
        transmitted - 2 * impedance_ratio / (impedance_ratio + 1)


verification = Verification()
if "study" in sys.argv:
    for n in (50, 100, 200):
        coefficients(n, 2000, 450000, 0)
for density, modulus in ((2000, 450000), (1000 / 3, 1e5 / 3)):
    for n_substeps in (1, 5, 20):
        for spacing in (None, 0.02 / 3, 0.004):
            reflection, transmission = coefficients(200, density, modulus, n_substeps, spacing)
            name = f"density {density:.0f} kg/m^3, m = {n_substeps}, nodes {nodes_on_bar(spacing)}: error of the"
            verification.check(f"{name} reflection", reflection, -0.005, 0.005)
            verification.check(f"{name} transmission", transmission, -0.005, 0.005)
verification.finish()
