#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Whether two builds of the program give the same motions, bit by bit.

    tests/same_motions.py record BEFORE/alembert /tmp/before.json      # some minutes
    tests/same_motions.py compare build/release/generator/alembert /tmp/before.json

Each scene under scenes/ runs by the method that the program chooses, with its estimated error (whose second runs disturb each
jump), with --regularize, and by some of the other methods in turn, so that each method meets a tenth of the scenes or more. Compared are
the table (CSV, 17 digits), what `simulate --json` says but for times, the exit code and the messages. Runs that take longer than
--seconds are left out."""

import argparse
import concurrent.futures
import hashlib
import json
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
TURNS = [
    ["--method", "dop853"], ["--method", "radau"], ["--method", "taylor"], ["--method", "verner98"], ["--method", "bdf"],
    ["--method", "rk4", "--step", "0.004"], ["--method", "dopri5"], ["--method", "gauss", "--step", "0.01"],
    ["--method", "cvode"], ["--method", "abm"], ["--method", "ida"], ["--method", "verlet", "--step", "0.004"],
    ["--method", "verner76"], ["--method", "radau5"], ["--method", "rattle", "--step", "0.01"],
    ["--method", "kahanli8", "--step", "0.02"], ["--method", "radau9"], ["--budget", "700"], ["--tolerance", "1e-5"],
    ["--method", "rattle8", "--step", "0.02"], ["--method", "radau13"], ["--method", "euler", "--step", "0.002"],
    ["--method", "rk2", "--step", "0.004"], ["--tolerance", "1e-12"], ["--budget", "150"], ["--method", "rkn1210"],
    ["--method", "rkn86"],
]
EACH = 4  # of these for each scene


def jobs():
    scenes = sorted(p.relative_to(ROOT).as_posix() for p in (ROOT / "scenes").rglob("*.toml"))
    for number, scene in enumerate(scenes):
        yield scene, []
        yield scene, ["--regularize", "--no-estimate"]
        for k in range(EACH):
            yield scene, [*TURNS[(number * EACH + k) % len(TURNS)], "--no-estimate"]


def run(program, scene, options, seconds):
    """A text that says all that is compared; nothing if it takes too long."""
    with tempfile.TemporaryDirectory() as folder:
        table = pathlib.Path(folder, "rows.csv")
        command = [program, "simulate", scene, "--json", "--code", "memory", "-o", str(table), *options]
        try:
            done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, timeout=seconds)
        except subprocess.TimeoutExpired:
            return None
        said = re.sub(r'"seconds": \{[^}]*\}', "", done.stdout).replace(folder, "")
        errors = re.sub(r"\d+(\.\d+)?(e-?\d+)? m?s\b", "", done.stderr).replace(folder, "")
        rows = table.read_bytes() if table.exists() else b""
    return {"exit": done.returncode, "said": said, "errors": errors, "rows": rows.count(b"\n"),
            "sha": hashlib.sha256(rows).hexdigest()}


def all_runs(program, seconds, workers):
    program = str(pathlib.Path(program).resolve())
    with concurrent.futures.ThreadPoolExecutor(workers) as pool:
        runs = {" ".join([scene, *options]): pool.submit(run, program, scene, options, seconds) for scene, options in jobs()}
        return {name: one.result() for name, one in runs.items()}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("what", choices=["record", "compare"])
    parser.add_argument("program")
    parser.add_argument("file")
    parser.add_argument("--seconds", type=float, default=8)
    parser.add_argument("--jobs", type=int, default=2)
    asked = parser.parse_args()
    if asked.what == "record":
        runs = all_runs(asked.program, asked.seconds, asked.jobs)
        pathlib.Path(asked.file).write_text(json.dumps(runs))
    before = json.loads(pathlib.Path(asked.file).read_text())
    if asked.what == "compare":
        runs = all_runs(asked.program, asked.seconds, asked.jobs)
        differ = [name for name, one in before.items() if one and runs.get(name) and one != runs[name]]
        for name in differ:
            parts = [part for part in before[name] if before[name][part] != runs[name][part]]
            print(f"{name}: {', '.join(parts)}")
            for part in ("errors", "exit"):
                if part in parts:
                    print(f"  before: {before[name][part]}\n  now:    {runs[name][part]}")
    compared = [name for name, one in before.items() if one and runs.get(name)]
    print(f"{len(runs)} runs, {len(compared)} compared, of which {sum(before[name]['exit'] == 0 for name in compared)} ended well, "
          f"{sum(before[name]['rows'] for name in compared)} rows")
    if asked.what == "compare":
        print(f"{len(differ)} differ")
        sys.exit(1 if differ or not compared else 0)


main()
