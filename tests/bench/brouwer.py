#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""tests/bench/brouwer.py PROGRAM [STEPS]: how the error of the energy grows over long motions.

The outer solar system (kahanli8, 40 days a step), a double pendulum that is not chaotic (gauss, 0.02 s a step) and an
oscillator (gauss, a twelfth of a period a step) run for 10 000 steps, ten times as many, and so on up to STEPS
(10 000 000; 100 000 000 takes five minutes). Prints the largest relative error of the energy and its growth as a
power of the number of steps, by least squares over runs whose error is above that of the method. Rounding that is
random gives the power 1/2 (Brouwer's law: Brouwer, Astron. J. 46 (1937) 149); rounding with a bias gives 1.

The solar system is moved to its centre of mass, which the published initial values are not: it would travel
thousands of astronomical units away, and the rounding of positions grows with their size.
"""
import json
import math
import re
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def about_centre_of_mass(file: Path) -> str:
    """The scene, coordinates x, y, z + NAME of bodies with masses m + NAME, with the centre of mass at rest."""
    text = file.read_text()
    scene = tomllib.loads(text)

    def number(value):
        if isinstance(value, str):
            above, _, below = value.partition("/")
            return float(above) / float(below or 1)
        return float(value)

    mass = {name[1:]: number(m) for name, m in scene["parameters"].items() if name[1:2].isupper()}
    start = {}
    for name, c in scene["coordinates"].items():
        start[name] = (c.get("initial", 0), c.get("rate", 0)) if isinstance(c, dict) else (c, 0)
    lines = []
    for name, (q, u) in start.items():
        middle = [sum(m * start[name[0] + body][k] for body, m in mass.items()) / sum(mass.values()) for k in (0, 1)]
        lines.append(f"{name} = {{ initial = {q - middle[0]!r}, rate = {u - middle[1]!r} }}")
    return re.sub(r"(?ms)^\[coordinates\]\n.*?(?=^\[)", "[coordinates]\n" + "\n".join(lines) + "\n\n", text)


def energy_error(program: str, scene: str, method: str, step: float, steps: int) -> float:
    length = step * steps
    command = [program, "simulate", scene, "--method", method, "--step", repr(step), "--duration", repr(length)]
    command += ["--sample", repr(length / 100), "--no-estimate", "--budget", str(100 * steps), "--json"]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    return json.loads(done.stdout)["energy_drift"]


def main() -> int:
    program = sys.argv[1]
    most = int(sys.argv[2]) if len(sys.argv) > 2 else 10_000_000
    benchmark = ROOT / "scenes" / "benchmark"
    with tempfile.TemporaryDirectory() as folder:
        oscillator = Path(folder) / "oscillator.toml"
        oscillator.write_text('[coordinates]\nx = 1\n[energy]\nkinetic = "x\'^2/2"\npotential = "x^2/2"\n')
        solar = Path(folder) / "solar.toml"
        solar.write_text(about_centre_of_mass(benchmark / "outer_solar_system.toml"))
        worst = 0.0
        for scene, method, step in [(str(solar), "kahanli8", 40.0),
                                    (str(benchmark / "double_pendulum_regular.toml"), "gauss", 0.02),
                                    (str(oscillator), "gauss", 0.5)]:
            counts = [10**k for k in range(4, 1 + round(math.log10(most)))]
            errors = []
            for steps in counts:
                errors.append(energy_error(program, scene, method, step, steps))
                print(f"{Path(scene).stem:24}{method:10}{steps:>11} steps   energy error {errors[-1]:.2g}", flush=True)
            grown = [(math.log(n), math.log(e)) for n, e in zip(counts, errors) if e > 1.3 * errors[0]]  # beyond the method's own
            if len(grown) > 1:
                mean = [sum(column) / len(grown) for column in zip(*grown)]
                power = sum((x - mean[0]) * (y - mean[1]) for x, y in grown) / sum((x - mean[0]) ** 2 for x, _ in grown)
                worst = max(worst, power)
                print(f"{'':24}grows as steps^{power:.2f}")
    return 0 if worst < 0.75 else 1


if __name__ == "__main__":
    sys.exit(main())
