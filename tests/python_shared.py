# SPDX-License-Identifier: MIT
"""What the tests of the Python package share."""

import json
import os
import subprocess
import sys

PROGRAM = os.path.abspath(sys.argv.pop(1))
TESTS = os.path.dirname(os.path.abspath(__file__))
SCENES = os.path.join(TESTS, "../scenes")
EXAMPLES = os.path.join(TESTS, "../examples")
NO_SKIP = "ALEMBERT_NO_SKIP" in os.environ  # test.sh has installed all that tests need

PENDULUM = {
    "gravity": [0, "-g"],
    "parameters": {"m": 2.0, "l": 1.5, "g": 9.81},
    "coordinates": {"theta": {"initial": 0.4, "rate": 0.1}},
    "particle": [{"name": "P", "mass": "m", "position": ["l*sin(theta)", "-l*cos(theta)"]}],
}


def scene_file(name):
    return os.path.join(SCENES, name)


def program(*arguments):
    """The JSON of the command, but for its warnings, which are SceneWarning in Python."""
    told = json.loads(subprocess.run([PROGRAM, *arguments, "--json"], capture_output=True, text=True).stdout)
    told.pop("warnings", None)
    return told
