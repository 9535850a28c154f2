#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Speed against error for the hard cases, rivals in the same run, with our code compiled by the compiler that compiles theirs:
#   tests/bench/motion.sh [--case NAME] [--json FILE] [--reference-seconds S] [--folder FOLDER] [PROGRAM]
# writes FOLDER/NAME.svg, .csv and .txt for each case and FOLDER/index.html with all of them, prints the fastest of each party to each error, and with --json a list of
# {case, method, tolerance, error, microseconds, evaluations, who}. PROGRAM: build/release/generator/alembert; alembert-peers
# (libsundials-dev, libgsl-dev, libboost-dev) stands beside it.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
only= json= seconds= folder=$root/build/motion program=$root/build/release/generator/alembert
while [ $# -gt 0 ]; do
    case $1 in
    --case) only=$2; shift 2 ;;
    --json) json=$2; shift 2 ;;
    --reference-seconds) seconds=$2; shift 2 ;;
    --folder) folder=$2; shift 2 ;;
    -*) sed -n '3,7p' "$0" >&2; exit 3 ;;
    *) program=$1; shift ;;
    esac
done
mkdir -p "$folder"
cases="double_pendulum_chaotic pleiades andrews kepler outer_solar_system flyball_governor car_axis slider_crank cartesian_pendulum bouncing_ball
four_bars_2 large/four_bars_40 large/chain_64 bricard free_body heavy_top_fast heavy_top_sleeping kapitza chaplygin_sleigh mass_ratio stiff_spring_pendulum"
results=()
for name in ${only:-$cases}; do
    scene=$root/scenes/benchmark/$name.toml
    [ -f "$scene" ] || scene=$root/scenes/benchmark/large/$name.toml
    name=${name#large/}
    [ -f "$scene" ] || { [ -z "$only" ] || { echo "no such case: $name" >&2; exit 3; }; continue; }
    # ten periods and more of the long pendulum say the same
    more=()
    [ "$name" = cartesian_pendulum ] && more=(--duration 10)
    [ -n "$seconds" ] && more+=(--reference-seconds "$seconds")
    echo "== $name"
    if "$program" bench "$scene" --peers --code compiled --json --svg "$folder/$name.svg" --csv "$folder/$name.csv" ${more[@]+"${more[@]}"} \
        > "$folder/$name.json" 2> "$folder/$name.err"; then
        results+=("$folder/$name.json")
        python3 - "$folder/$name.json" <<'PYTHON' | tee "$folder/$name.txt"
import json
import sys

result = json.load(open(sys.argv[1]))
print(f"reference: {result['reference']['digits']} digits, by {result['reference']['by']}")
print(f"{'error':>8} {'ours':>12} {'us':>10} {'best other':>22} {'us':>10} {'ratio':>7}")
for decade in range(3, 14):
    best = {}
    for run in result["runs"]:
        if run["error"] is None or run["error"] > 10.0**-decade:
            continue
        ours = run["who"] == "alembert"
        if ours not in best or run["seconds"] < best[ours]["seconds"]:
            best[ours] = run
    if not best:
        continue
    one, two = best.get(True), best.get(False)
    left = f"{one['method']:>12} {1e6 * one['seconds']:10.1f}" if one else f"{'-':>12} {'':>10}"
    right = f"{two['who'] + ' ' + two['method']:>22} {1e6 * two['seconds']:10.1f}" if two else f"{'-':>22} {'':>10}"
    ratio = f"{one['seconds'] / two['seconds']:7.2f}" if one and two else ""
    print(f"   1e-{decade:<3} {left} {right} {ratio}")
PYTHON
    else
        cat "$folder/$name.err"
    fi
done
# One page of all that the folder holds.
{
    echo '<!doctype html><meta charset="utf-8"><title>Speed against error</title><style>body{font:15px sans-serif;max-width:60em;margin:2em auto}pre{background:#f6f6f6;padding:1em}</style>'
    echo '<h1>Speed against error</h1><p>Processor time of the integration alone, the same emitted function for all. Solid: alembert; dashed: others.</p>'
    for table in "$folder"/*.txt; do
        [ -f "$table" ] || continue
        name=$(basename "$table" .txt)
        printf '<h2>%s</h2>\n<img src="%s.svg" alt="%s">\n<pre>\n' "$name" "$name" "$name"
        sed 's/&/\&amp;/g; s/</\&lt;/g' "$table"
        echo '</pre>'
    done
} > "$folder/index.html"

[ -z "$json" ] || python3 - "$json" ${results[@]+"${results[@]}"} <<'PYTHON'
import json
import os
import sys

rows = []
for path in sys.argv[2:]:
    case = os.path.splitext(os.path.basename(path))[0]
    for run in json.load(open(path))["runs"]:
        row = {"case": case, "method": run["method"], "tolerance": run["tolerance"], "error": run["error"],
               "microseconds": 1e6 * run["seconds"], "evaluations": run["evaluations"], "who": run["who"]}
        if "step" in run:
            row["step"] = run["step"]
        rows.append(row)
json.dump(rows, open(sys.argv[1], "w"), indent=1)
PYTHON
