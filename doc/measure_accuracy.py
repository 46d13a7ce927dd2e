#!/usr/bin/env python3
"""Measures what accuracy costs and prints the tables of doc/accuracy_and_cost.md: ./doc/measure_accuracy.py OUT [TABLE]

OUT is a folder for the runs, TABLE one of 2D, 3D and knobs (all three without it: some ten CPU minutes). Runs that are
in OUT already are not repeated. The program is taken from the environment variable BREAKWATER_EXECUTABLE, or from
build/bin.
"""
import csv
import json
import math
import os
import subprocess
import sys

SOURCES = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
EXECUTABLE = os.environ.get("BREAKWATER_EXECUTABLE", os.path.join(SOURCES, "build/bin/breakwater"))
FLAT = "benchmarks/dam_break_elastic_obstacle_2d.prm"
DEEP = "cookbooks/dam_break_elastic_obstacle.prm"
MESH, SPACING = "Structures/Obstacle/Mesh", "Fluid/Pfem/Spacing"


def run(folder, name, scene, settings):
    """The tip's displacement [mm] at every millisecond, energies [J], and the summary of a run."""
    output = os.path.join(folder, name)
    if not os.path.exists(os.path.join(output, "summary.json")):
        command = [EXECUTABLE, os.path.join(SOURCES, "parameter_files", scene), "--output", output]
        for entry, value in settings.items():
            command += ["--set", f"{entry}={value}"]
        result = subprocess.run(command, capture_output=True, text=True, check=False)
        if result.returncode != 0:
            sys.exit(f"{name}: {result.stderr}")
    with open(os.path.join(output, "history.csv"), encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    with open(os.path.join(output, "summary.json"), encoding="utf-8") as file:
        summary = json.load(file)
    tip = [1e3 * float(row["tip displacement x [m]"]) for row in rows]
    energy = [float(row["total energy [J]"]) for row in rows]
    return tip, energy, summary


def row(title, result, reference):
    """Columns: first peak and its time, rms distance of the tip over 0.14 to 0.3 s, deficit, energy left, cost."""
    tip, energy, summary = result
    peak = max(range(min(400, len(tip))), key=lambda i: tip[i])
    distance = math.sqrt(sum((a - b)**2 for a, b in zip(tip[140:301], reference[0][140:301])) / 161)
    print(f"| {title} | {summary['fluid_nodes']} | {summary['steps']} | {tip[peak]:.1f} | {peak / 1000:.3f} | "
          f"{'-' if result is reference else f'{distance:.2f}'} | {100 * summary['largest_interior_volume_deficit']:.2f} | "
          f"{100 * (1 - energy[-1] / energy[0]):.1f} | {summary['cpu_seconds']:.1f} |", flush=True)


def head(first):
    print(f"\n| {first} | nodes | steps | first peak [mm] | at [s] | distance [mm] | largest interior deficit [%] | "
          "energy dissipated [%] | CPU s |\n|---|---|---|---|---|---|---|---|---|", flush=True)


def flat_mesh(spacing):
    return f"box(0.292, 0; 0.304, 0.08; {max(1, round(0.006 / spacing))}, {max(2, round(0.04 / spacing))})"


def deep_mesh(spacing):
    """One cell of degree 2 through the thickness."""
    return (f"box(0.292, 0, 0; 0.304, 0.08, 0.15; 1, {max(2, round(0.04 / spacing + 0.2))}, "
            f"{max(2, round(0.075 / spacing + 0.2))})")


def spacings(folder, title, scene, end, mesh, values):
    results = [run(folder, f"{title}_{h}", scene, {"End time": end, SPACING: h, MESH: mesh(h)}) for h in values]
    head(f"{title}, spacing [mm]")
    for h, result in zip(values, results):
        row(f"{1000 * h:g}", result, results[-1])


def knobs(folder):
    """One entry at a time is changed in the 2D scene at 4 mm; the reference is the run at 2 mm."""
    pfem = "Fluid/Pfem/"
    changes = [("as shipped", {}),
               ("another lattice", {pfem + "Initial state/Seed": 2}),
               ("sound speed 15 m/s", {pfem + "Tait/Sound speed": 15}),
               ("sound speed 60 m/s", {pfem + "Tait/Sound speed": 60}),
               ("0.4 of the bound on the step", {pfem + "Fraction of the bound": 0.4}),
               ("1.0 of the bound", {pfem + "Fraction of the bound": 1}),
               ("remesh at a strain of 0.1", {pfem + "Remeshing/Largest strain": 0.1}),
               ("0.3", {pfem + "Remeshing/Largest strain": 0.3}),
               ("no density diffusion", {pfem + "Stabilization/Density diffusion": 0}),
               ("no velocity filters", {pfem + "Stabilization/Velocity filter": 0,
                                        pfem + "Stabilization/Divergence filter": 0}),
               ("no volume correction", {pfem + "Volume conservation/Correction weight": 0}),
               ("viscosity a thousandth", {pfem + "Newtonian/Viscosity": 1e-6}),
               ("obstacle of 1 x 5 cells of degree 2", {MESH: "box(0.292, 0; 0.304, 0.08; 1, 5)"})]
    reference = run(folder, "2D_0.002", FLAT, {"End time": 0.5, SPACING: 0.002, MESH: flat_mesh(0.002)})
    head("2D, 4 mm")
    for title, settings in changes:
        row(title, run(folder, "knob_" + title.replace(" ", "_").replace("/", "_"), FLAT, {"End time": 0.5, **settings}),
            reference)
    row("spacing 2 mm", reference, reference)


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    folder, tables = sys.argv[1], sys.argv[2:] or ["2D", "3D", "knobs"]
    if "2D" in tables:
        spacings(folder, "2D", FLAT, 0.5, flat_mesh, (0.008, 0.0056, 0.004, 0.0028, 0.002))
    if "3D" in tables:
        spacings(folder, "3D", DEEP, 0.3, deep_mesh, (0.016, 0.012, 0.008, 0.006))
    if "knobs" in tables:
        knobs(folder)


main()
