# SPDX-License-Identifier: MIT
"""Units under FMPy: each is valid by the schemas of FMI that FMPy brings, and moves as `simulate` says, in model exchange
(under CVODE) and in co-simulation, with any interval of its outputs.

    fmpy_units.py PROGRAM          (needs FMPy from PyPI; tests/written_elsewhere.sh)"""

import json
import os
import subprocess
import sys
import tempfile

import fmpy
from fmpy.validation import validate_fmu

PROGRAM = os.path.abspath(sys.argv[1])
SCENES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../scenes")
PARTICLE = """[coordinates]
x = {{ initial = {}, rate = {} }}
[[particle]]
name = "P"
mass = 1
position = ["x", 0]
"""


def force(text):
    return f'[forces]\nx = "{text}"\n'


def kick(when, impulse, direction="both"):
    one_way = "" if direction == "both" else f'direction = "{direction}"\n'
    return f'[[event]]\nname = "e{len(when)}{direction}"\nwhen = "{when}"\nimpulses = {{ x = "{impulse}" }}\n{one_way}'


EVERYDAY = [
    (0, 0, force("(1 + sign(t - 5))/2")), (0, 0, force("max(0, t - 5)")), (0, 0, force("abs(t - 5)")),
    (0, 0, force("sign(sin(pi*t))")), (0, 0, force("sign(sin(3*t))")), (1, 0, force("-sign(x)")),
    (1, 0, force("-x - 20*max(0, -x)")), (0, 1, force("-30*max(0, x - 5)")), (0, 1, force("-30*max(0, x - 3.3)")),
    (0, 1, force("-0.3*x'*abs(x') + cos(t)")), (0, 1, kick("x - 5", "-2*x'")), (0, 1, kick("t - 5", "-2*x'")),
    (0, 1, kick("t - 3.3", "-2*x'")), (1, 0, force("-x") + kick("x", "0.2*x'")),
    (0, 1, '[[event]]\nname = "e"\nwhen = "t - 5"\nstop = true\n'), (0, 1, '[[event]]\nname = "e"\nwhen = "x - 5"\nstop = true\n'),
    (0.3, 1, kick("x - 1", "-2*x'", "up") + kick("x", "-2*x'", "down")), (0, 1, kick("sin(pi*t)", "0.3")),
    (0, 1, force("-min(x, 2)")), (3, 0, force("-max(0, x - 1) - min(0, x + 1)")),
    (1, 0, force("-9.81") + kick("x", "-2*x'", "down")), (0, 1, kick("x - 1.1", "1") + kick("x' - 1.5", "3")),
]  # yapf: disable
WHOLE = ["textbook/double_pendulum", "textbook/slider_crank", "textbook/cart_pole", "textbook/free_body_quaternion",
         "textbook/chaplygin_sleigh_in_speeds"]  # yapf: disable


def told(*arguments):
    done = subprocess.run([PROGRAM, *arguments], capture_output=True, text=True)
    assert done.returncode == 0, (arguments, done.stderr)
    return done.stdout


def differs(row, final):
    """The largest difference of a coordinate, relative to max(1, |x|)."""
    wanted = final["coordinates"].items()
    return max(abs(row[name] - x) / max(1, abs(x)) for name, x in wanted if name in row.dtype.names)


def main():
    runs = bad = 0
    with tempfile.TemporaryDirectory() as folder:
        unit = os.path.join(folder, "unit.fmu")
        scenes = []
        for number, (x, v, rest) in enumerate(EVERYDAY):
            scenes.append(os.path.join(folder, f"scene{number}.toml"))
            with open(scenes[-1], "w", encoding="utf-8") as file:
                file.write(PARTICLE.format(x, v) + rest)
        for scene in scenes + [os.path.join(SCENES, name + ".toml") for name in WHOLE]:
            end = 10 if scene in scenes else 2
            final = json.loads(told("simulate", scene, "--duration", str(end), "--json"))["final"]
            for version in "23":
                told("emit", scene, "--fmu", unit, "--fmi", version)
                problems = validate_fmu(unit)
                if problems:
                    bad += 1
                    print(scene, "FMI", version, *problems, sep="\n  ")
                names = [one.name for one in fmpy.read_model_description(unit).modelVariables]
                wanted = [name for name in final["coordinates"] if name in names]
                for kind in ("ModelExchange", "CoSimulation"):
                    for interval in (None, 0.5, 0.01, 0.0371):
                        rows = fmpy.simulate_fmu(unit, fmi_type=kind, stop_time=end, output=wanted, output_interval=interval,
                                                 relative_tolerance=1e-9)  # yapf: disable
                        runs += 1
                        off = differs(rows[-1], final)
                        # The last row of a run that an interval does not divide lies before the end.
                        if rows[-1]["time"] < final["time"] - 1e-9 and interval == 0.0371:
                            continue
                        if not off < 1e-4:
                            bad += 1
                            print(f"{scene}: FMI {version}, {kind}, interval {interval}: off by {off:.2e}")
    print(f"{runs} runs under FMPy {fmpy.__version__}, {bad} wrong")
    return 1 if bad else 0


sys.exit(main())
