"""Installs Breakwater, builds a copy of plugins/TEMPLATE against the installed tree, and runs its scene."""

import csv
import math
import os
import shutil
import subprocess
import sys

from _program import SOURCES, Failures, run

cmake, compiler, generator = sys.argv[1:]
failures = Failures()
for folder in ["installed", "plugin", "plugin-build", "results"]:
    shutil.rmtree(folder, ignore_errors=True)


def command(*arguments):
    result = subprocess.run(arguments, capture_output=True, text=True, timeout=300)
    failures.check(result.returncode == 0, f"{' '.join(arguments)}:\n{result.stdout}{result.stderr}")
    if result.returncode != 0:
        failures.finish()


command(cmake, "--install", os.environ["BREAKWATER_BUILD_DIR"], "--prefix", os.path.abspath("installed"))
shutil.copytree(os.path.join(SOURCES, "plugins/TEMPLATE"), "plugin")
command(cmake, "-G", generator, "-S", "plugin", "-B", "plugin-build", "-D", f"CMAKE_PREFIX_PATH={os.path.abspath('installed')}", "-D",
        f"CMAKE_CXX_COMPILER={compiler}")
command(cmake, "--build", "plugin-build")

result = run("plugin/scene.prm", "--plugin-path", "plugin-build", "--output", "results",
             executable=os.path.abspath("installed/bin/breakwater"))
failures.check(result.returncode == 0, f"the installed program runs its scene: {result.stderr}")
failures.finish()

rows = list(csv.DictReader(open("results/history.csv", encoding="utf-8")))
omega = 2 * math.pi * 3
exact = [2 / omega * (t - math.sin(omega * t) / omega) for t in (float(row["time [s]"]) for row in rows)]
error = max(abs(float(row["corner displacement x [m]"]) - x) for row, x in zip(rows, exact))
print(f"largest error of the displacement: {error / max(exact):.1e} of the largest displacement")
failures.check(error < 1e-3 * max(exact), "the block moves with the table")
failures.finish()
