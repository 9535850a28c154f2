#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# cold_start.sh [--short] [ALEMBERT]: process time (user + system, children included) of `alembert simulate --duration 0.1
# --no-estimate` where nothing is cached: as it is, and with `--code compiled`, that with the compiled solver in the cache too.
# `equations` is the part of the first that derives and lowers, whatever code follows. The double pendulum: median of 15 runs;
# chains of 64 and 512 rods and a humanoid of 38 coordinates: of 3, and one with the compiler. --short leaves out the chains, and
# what takes the compiler more than a second. Exit status 1: a bar is missed.
set -eu

root=$(cd -- "$(dirname -- "$0")/../.." && pwd)
short=
if [ "${1:-}" = --short ]; then
    short=yes
    shift
fi
alembert=${1:-$root/build/release/generator/alembert}
folder=$(mktemp -d)
trap 'rm -rf -- "$folder"' EXIT
export XDG_CACHE_HOME=$folder/cache
mkdir "$XDG_CACHE_HOME"
unset ALEMBERT_CODE
TIMEFORMAT='%3U %3S'
missed=0

# median COUNT COMMAND...: of the process times, in seconds
median() {
    local count=$1
    shift
    for ((i = 0; i < count; i++)); do
        { time "$@" >/dev/null 2>&1; } 2>&1
    done | awk '{ print $1 + $2 }' | sort -n | awk '{ t[NR] = $1 } END { printf "%.3f", t[int((NR + 1) / 2)] }'
}

motion() { "$alembert" simulate "$scene" --duration 0.1 --no-estimate "$@"; }

compiled_cold() {
    rm -rf -- "${XDG_CACHE_HOME:?}"/*
    motion --code compiled
}

# row NAME RUNS RUNS_OF_THE_COMPILER BAR: of $scene; the bar is for what comes after the equations if it begins with +.
row() {
    local name=$1 runs=$2 compiling=$3 bar=$4 cold equations slow=- warm=-
    motion >/dev/null 2>&1 # its files are in memory from here on
    cold=$(median "$runs" motion)
    equations=$(motion --json 2>/dev/null | python3 -c '
import json, sys
seconds = json.load(sys.stdin)["seconds"]
print("%.3f" % (seconds["derive"] + seconds["emit"]))')
    if [ "$compiling" -gt 0 ]; then
        slow=$(median "$compiling" compiled_cold)
        warm=$(median "$runs" motion --code compiled)
    fi
    verdict=$(awk -v cold="$cold" -v equations="$equations" -v bar="$bar" 'BEGIN {
        print (cold - (bar ~ /^\+/ ? equations : 0) <= bar + 0) ? "holds" : "FAILS" }')
    [ "$verdict" = holds ] || missed=1
    printf '%-16s %8s %10s %10s %10s   %6s %s\n' "$name" "$cold" "$equations" "$slow" "$warm" "$bar" "$verdict"
}

printf '%-16s %8s %10s %10s %10s   %6s\n' seconds cold equations compiled cached bar
scene=$root/scenes/textbook/double_pendulum.toml
row 'double pendulum' 15 15 0.03
mkdir "$folder/robots"
python3 -B "$root/tests/bench/robots.py" "$folder/robots"
scene=$folder/humanoid.toml
if "$alembert" import "$folder/robots/humanoid32.urdf" -o "$scene" --floating >/dev/null 2>&1; then
    row humanoid 3 "$([ -n "$short" ] && echo 0 || echo 1)" 0.5
fi
if [ -z "$short" ]; then
    for rods in 64 512; do
        scene=$folder/chain$rods.toml
        python3 -B "$root/scenes/benchmark/chain.py" "$rods" >"$scene"
        row "$rods rods" 3 1 +2
    done
fi
exit "$missed"
