#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The hard cases against the strongest rivals, in one run: Verner's 9(8) pair inlined around right-hand sides written by hand
# (verner_peer.cpp, compiled here with c++ -O3 -march=native), heyoka where it is found, and for the stiff governor RADAU5 and RADAU
# of Hairer and Wanner with our right-hand side and Jacobian, compiled, where alembert-peers was built with them (HAIRER_PREFIX).
#
#   tests/bench/strongest.sh [--case NAME]... [--errors "1e-6 1e-9 1e-11"] [--rounds N] [--reference-seconds S] [--json FILE] [PROGRAM]
#
# For each case and each true error, it prints the time of the fastest of our methods, of `auto`, and of each rival, and the ratio
# of ours to the best rival. A time is the least of N rounds (2) in which ours and the rivals take turns, since others may use the
# processor; between two tolerances it is interpolated (both logarithms). Tolerances go from 1e-3 to 1e-14, those of rivals in steps
# of half a decade. Errors are the largest |y - reference| / max(1, |reference|) of coordinates and rates, as in `bench`.
#
# heyoka: HEYOKA_PREFIX, or HEYOKA_PYTHON (an interpreter that imports heyoka, such as that of a virtual environment after
# `pip install heyoka`), or python3. PROGRAM: build/release/generator/alembert.
set -eu
root=$(cd -- "$(dirname -- "$0")/../.." && pwd)
exec python3 -B - "$root" "$@" <<'PYTHON'
import json
import math
import os
import subprocess
import sys
import tempfile

root = sys.argv[1]
sys.path.append(os.path.join(root, "tests/bench"))
from measuring import keep, options, processor, read

parser = options("strongest.sh", root)
parser.add_argument("--case", action="append")
parser.add_argument("--errors", default="1e-6 1e-9 1e-11")
parser.add_argument("--rounds", type=int, default=2)
parser.add_argument("--reference-seconds", default="5")
parser.add_argument("--code", default="memory", choices=["memory", "compiled"])
wishes = read(parser, sys.argv[2:])
STIFF = ["flyball_governor"]
CASES = ["double_pendulum_chaotic", "kepler", "outer_solar_system", "pleiades", "andrews", *STIFF]
cases = wishes.case or CASES
for name in cases:
    if name not in CASES:
        sys.exit(f"there is no case {name}; expected {', '.join(CASES)}")
bench = os.path.join(root, "tests/bench")


def python_with_heyoka():
    prefix, candidates = os.environ.get("HEYOKA_PREFIX"), []
    if prefix:
        candidates += [os.path.join(prefix, "bin/python3"), os.path.join(prefix, "bin/python")]
    candidates += [os.environ.get("HEYOKA_PYTHON"), "python3"]
    for one in candidates:
        if one and subprocess.run([one, "-c", "import heyoka"], capture_output=True).returncode == 0:
            return one
    return None


def ours(name, *options):
    scene = os.path.join(root, "scenes/benchmark", name + ".toml")
    done = subprocess.run([wishes.program, "bench", scene, "--json", "--reference-seconds", wishes.reference_seconds,
                           "--run-seconds", "0.05", *options], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{name}: {done.stderr}")
    return json.loads(done.stdout)


def error_of(final, reference):
    return max(abs(y - x) / max(1, abs(x)) for x, y in zip(reference, final))


def of_rival(command, reference):
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)}: {done.stderr}")
    return [{"tolerance": run["tolerance"], "seconds": run["seconds"], "error": error_of(run["final"], reference)}
            for run in json.loads(done.stdout)["runs"]]


def time_to(runs, error):
    """The least time at which the error is at most this, along the runs from loose to strict; None if it is not reached."""
    best = None
    for i, run in enumerate(runs):
        if not run["error"] <= error:
            continue
        time = run["seconds"]
        before = runs[i - 1] if i > 0 else None
        if before and before["error"] > error and before["error"] < 1 and before["seconds"] < time:
            floor = max(run["error"], 1e-16)
            part = math.log(before["error"] / error) / math.log(before["error"] / floor)
            time = before["seconds"] * (time / before["seconds"]) ** part
        best = time if best is None else min(best, time)
    return best


def series_of(rounds):
    """From runs of several rounds those with the least times, by method."""
    methods = {}
    for runs in rounds:
        for run in runs:
            if run["error"] is None:
                continue
            key = (run["method"], run.get("tolerance") or 1 / run["step"])
            if key not in methods or run["seconds"] < methods[key]["seconds"]:
                methods[key] = run
    result = {}
    for (method, at), run in methods.items():
        result.setdefault(method, []).append((-at if run.get("tolerance") else at, run))
    return {method: [run for _, run in sorted(runs, key=lambda pair: pair[0])] for method, runs in result.items()}


def told(seconds):
    return f"{1e6 * seconds:9.1f}" if seconds else f"{'-':>9}"


folder = tempfile.mkdtemp()
peer = os.path.join(folder, "verner_peer")
subprocess.run([os.environ.get("CXX", "c++"), "-std=c++20", "-O3", "-march=native", "-D_GNU_SOURCE", "-I" + os.path.join(root, "lib"),
                "-I" + bench, os.path.join(bench, "verner_peer.cpp"), "-o", peer], check=True)
heyoka = python_with_heyoka()
model, flags = processor()
print(f"processor: {model} ({' '.join(flags)}); code: {wishes.code}; heyoka: {'yes' if heyoka else 'not found'}",
      flush=True)
print(f"{'case':24} {'error':>6} {'ours, us':>9} {'by':>10} {'auto, us':>9} {'verner':>9} {'heyoka':>9} {'radau5':>9} {'radau':>9} {'ours/best':>10} {'auto/best':>10}")
listed = []
for name in cases:
    own, rivals, reference = [], {}, None
    for _ in range(wishes.rounds):
        result = ours(name, "--code", wishes.code)
        final = result["reference"]["final"]
        reference = [*final["coordinates"].values(), *final["rates"].values()]
        own.append(result["runs"])
        if name in STIFF:
            for run in ours(name, "--peers", "--method", "radau5")["runs"]:
                if run["who"] == "hairer":
                    rivals.setdefault(run["method"], []).append([run])
            continue
        commands = {"verner": [peer, name, "2"]}
        if heyoka and name != "andrews":
            commands["heyoka"] = [heyoka, os.path.join(bench, "heyoka_peer.py"), name]
        for who, command in commands.items():
            runs = [dict(run, method=who) for run in of_rival(command, reference)]
            rivals.setdefault(who, []).append(runs)
    methods = series_of(own)
    others = {who: series_of(rounds)[who] for who, rounds in rivals.items()}
    for error in map(float, wishes.errors.split()):
        times = {method: time_to(runs, error) for method, runs in methods.items()}
        auto = times.pop("auto", None)
        best = min(((time, method) for method, time in times.items() if time), default=(None, "-"))
        rival = {who: time_to(runs, error) for who, runs in others.items()}
        least = min((time for time in rival.values() if time), default=None)
        ratio = lambda time: f"{time / least:10.2f}" if time and least else f"{'-':>10}"
        print(f"{name:24} {error:6.0e} {told(best[0])} {best[1]:>10} {told(auto)} {told(rival.get('verner'))} "
              f"{told(rival.get('heyoka'))} {told(rival.get('radau5'))} {told(rival.get('radau'))} {ratio(best[0])} {ratio(auto)}", flush=True)
        listed.append({"case": name, "error": error, "best": best[1], "best_seconds": best[0], "auto_seconds": auto,
                       "rivals": rival, "processor": model, "flags": flags})
keep(listed, wishes.json)
PYTHON
