#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# What steps take on this processor, beside what is predicted from counts (cost_model.hpp, taylor.hpp).
#
#   tests/bench/step_costs.sh [--build BUILD] [--rows] [SCENE...]
#
# For evaluations with their part of a step (dop853 and verner98) and for power series with their steps (taylor), it prints the
# median of measured over predicted time, which is the slowness of this processor (cost_model.hpp), and by how much the times
# differ from the predictions after that (root mean square). --rows prints every scene too. Without scenes: all of
# scenes/benchmark, textbook, stability and gallery. BUILD is the folder of the build (build/release).
set -eu
root=$(cd -- "$(dirname -- "$0")/../.." && pwd)
build=$root/build/release
rows=
while [ $# -gt 0 ]; do
    case $1 in
        --build) build=$2 && shift 2 ;;
        --rows) rows=1 && shift ;;
        *) break ;;
    esac
done
if [ $# -eq 0 ]; then
    set -- "$root"/scenes/benchmark/*.toml "$root"/scenes/benchmark/trees/*.toml "$root"/scenes/textbook/*.toml \
        "$root"/scenes/stability/*.toml "$root"/scenes/gallery/*.toml
fi
log=$(cmake --build "$build" --target bench_step_costs 2>&1) || { printf '%s\n' "$log" >&2; exit 5; }
"$build/tests/bench_step_costs" "$@" 2>/dev/null | python3 -c '
import json, statistics, sys
ratios = {"evaluation": [], "series": []}
for line in sys.stdin:
    scene = json.loads(line)
    steps = [scene[method] for method in ("dop853", "verner98") if method in scene]
    found = {"evaluation": [one["ns"] / one["predicted"] for one in steps],
             "series": [one["ns"] / one["predicted"] for one in scene["taylor"]]}
    for kind, values in found.items():
        ratios[kind] += values
    if len(sys.argv) > 1:
        print(scene["scene"], *(f"{kind} " + " ".join(f"{value:.2f}" for value in values) for kind, values in found.items()))
for kind, values in ratios.items():
    if values:
        middle = statistics.median(values)
        off = statistics.fmean((value / middle - 1) ** 2 for value in values) ** 0.5
        print(f"{kind}: {middle:.2f} times the prediction, from which {len(values)} times differ by {100 * off:.0f} %")
' $rows
