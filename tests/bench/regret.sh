#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The regret of the method `auto`: the processor time of its integration over that of the fastest method that reaches at
# least the true error that auto reaches, as `bench` measures both. 1 is the best choice.
#
#   tests/bench/regret.sh [--scenes "NAME …"] [--duration S] [--reference-seconds S] [--code KIND] [--cold] [--json FILE]
#                         [PROGRAM]
#
# A NAME is that of a scene without its folder, or a pattern (--scenes "kepler pend*"); without it, all scenes (hours).
# Errors below 1e-14, or below the digits of the reference, count as equal; runs without a right digit (an error above
# 0.1) and motions that stay at rest (no error) do not count. Scenes with contacts, impacts or jumps, where bench follows
# no choice, and those that have no reference of 9 digits are counted as left out. Code is machine code in memory, in
# which runs of less than a second begin; --code compiled takes that of the compiler. Methods are followed to runs four times
# as long as those of auto. A second summary compares auto at 1e-9 and above with the methods that need no power series.
# --cold adds, at 1e-6, 1e-9 and 1e-12, the process time of the whole of `simulate` with nothing cached (compilers
# included) over the least among auto, the fastest method of the table, dop853 and verner98.
# PROGRAM: build/release/generator/alembert.
set -eu
root=$(cd -- "$(dirname -- "$0")/../.." && pwd)
exec python3 -B - "$root" "$@" <<'PYTHON'
import fnmatch
import glob
import json
import math
import os
import resource
import shutil
import subprocess
import sys
import tempfile

root = sys.argv[1]
sys.path.append(os.path.join(root, "tests/bench"))
from measuring import keep, options, read

parser = options("regret.sh", root)
parser.add_argument("--scenes", default="*")
parser.add_argument("--duration")
parser.add_argument("--reference-seconds", default="10")
parser.add_argument("--code", default="memory", choices=["memory", "compiled"])
parser.add_argument("--cold", action="store_true")
wishes = read(parser, sys.argv[2:])
program = wishes.program
patterns = wishes.scenes.replace(",", " ").split()
scenes = [path for path in sorted(glob.glob(root + "/scenes/**/*.toml", recursive=True))
          if any(fnmatch.fnmatch(os.path.basename(path)[:-5], pattern) for pattern in patterns)]
if not scenes:
    sys.exit(f"no scene is named like {wishes.scenes}")
cache = tempfile.mkdtemp()
os.environ["XDG_CACHE_HOME"] = cache
more = ["--duration", wishes.duration] if wishes.duration else []
TIGHTEST, COLD, MOST = 1e-13, (1e-6, 1e-9, 1e-12), 2.0


def benched(scene):
    """With methods followed to runs that take four times as long as the longest of auto: a run that is not measured has a
    looser tolerance than one that takes half of the limit, or twice the steps of one that takes a quarter."""
    limit = 0.05
    while True:
        done = subprocess.run([program, "bench", scene, "--json", "--reference-seconds", wishes.reference_seconds, "--code",
                               wishes.code, "--run-seconds", repr(limit), *more], capture_output=True, text=True)
        if done.returncode != 0:
            return None
        result = json.loads(done.stdout)
        longest = max((run["seconds"] for run in result["runs"] if run["method"] == "auto"), default=0)
        if 4 * longest <= limit or limit >= MOST:
            return result
        limit = min(max(6 * longest, 4 * limit), MOST)


def cold_seconds(scene, method, tolerance):
    """Process time of a run with nothing cached, the least of five. os.times() counts in hundredths of a second, which is the
    time of a whole run."""
    def of_children():
        used = resource.getrusage(resource.RUSAGE_CHILDREN)
        return used.ru_utime + used.ru_stime

    times = []
    for _ in range(5):
        shutil.rmtree(os.path.join(cache, "alembert"), ignore_errors=True)
        before = of_children()
        subprocess.run([program, "simulate", scene, "--no-estimate", "--method", method, "--tolerance", repr(tolerance),
                        *more], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        times.append(of_children() - before)
    return min(times)


def rows_of(scene, result):
    floor = max(1e-14, 10.0 ** -result["reference"]["digits"])
    runs = [run for run in result["runs"] if run["error"] is not None]
    others = [run for run in runs if run["method"] != "auto"]
    rows = []
    for run in runs:
        if run["method"] != "auto" or run["tolerance"] < 0.9 * TIGHTEST or not 0 < run["error"] < 0.1:
            continue
        reached = max(run["error"], floor)
        enough = [other for other in others if max(other["error"], floor) <= reached]
        if not enough:
            continue
        best = min(enough, key=lambda other: other["seconds"])
        row = {"scene": os.path.basename(scene)[:-5], "tolerance": run["tolerance"], "error": run["error"],
               "chosen": run["chosen"], "went_on_with": run.get("went_on_with"), "seconds": run["seconds"],
               "best": best["method"], "best_seconds": best["seconds"], "regret": run["seconds"] / best["seconds"]}
        plain = [other["seconds"] for other in enough if other["method"] != "taylor"]
        if run["tolerance"] > 0.9e-9 and plain:
            row["regret_without_series"] = run["seconds"] / min(plain)
        if wishes.cold and any(abs(run["tolerance"] / one - 1) < 1e-6 for one in COLD):
            methods = {"auto", "dop853", "verner98"}
            if best["tolerance"] is not None:
                methods.add(best["method"])
            cold = {method: cold_seconds(scene, method, run["tolerance"]) for method in sorted(methods)}
            row["cold_seconds"], row["cold_regret"] = cold["auto"], cold["auto"] / min(cold.values())
        rows.append(row)
    return rows


def summary(name, values):
    values = sorted(values)
    mean = math.exp(sum(map(math.log, values)) / len(values))
    above = sum(value > 2 for value in values)
    print(f"{name}: geometric mean {mean:.2f}, worst {values[-1]:.2f}, {above} of {len(values)} above 2")


rows, left_out = [], []
try:
    print(f"{'scene':28} {'tolerance':>9} {'error':>8} {'auto':>20} {'us':>9} {'best':>10} {'us':>9} {'regret':>7}"
          + (f" {'cold':>6}" if wishes.cold else ""))
    for scene in scenes:
        result = benched(scene)
        found = rows_of(scene, result) if result and result["reference"]["digits"] >= 9 else []
        if not found:
            left_out.append(os.path.basename(scene)[:-5])
        for row in found:
            chosen = row["chosen"] + (", " + row["went_on_with"] if row["went_on_with"] else "")
            cold = f" {row['cold_regret']:6.2f}" if "cold_regret" in row else ""
            print(f"{row['scene']:28} {row['tolerance']:9.0e} {row['error']:8.1e} {chosen:>20} {1e6 * row['seconds']:9.1f} "
                  f"{row['best']:>10} {1e6 * row['best_seconds']:9.1f} {row['regret']:7.2f}{cold}", flush=True)
        rows += found
finally:
    shutil.rmtree(cache, ignore_errors=True)
keep(rows, wishes.json)
print()
if rows:
    summary("regret", [row["regret"] for row in rows])
    plain = [row["regret_without_series"] for row in rows if "regret_without_series" in row]
    if plain:
        summary("1e-9 and above, without series", plain)
    cold = [row["cold_regret"] for row in rows if "cold_regret" in row]
    if cold:
        summary("cold", cold)
if left_out:
    print(f"left out: {len(left_out)} ({' '.join(left_out)})")
PYTHON
