#!/usr/bin/env python3
"""Plots the stable step before and after smoothing at every remesh, as figure 3 of Meduri, Cremonesi and Perego does,
and prints a table:
./doc/plot_smoothing.py PICTURE.png SMOOTHING.csv [SMOOTHING.csv ...]

SMOOTHING.csv is what build/tests/bin/smoothing_benchmark has written. Needs python3-matplotlib.
"""
import csv
import sys
from statistics import mean

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt


def read(files):
    """The rows of each smoother, {smoother: {column: [value, ...]}}."""
    cases = {}
    for name in files:
        with open(name) as file:
            for row in csv.DictReader(file):
                columns = cases.setdefault(row.pop("smoother"), {})
                for column, value in row.items():
                    columns.setdefault(column, []).append(float(value))
    return cases


def table(cases):
    print("| smoother, target | remeshes | mean / worst of the smallest r | gain of the mean / of the minimum | time |"
          " nodes moved, mean (most) | mean move / h | largest \\|dV/V\\| |")
    print("|---|---|---|---|---|---|---|---|")
    for name, c in cases.items():
        before, after = c["smallest r before"], c["smallest r after"]
        moved = [m / n for m, n in zip(c["moved nodes"], c["nodes"])]
        time = sum(c["smoothing [CPU s]"]) / sum(c["triangulation [CPU s]"])
        print(f"| {name.replace('=', ', ')} | {len(after)} | {mean(after):.3f} / {min(after):.3g} | "
              f"x {mean(after) / mean(before):.0f} / x {min(after) / min(before):.0f} | {time:.2f} | "
              f"{100 * mean(moved):.1f} % ({100 * max(moved):.1f} %) | {mean(c['mean move']):.2f} | "
              f"{max(abs(v) for v in c['volume change']):.0e} |")


def main():
    picture, *files = sys.argv[1:]
    cases = read(files)
    table(cases)
    figure, axes = plt.subplots(1, 2, figsize=(11, 4), sharey=True)
    for name, columns in cases.items():
        for axis, which in zip(axes, ("before", "after")):
            axis.semilogy(columns["remesh"], columns[f"insphere radius {which}"], label=name.replace("=", ", "))
    for axis, title in zip(axes, ("after the Delaunay triangulation", "after smoothing")):
        axis.set_title(title)
        axis.set_xlabel("remesh")
        axis.grid(True, which="both", alpha=0.3)
    axes[0].set_ylabel("stable step c dt / h = smallest insphere radius / h")
    axes[1].legend(fontsize=8)
    figure.tight_layout()
    figure.savefig(picture, dpi=110)


main()
