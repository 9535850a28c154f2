#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# memory_code.sh [--build BUILD] [SCENE...]: machine code in memory beside the compiler's, one right-hand side (memory_code.cpp says
# how). Without scenes: the double pendulum, scenes/benchmark/trees/ and some hard cases. BUILD is the folder of the build
# (build/release).
set -eu

root=$(cd -- "$(dirname -- "$0")/../.." && pwd)
build=$root/build/release
if [ "${1:-}" = --build ]; then
    build=$2
    shift 2
fi
if [ $# -eq 0 ]; then
    set -- "$root/scenes/textbook/double_pendulum.toml" "$root"/scenes/benchmark/trees/*.toml \
        "$root"/scenes/benchmark/{andrews,bricard,car_axis,flyball_governor,heavy_top_fast,outer_solar_system,pleiades}.toml
fi
log=$(cmake --build "$build" --target bench_memory_code 2>&1) || { printf '%s\n' "$log" >&2; exit 5; }
folder=$(mktemp -d)
trap 'rm -rf -- "$folder"' EXIT
XDG_CACHE_HOME=$folder "$build/tests/bench_memory_code" "$@"
