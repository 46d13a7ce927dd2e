"""A scene needs the libraries that it names and no other: it runs where all others are deleted from disk."""

import os
import re
import shutil

from _program import EXECUTABLE, SOURCES, Failures, run

failures = Failures()
PLUGINS = os.path.join(os.environ["BREAKWATER_BUILD_DIR"], "lib/breakwater/plugins")
scene = os.path.join(SOURCES, "parameter_files/cookbooks/dam_break.prm")
named = re.search(r"Plugin libraries\s*=(.*)", open(scene, encoding="utf-8").read()).group(1).split(",")
named = [name.strip() for name in named]
failures.check("couplers" not in named and "materials" not in named, "a fluid alone names no coupler")

# The program looks for its plugins beside itself.
shutil.rmtree("tree", ignore_errors=True)
os.makedirs("tree/bin")
os.makedirs("tree/lib/breakwater/plugins")
executable = shutil.copy(EXECUTABLE, "tree/bin/breakwater")
for name in named:
    shutil.copy(os.path.join(PLUGINS, f"lib{name}.so"), "tree/lib/breakwater/plugins")
short = ["--set", "End time=0.01", "--set", "Fluid/Pfem/Spacing=0.01", "--output", "results"]
result = run(scene, *short, executable=executable)
failures.check(result.returncode == 0, f"it runs with {', '.join(named)} alone: {result.stderr}")

os.remove(f"tree/lib/breakwater/plugins/lib{named[-1]}.so")
result = run(scene, *short, executable=executable)
failures.check(result.returncode == 1 and f'the plugin library "{named[-1]}" is not there' in result.stderr,
               f"it says that {named[-1]} is missing: {result.stderr}")
failures.finish()
