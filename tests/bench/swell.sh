#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# swell.sh [--far] [ALEMBERT]: chains of N rods with relative angles; process time of `alembert emit` (derive, lower and emit;
# median of 5 runs), operations of a right-hand side, and the exponent with which these grow from one row to the next.
# --far: also 64 to 512 rods, emitted once, compiled and run: seconds of both, operations, and one right-hand side in floors (n calls
# of glibc's sincos) as rhs.cpp takes them; its bench_rhs is built in the build that ALEMBERT belongs to.
set -eu -o pipefail

root=$(cd -- "$(dirname -- "$0")/../.." && pwd)
far=
if [ "${1:-}" = --far ]; then
    far=yes
    shift
fi
alembert=${1:-$root/build/release/generator/alembert}
case $alembert in -*) echo "usage: swell.sh [--far] [ALEMBERT]" >&2; exit 3 ;; esac
runs=5
folder=$(mktemp -d)
trap 'rm -rf -- "$folder"' EXIT
TIMEFORMAT='%3U %3S'

measure() {
    python3 -B "$root/scenes/benchmark/chain.py" "$1" >"$folder/chain$1.toml"
    seconds=$(for ((i = 0; i < runs; i++)); do
        { time "$alembert" emit --json "$folder/chain$1.toml" -o "$folder" >"$folder/emit.json"; } 2>&1
    done | awk '{ print $1 + $2 }' | sort -n | awk '{ t[NR] = $1 } END { printf "%.3f", t[int((NR + 1) / 2)] }')
    # The first: that of what is emitted, not of its rivals.
    operations=$(sed -n 's/^ *"operations": \([0-9]*\).*/\1/p' "$folder/emit.json" | head -n 1)
    formulation=$(sed -n 's/^ *"formulation": "\(.*\)".*/\1/p' "$folder/emit.json" | head -n 1)
    [ -n "$operations" ] || { echo "swell.sh: '$alembert emit' said no count of operations for $1 rods" >&2; return 4; }
    echo "$1 $seconds $operations $formulation"
}

rows=$(for n in 2 4 8 16 32; do measure "$n" || exit; done)
awk '
    BEGIN { printf "%4s %10s %12s %9s   %s\n", "N", "seconds", "operations", "exponent", "formulation" }
    {
        exponent = NR > 1 ? sprintf("%.2f", log($3 / before) / log($1 / n)) : ""
        before = $3; n = $1
        x = log($1); y = log($3); k += 1; sx += x; sy += y; sxx += x * x; sxy += x * y
        at[$1] = $2
        formulation = $0; sub(/^[^ ]+ [^ ]+ [^ ]+ /, "", formulation)
        printf "%4d %10.3f %12d %9s   %s\n", $1, $2, $3, exponent, formulation
    }
    END {
        printf "\noperations grow as N^%.2f (least squares over all rows)\n", (k * sxy - sx * sy) / (k * sxx - sx * sx)
        printf "required: N = 8 in under 0.05 s (%s), N = 32 in under 2 s (%s)\n",
            at[8] < 0.05 ? "holds" : "FAILS", at[32] < 2 ? "holds" : "FAILS"
    }' <<<"$rows"

[ -n "$far" ] || exit 0
build=$(cd -- "$(dirname -- "$alembert")/.." && pwd)
log=$(cmake --build "$build" --target bench_rhs 2>&1) || { printf '%s\n' "$log" >&2; exit 5; }
export XDG_CACHE_HOME=$folder/cache
runs=1
printf '\n%4s %10s %10s %12s %10s %8s   %s\n' N "emit s" "compile s" operations "rhs ns" floors formulation
for n in 64 128 256 512; do
    row=$(measure "$n")
    "$build/tests/bench_rhs" --json "$folder/row.json" "$root/tests" "$folder/emit.json" "$folder/chain$n.cpp" >/dev/null
    python3 -B - "$folder/row.json" "$row" <<'PRINT'
import json, sys
row = json.load(open(sys.argv[1]))[0]
n, seconds, operations, formulation = sys.argv[2].split(" ", 3)
print(f'{n:>4} {seconds:>10} {row["compile_s"]:>10.2f} {operations:>12} {row["ours_ns"]:>10.0f} {row["ours_ns"] / row["floor_ns"]:>8.2f}   {formulation}')
PRINT
done
