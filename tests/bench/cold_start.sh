#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# cold_start.sh [ALEMBERT]: process time (user + system, children included) of `alembert simulate` on the double
# pendulum, with nothing cached and with the compiled solver in the cache; median of 15 runs each.
set -eu

root=$(cd -- "$(dirname -- "$0")/../.." && pwd)
alembert=${1:-$root/build/release/generator/alembert}
scene=$root/scenes/textbook/double_pendulum.toml
runs=15
cache=$(mktemp -d)
trap 'rm -rf -- "$cache"' EXIT
export XDG_CACHE_HOME=$cache
TIMEFORMAT='%3U %3S'

"$alembert" simulate "$scene" >/dev/null # the files of compiler and libraries are in memory from here on

# median COMMAND...: of the process times of $runs runs, in seconds
median() {
    for ((i = 0; i < runs; i++)); do
        { time "$@" >/dev/null; } 2>&1
    done | awk '{ print $1 + $2 }' | sort -n | awk '{ t[NR] = $1 } END { printf "%.3f", t[int((NR + 1) / 2)] }'
}

cold() {
    rm -rf -- "${cache:?}"/*
    "$alembert" simulate "$scene"
}

row() {
    printf '%-8s %8s s %8s s   %s\n' "$1" "$2" "$3" "$(awk "BEGIN { print ($2 < $3) ? \"holds\" : \"FAILS\" }")"
}

seconds_cold=$(median cold)
"$alembert" simulate "$scene" >/dev/null
seconds_warm=$(median "$alembert" simulate "$scene")
printf '%-8s %10s %10s\n' "" measured required
row cold "$seconds_cold" 0.3
row warm "$seconds_warm" 0.05
