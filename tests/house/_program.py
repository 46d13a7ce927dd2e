"""Runs the program for the tests."""

import os
import subprocess
import sys

EXECUTABLE = os.environ["BREAKWATER_EXECUTABLE"]
SOURCES = os.environ["BREAKWATER_SOURCE_DIR"]

# A block without any support under gravity: runs in a blink.
SCENE = """
set Dimension = 2
set End time = 0.01
set Plugin libraries = materials, body_forces
subsection Body forces
  set Models = gravity
  subsection Gravity
    set Acceleration = 0, -10
  end
end
subsection Structures
  subsection Block
    set Mesh = box(0, 0; 1, 1; 2, 2)
    subsection Material
      set Model = linear elastic
      subsection Linear elastic
        set Density = 1000
        set Young's modulus = 1e7
        set Poisson's ratio = 0.3
      end
    end
  end
end
subsection Output
  set Fields every = 0.005
end
"""


def scene_file(name, *changes):
    """Writes SCENE with changes [(old, new), ...] to a file."""
    text = SCENE
    for old, new in changes:
        assert old in text, old
        text = text.replace(old, new)
    with open(name, "w", encoding="utf-8") as file:
        file.write(text)
    return name


def run(*arguments, executable=EXECUTABLE, timeout=300, environment=None):
    return subprocess.run([executable, *arguments], capture_output=True, text=True, timeout=timeout,
                          env={**os.environ, **(environment or {})})


class Failures:
    """Collects what went wrong, so that one run shows all of it."""

    def __init__(self):
        self.messages = []

    def check(self, condition, message):
        print(("ok    " if condition else "WRONG ") + message.split("\n")[0])
        if not condition:
            self.messages.append(message)

    def finish(self):
        if self.messages:
            sys.exit(f"{len(self.messages)} failed:\n" + "\n".join(self.messages))
