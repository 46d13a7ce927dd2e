#!/usr/bin/env python3
"""Plots the tip's displacement of runs against published curves:
./doc/plot_tip.py PICTURE.png LABEL=OUTPUT_DIRECTORY [LABEL=OUTPUT_DIRECTORY ...]

Needs python3-matplotlib. The published curves stand in tests/reference_data, with their sources.
"""
import csv
import glob
import os
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt


def published(path):
    with open(path) as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))[1:]
    return [float(row[0]) for row in rows], [1e3 * float(row[1]) for row in rows]


def simulated(directory):
    with open(os.path.join(directory, "history.csv")) as file:
        rows = list(csv.DictReader(file))
    return [float(row["time [s]"]) for row in rows], [1e3 * float(row["tip displacement x [m]"]) for row in rows]


def main():
    picture, *runs = sys.argv[1:]
    here = os.path.dirname(os.path.abspath(__file__))
    figure, axis = plt.subplots(figsize=(8, 4))
    for path in sorted(glob.glob(os.path.join(here, "../tests/reference_data/dambreak_elastic_*.csv"))):
        name = os.path.basename(path)[:-4].split("_")[3]
        axis.plot(*published(path), lw=0.8, color="0.6")
        axis.annotate(name.capitalize(), (published(path)[0][-1], published(path)[1][-1]), fontsize=6, color="0.4")
    for run in runs:
        label, directory = run.split("=", 1)
        axis.plot(*simulated(directory), lw=1.8, label=label)
    axis.set_xlabel("time [s]")
    axis.set_ylabel("displacement of the tip [mm]")
    axis.set_title("Dam break with an elastic obstacle; grey: published 2D results", fontsize=10)
    axis.legend()
    axis.grid(alpha=0.3)
    figure.tight_layout()
    figure.savefig(picture, dpi=110)


if __name__ == "__main__":
    main()
