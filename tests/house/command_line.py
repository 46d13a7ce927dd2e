"""Exit statuses and messages of the program, and what it leaves in the output folder."""

import csv
import glob
import json
import os
import re
import shutil
import subprocess

from _program import EXECUTABLE, SOURCES, Failures, run, scene_file

failures = Failures()


def expect(status, message, *arguments):
    """The run ends with this status; at status 0 the message is in stdout, else it is the one message on stderr."""
    result = run(*arguments)
    text = result.stdout if status == 0 else result.stderr
    failures.check(result.returncode == status and message in text,
                   f"{' '.join(arguments)}: wanted {status} and '{message}', got {result.returncode} and "
                   f"'{result.stdout}{result.stderr}'")
    if status == 1:
        failures.check(result.stderr.count("breakwater: ") == 1 and "Stack" not in result.stderr,
                       f"{' '.join(arguments)}: one message without a stack trace, got '{result.stderr}'")


scene = scene_file("block.prm")
expect(0, "usage:", "--help")
expect(0, "deal.II-", "--version")
expect(1, "a parameter file is missing")
expect(1, 'did you mean "--resume"?', scene, "--resum")
expect(1, "needs a value", scene, "--output")
expect(1, "can't read the parameter file nowhere.prm", "nowhere.prm")
expect(1, "one parameter file at a time", scene, scene)
expect(1, "is not a folder", scene, "--plugin-path", "nowhere")
expect(0, "Linear elastic", "--list-plugins")
expect(0, "subsection Linear elastic", "--print-parameters")
expect(0, "is valid", scene, "--validate")

expect(1, 'dimension.prm:2: at the top level, entry "Dimension", value "4"',
       scene_file("dimension.prm", ("Dimension = 2", "Dimension = 4")))
expect(1, 'did you mean "materials"?', scene_file("library.prm", ("materials, body", "material, body")))
expect(1, "must be a bare name", scene_file("path.prm", ("= materials, body", "= ./materials, body")))
with open("nothing.prm", "w", encoding="utf-8") as file:
    file.write("set End time = 1\n")
expect(1, "there is nothing to simulate", "nothing.prm")
expect(1, 'section "Structures/Block/Material"', scene, "--set", "Structures/Block/Material/Model=rubber")
expect(1, "command line: ", scene, "--set", "Structures/Block/Degree=3")
expect(1, 'section "Structures/Second", entry "Mesh" (not set)', scene, "--set", "Structures/Second/Degree=1")
tied = os.path.join(SOURCES, "parameter_files/verification/tied_bars.prm")
for ties, message in (("Root and Midle", 'no body is called "Midle"; did you mean "Middle"?'),
                      ("Root, End", 'can\'t read the tie "Root"; the form is NAME and NAME'),
                      ("Root and Root", '"Root" can\'t be tied to itself'),
                      ("Root and Middle, Middle and Root", "are tied twice"),
                      ("", "say which of the structures are tied"),
                      ("Root and End, Middle and End", 'entry "Ties", value "Root and End, Middle and End": "Root" and '
                       '"End" are tied to each other, but their wet boundaries have no node in common'),
                      ("Root and Middle, Middle and End, Root and End", '"Root" and "End" are tied to each other, but')):
    expect(1, message, tied, "--validate", "--set", f"Coupling/Ties={ties}")
expect(1, "bodies can't be tied without a coupler", tied, "--set", "Coupling/Model=")
expect(1, "there is no second body to couple", scene, "--set", "Plugin libraries=materials, body_forces, couplers",
       "--set", "Coupling/Model=gravouil combescure")
expect(1, 'no structure is called "Blok"; did you mean "Block"?', scene, "--set", "Output/Probes=tip: Blok(0, 0)")
expect(1, "away from the nearest node of \"Block\", at (0.5, 0.5)", scene, "--set",
       "Output/Probes=tip: Block(0.6, 0.6)")
expect(1, "can't read the probe", scene, "--set", "Output/Probes=tip")
expect(1, "there is no checkpoint", scene, "--output", "none", "--resume")
expect(1, "can't make the output folder", scene, "--output", "/proc/nothing")
obstacle = os.path.join(SOURCES, "parameter_files/cookbooks/dam_break_elastic_obstacle.prm")
with open("uncoupled.prm", "w", encoding="utf-8") as file:
    file.write(re.sub(r"\nsubsection Coupling\n.*?\nend\n", "\n", open(obstacle, encoding="utf-8").read(), flags=re.S))
