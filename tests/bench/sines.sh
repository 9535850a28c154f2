#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# sines.sh [--points N] [BUILD]: the worst error of emitted sines and cosines against 50-digit values, in ulp, at N angles (10⁷, which
# takes a minute or two) of all kinds up to 1e8, with zeros, denormals, infinities, NaN, and libm's part beyond: of one angle, of
# groups of 2, 3, 5 and 8 (each takes another way), each a state at a time and in packs of eight, for this processor and for any.
# Exit status 1: more than 2.5 ulp somewhere, or beyond 1e8 other bits than libm's. BUILD is the folder of the build (build/release).
# All values are CLN's to 50 digits and more (some 6 µs an angle), on all processors. sines.cpp says how; angles.hpp which angles.
set -eu

root=$(cd -- "$(dirname -- "$0")/../.." && pwd)
build=$root/build/release
points=10000000
while [ $# -gt 0 ]; do
    case $1 in
        --points)
            [[ ${2:-} =~ ^[1-9][0-9]{0,12}$ ]] || { echo "--points needs a whole number, at least 1" >&2; exit 3; }
            points=$2
            shift ;;
        -*) echo "usage: sines.sh [--points N] [BUILD]" >&2; exit 3 ;;
        *) build=$1 ;;
    esac
    shift
done
log=$(cmake --build "$build" --target alembert bench_sines 2>&1) || { printf '%s\n' "$log" >&2; exit 5; }
folder=$(mktemp -d)
trap 'rm -rf -- "$folder"' EXIT
export XDG_CACHE_HOME=$folder/cache

sources=()
for n in 1 2 3 5 8; do
    scene=$folder/sines$n.toml
    {
        echo '[coordinates]'
        for ((i = 1; i <= n; i++)); do echo "q$i = {}"; done
        for ((i = 1; i <= n; i++)); do printf '[[particle]]\nname = "p%d"\nmass = 1\nposition = ["q%d", 0, 0]\n' "$i" "$i"; done
        echo '[outputs]'
        for ((i = 1; i <= n; i++)); do printf 's%d = "sin(q%d)"\nc%d = "cos(q%d)"\n' "$i" "$i" "$i" "$i"; done
    } >"$scene"
    "$build/generator/alembert" emit --batch "$scene" -o "$folder" >/dev/null 2>&1
    sources+=("$folder/sines$n.cpp")
done
"$build/tests/bench_sines" "$points" "${sources[@]}"
