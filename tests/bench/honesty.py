#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Is the error that `simulate` tells at least the true one? Every method on every scene at several tolerances.

    tests/bench/honesty.sh [--scenes GLOB] [--methods LIST] [--tolerances LIST] [--duration SECONDS] [--csv FILE] [BUILD]

The truth is the distance from the reference of `bench` (binary128, digits that two methods agree on), as the largest
|y - reference| / max(1, |reference|) over coordinates and rates at the end; the told value is `error_estimate.value`.
Runs that fail, and scenes without a reference of 20 digits, are left out and counted. For each method: how many runs
tell at least the truth (the goal is 95 %), the median of told / true, runs that tell 0 for an error above 1e-15, and
runs that are called trustworthy though the truth is above 0.01.
"""

import argparse
import glob
import json
import math
import os
import statistics
import subprocess
import sys
import tomllib

METHODS = "auto dopri5 dop853 verner98 abm bdf taylor radau rk4 gauss"
FIXED = {"rk2": 2, "euler": 1, "rk4": 4, "verlet": 2, "gauss": 6, "kahanli8": 8}


def answer(*command):
    done = subprocess.run(command, capture_output=True, text=True)
    try:
        return json.loads(done.stdout)
    except json.JSONDecodeError:
        return None


def true_error(final, reference):
    worst = 0.0
    for part in ("coordinates", "rates"):
        for name, there in reference[part].items():
            worst = max(worst, abs(final[part][name] - there) / max(1.0, abs(there)))
    return worst


def runs_of(program, scene, methods, tolerances, longest):
    with open(scene, "rb") as file:
        duration = tomllib.load(file).get("simulation", {}).get("duration", 10.0)
    duration = min(float(duration), longest)
    options = ["--duration", repr(duration), "--budget", "400000"]
    found = answer(program, "bench", scene, "--json", "--method", "dop853", "--reference-seconds", "2", *options)
    if not found or not found.get("reference") or found["reference"].get("digits", 0) < 20:
        return None
    reference = found["reference"]["final"]
    rows = []
    for method in methods:
        for tolerance in tolerances:
            how = ["--tolerance", repr(tolerance)]
            if method in FIXED:
                how = ["--step", repr(min(0.1, tolerance ** (1 / FIXED[method])) * min(1.0, duration / 10))]
            run = answer(program, "simulate", scene, "--json", "--method", method, *how, *options)
            if not run or "error_estimate" not in run or run["error_estimate"]["value"] is None:
                continue
            if abs(run["final"]["time"] - reference["time"]) > 1e-6:
                continue
            estimate = run["error_estimate"]
            rows.append({"scene": os.path.basename(scene)[:-5], "method": method, "tolerance": tolerance,
                         "true": true_error(run["final"], reference), "told": estimate["value"],
                         "trustworthy": run.get("trustworthy", estimate.get("trustworthy"))})
    return rows


def summary(rows):
    print(f"{'method':10} {'runs':>5} {'told >= true':>13} {'told / true':>12} {'told 0':>7} {'wrongly trusted':>16}")
    for method in [*dict.fromkeys(row["method"] for row in rows), "all"]:
        own = [row for row in rows if method in ("all", row["method"])]
        bounded = sum(row["told"] >= row["true"] for row in own) / len(own)
        ratios = [row["told"] / row["true"] for row in own if row["true"] > 0]
        nothing = sum(row["told"] == 0 and row["true"] > 1e-15 for row in own)
        wrong = sum(bool(row["trustworthy"]) and row["true"] > 1e-2 for row in own)
        middle = statistics.median(ratios) if ratios else math.nan
        print(f"{method:10} {len(own):5} {100 * bounded:11.1f} % {middle:12.2f} {nothing:7} {wrong:16}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    here = os.path.dirname(os.path.abspath(__file__))
    parser.add_argument("--scenes", default=os.path.join(here, "../../scenes/*/*.toml"))
    parser.add_argument("--methods", default=METHODS)
    parser.add_argument("--tolerances", default="1e-3 1e-6 1e-9 1e-12")
    parser.add_argument("--duration", type=float, default=5.0)
    parser.add_argument("--csv")
    wishes = parser.parse_args()
    rows, left_out = [], []
    for scene in sorted(glob.glob(wishes.scenes)):
        found = runs_of(wishes.program, scene, wishes.methods.split(), [float(x) for x in wishes.tolerances.split()],
                        wishes.duration)
        if found is None:
            left_out.append(os.path.basename(scene)[:-5])
        else:
            rows += found
        print(f"\r{len(rows)} runs, {os.path.basename(scene):40}", end="", file=sys.stderr, flush=True)
    print(file=sys.stderr)
    if wishes.csv:
        with open(wishes.csv, "w") as file:
            print("scene,method,tolerance,true,told,trustworthy", file=file)
            for row in rows:
                print(",".join(str(row[key]) for key in row), file=file)
    if rows:
        summary(rows)
    print(f"{len(left_out)} scenes without a reference: {' '.join(left_out)}")


main()