expect(1, "a fluid and a structure need a coupler", "uncoupled.prm", "--validate")
second = ["--set", "Structures/Second/Mesh=box(0.304, 0, 0; 0.31, 0.08, 0.15; 1, 6, 8)",
          "--set", "Structures/Second/Material/Model=linear elastic", "--set",
          "Structures/Second/Material/Linear elastic/Young's modulus=1e6",
          "--set", "Structures/Second/Material/Linear elastic/Density=1000"]
expect(1, "nodes but are not tied to each other", obstacle, "--validate", *second)
expect(1, 'nothing ties "Second" to the fluid', obstacle, "--validate", *second, "--set", "Coupling/Ties=Fluid and Obstacle")

# A run, and what it leaves.
shutil.rmtree("results", ignore_errors=True)
expect(0, "Results are in results", scene, "--output", "results", "--set", "Output/Probes=corner: Block(0, 0)")
with open("results/history.csv", encoding="utf-8") as file:
    rows = list(csv.DictReader(file))
failures.check(len(rows) == 11, "history.csv has a row at each of the 11 times")
fall = -0.5 * 10 * 0.01**2
failures.check(abs(float(rows[-1]["corner displacement y [m]"]) / fall - 1) < 1e-6, "the block falls by g t^2 / 2")
failures.check(all(abs(float(row["total energy [J]"]) - float(rows[0]["total energy [J]"])) < 1e-6 for row in rows),
               "its energy stays")
with open("results/summary.json", encoding="utf-8") as file:
    summary = json.load(file)
failures.check(summary["status"] == "finished" and summary["end_time"] == 0.01, "summary.json tells the end")
for key in ["wall_seconds", "cpu_seconds", "cpu_seconds_by_phase", "steps", "cell_steps",
            "cell_steps_per_cpu_second", "n_remeshes", "peak_memory_bytes", "effects_active", "effects_skipped"]:
    failures.check(key in summary, f"summary.json has {key}")
with open("results/solution.pvd", encoding="utf-8") as file:
    pvd = file.read()
failures.check(pvd.count("<DataSet") == 3 and pvd.count("timestep=") == 3, "solution.pvd lists 3 times")
failures.check(all(os.path.exists(f"results/Block-000{i}.vtu") for i in [1, 2, 3]), "their files are there")
failures.check(not glob.glob("results/*.new"), "no file is left half written")
expect(0, "Results are in results", scene, "--output", "results", "--set", "Output/Fields every=0")
failures.check(not os.path.exists("results/Block-0003.vtu"), "the files of an earlier run are gone")

# The complete parameters of a run make the same run.
expect(0, "Results are in again", "results/parameters.prm", "--output", "again")
failures.check(open("results/history.csv").read() == open("again/history.csv").read(), "parameters.prm repeats the run")

# No directory for an MPI session: programs that run side by side would delete each other's.
result = run(scene, "--output", "alone", environment={"TMPDIR": os.path.abspath(scene)})
failures.check(result.returncode == 0, f"it runs where no temporary directory can be made: {result.stderr}")

# A numerical breakdown: a block torn apart.
result = run(scene, "--output", "torn", "--set", "Structures/Block/Initial velocity=1e6*x*x, 0")
failures.check(result.returncode == 2 and "numerical breakdown" in result.stderr,
               f"a breakdown ends with status 2: {result.returncode} {result.stderr}")
with open("torn/summary.json", encoding="utf-8") as file:
    summary = json.load(file)
failures.check(summary["status"] == "breakdown" and summary["message"] in result.stderr, "summary.json says why")
failures.check(summary["message"] in open("torn/report.html").read(), "report.html says why")
times = re.findall('timestep="([^"]*)"', open("torn/solution.pvd").read())
failures.check(float(times[-1]) == summary["end_time"] > 0, f"the last fields are those of the breakdown: {times}")

# Every shipped scene is valid.
scenes = sorted(glob.glob(os.path.join(SOURCES, "parameter_files/*/*.prm")))
failures.check(len(scenes) >= 2, "there are scenes")
for shipped in scenes:
    expect(0, "is valid", shipped, "--validate")

if shutil.which("mpirun"):
    ranks = subprocess.run(["mpirun", "--oversubscribe", "--mca", "btl", "self,vader", "-n", "2", EXECUTABLE, scene, "--output", "ranks"],
                           capture_output=True, text=True, timeout=300)
    failures.check(ranks.returncode == 1 and ranks.stderr.count("runs on one rank only") == 1,
                   f"two ranks are refused once: {ranks.returncode} {ranks.stderr}")

failures.finish()
