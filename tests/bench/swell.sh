#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# swell.sh [ALEMBERT]: chains of N rods with relative angles; process time of `alembert emit` (derive, lower and emit;
# median of 5 runs), operations of a right-hand side, and the exponent with which these grow from one row to the next.
set -eu -o pipefail

root=$(cd -- "$(dirname -- "$0")/../.." && pwd)
alembert=${1:-$root/build/release/generator/alembert}
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
