"""Runs a scene and compares the last row of its history.csv with the numbers in NAME.expected beside it.

Each line of NAME.expected: column name = value +- tolerance, or `summary KEY = value +- tolerance` for a number of
summary.json. With --update the values are written anew, the tolerances kept: only for a change that is meant.
Smooth motions are compared by digits; what splashes belongs to tests/verification, with bounds.
"""

import csv
import json
import os
import re
import shutil
import subprocess
import sys

EXECUTABLE = os.environ["BREAKWATER_EXECUTABLE"]


def measure(scene):
    shutil.rmtree("output", ignore_errors=True)
    result = subprocess.run([EXECUTABLE, scene, "--output", "output"], capture_output=True, text=True, check=False)
    if result.returncode != 0:
        sys.exit(f"{scene} ended with {result.returncode}:\n{result.stderr}")
    with open("output/history.csv", encoding="utf-8") as file:
        values = {name: float(value) for name, value in list(csv.DictReader(file))[-1].items()}
    with open("output/summary.json", encoding="utf-8") as file:
        values.update({f"summary {name}": value for name, value in json.load(file).items()
                       if isinstance(value, (int, float))})
    return values


def main():
    scene = sys.argv[1]
    expected = os.path.splitext(scene)[0] + ".expected"
    values = measure(scene)
    with open(expected, encoding="utf-8") as file:
        lines = [re.fullmatch(r"(.+?) = (\S+) \+- (\S+)", line.strip()) for line in file if line.strip()]
    if "--update" in sys.argv:
        with open(expected, "w", encoding="utf-8") as file:
            file.writelines(f"{line[1]} = {values[line[1]]:.15g} +- {line[3]}\n" for line in lines)
        return
    wrong = 0
    for name, value, tolerance in (line.groups() for line in lines):
        is_right = abs(values[name] - float(value)) <= float(tolerance)
        print(f"{'ok   ' if is_right else 'WRONG'} {name} = {values[name]:.9g}, expected {value} +- {tolerance}")
        wrong += not is_right
    if wrong or not lines:
        sys.exit(f"{wrong} of {len(lines)} numbers are not as expected")


main()
