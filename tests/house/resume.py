"""A run that is interrupted and resumed gives the same bits as one that is not."""

import json
import os
import shutil
import signal
import subprocess
import sys
import time

from _program import EXECUTABLE, SOURCES, Failures, run

failures = Failures()
DAM_BREAK = os.path.join(SOURCES, "parameter_files/cookbooks/dam_break.prm")
JET = os.path.join(SOURCES, "parameter_files/cookbooks/filling_jet.prm")
OBSTACLE = os.path.join(SOURCES, "parameter_files/cookbooks/dam_break_elastic_obstacle.prm")
OBSTACLE_2D = os.path.join(SOURCES, "parameter_files/benchmarks/dam_break_elastic_obstacle_2d.prm")
TIED = os.path.join(SOURCES, "parameter_files/verification/tied_bars.prm")
CASES = {
    "fluid": [DAM_BREAK, "--set", "Fluid/Pfem/Spacing=0.008", "--set", "End time=0.3", "--set",
              "Output/History every=0.003"],
    "openings": [JET, "--set", "Fluid/Pfem/Spacing=0.01", "--set", "End time=0.3", "--set", "Output/History every=0.003",
                 "--set", "Fluid/Pfem/Outflows/Drain/Shape=box(0, 0; 0.3, 0.1)"],
    "coupled, free slip": [OBSTACLE, "--set", "Fluid/Pfem/Spacing=0.02", "--set", "End time=0.3", "--set",
                           "Fluid/Pfem/Law at structures=free slip"],
    "joined structures in a fluid": [
        OBSTACLE, "--set", "Fluid/Pfem/Spacing=0.02", "--set", "End time=0.3", "--set",
        "Structures/Obstacle/Mesh=box(0.292, 0, 0; 0.304, 0.08, 0.15; 1, 3, 4)", "--set",
        "Structures/Second/Mesh=box(0.304, 0, 0; 0.316, 0.08, 0.15; 1, 3, 4)", "--set", "Structures/Second/Clamp=bottom",
        "--set", "Structures/Second/Wet boundaries=left, right, top", "--set",
        "Structures/Second/Material/Model=linear elastic", "--set",
        "Structures/Second/Material/Linear elastic/Young's modulus=1e6", "--set",
        "Structures/Second/Stops=0.33, 0, 0; -1, 0, 0", "--set",
        "Coupling/Ties=Fluid and Obstacle, Fluid and Second, Obstacle and Second"],
    "subcycled": [OBSTACLE_2D, "--set", "End time=0.3", "--set", "Coupling/Gravouil Combescure/Substeps=5", "--set",
                  "Coupling/Gravouil Combescure/Coarse domain=first", "--set",
                  "Coupling/Gravouil Combescure/Interface=non-matching", "--set",
                  "Coupling/Gravouil Combescure/Spacing=0.005"],
    "structures": [TIED, "--set", "End time=0.3", "--set", "Output/History every=0.003", "--set",
                   "Structures/Root/Mesh=box(0, 0; 0.4, 0.1; 32, 8)", "--set",
                   "Structures/Middle/Mesh=box(0.4, 0; 0.7, 0.1; 24, 8)", "--set",
                   "Structures/End/Mesh=box(0.7, 0; 1, 0.1; 24, 8)"],
}


def interrupt_after(n_rows, arguments, folder):
    """Starts a run, stops it by SIGTERM when history.csv has n_rows. @return exit status"""
    history = os.path.join(folder, "history.csv")
    process = subprocess.Popen([EXECUTABLE, *arguments], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    deadline = time.time() + 200
    while process.poll() is None and time.time() < deadline:
        if os.path.exists(history) and open(history, encoding="utf-8").read().count("\n") > n_rows:
            process.send_signal(signal.SIGTERM)
            break
        time.sleep(0.002)
    return process.wait(timeout=100)


for name, arguments in CASES.items():
    for folder in [f"{name}-whole", f"{name}-parts"]:
        shutil.rmtree(folder, ignore_errors=True)
    whole = run(*arguments, "--output", f"{name}-whole")
    failures.check(whole.returncode == 0, f"{name}: the whole run ends well: {whole.stderr}")

    folder = f"{name}-parts"
    status = interrupt_after(60, [*arguments, "--output", folder], folder)
    failures.check(status == 2, f"{name}: an interrupted run ends with status 2: {status}")
    summary = json.load(open(os.path.join(folder, "summary.json"), encoding="utf-8"))
    failures.check(summary["status"] == "interrupted" and summary["end_time"] < 0.3,
                   f"{name}: interrupted at {summary['end_time']} s")
    rest = run(*arguments, "--output", folder, "--resume")
    failures.check(rest.returncode == 0, f"{name}: it goes on: {rest.stderr}")
    for table in sorted(file for file in os.listdir(f"{name}-whole") if file.endswith(".csv")):
        one, two = (open(os.path.join(f, table), encoding="utf-8").read() for f in [f"{name}-whole", folder])
        if table == "remeshing.csv":  # its seconds differ
            one, two = (text.count("\n") for text in [one, two])
        failures.check(one == two, f"{name}: {table} is the same as without an interruption")
    listed = [open(os.path.join(f, "solution.pvd"), encoding="utf-8").read() for f in [f"{name}-whole", folder]]
    failures.check(listed[0].count("<DataSet") <= listed[1].count("<DataSet"), f"{name}: solution.pvd is whole")

failures.finish()
