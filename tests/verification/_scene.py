"""Runs a parameter file of the project and reads its history.csv; collects what a verification finds wrong."""

import csv
import json
import math
import os
import shutil
import subprocess
import sys

EXECUTABLE = os.environ["BREAKWATER_EXECUTABLE"]
SOURCES = os.environ["BREAKWATER_SOURCE_DIR"]


def run(scene, settings=None, output="output", expected_exit=0):
    """Runs parameter_files/SCENE with {"Section/Entry": value} set; the columns of history.csv by their names."""
    shutil.rmtree(output, ignore_errors=True)
    command = [EXECUTABLE, os.path.join(SOURCES, "parameter_files", scene), "--output", output]
    for entry, value in (settings or {}).items():
        command += ["--set", f"{entry}={value}"]
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    if result.returncode != expected_exit:
        sys.exit(f"{' '.join(command)}\nended with {result.returncode}:\n{result.stderr}")
    return read_columns(os.path.join(output, "history.csv"))


def read_summary(output="output"):
    with open(os.path.join(output, "summary.json"), encoding="utf-8") as file:
        return json.load(file)


def read_columns(file_name):
    """The columns of a CSV file, [name][row]; lines that start with # are comments."""
    with open(file_name, encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    return {name: [float(row[name]) for row in rows] for name in rows[0]}


class Verification:
    def __init__(self):
        self.failures = 0

    def check(self, name, value, lower, upper):
        """Prints the value and whether it is within the bounds, both included."""
        right = lower <= value <= upper
        print(f"{'ok   ' if right else 'WRONG'} {name}: {value:.6g}, allowed {lower:g} to {upper:g}")
        self.failures += not right

    def rate(self, name, spacings, errors):
        """Prints the errors at several spacings; returns the mean rate by which they fall, from the outermost two."""
        for spacing, error in zip(spacings, errors):
            print(f"{name}, spacing {spacing} m: {error:.3e}")
        rate = math.log(errors[0] / errors[-1]) / math.log(spacings[0] / spacings[-1])
        print(f"{name}, rate: {rate:.2f}")
        return rate

    def finish(self):
        sys.exit(f"{self.failures} of the values are out of bounds" if self.failures else 0)
