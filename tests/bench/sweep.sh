#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# sweep.sh [--build BUILD] [--duration S] [SCENE...]: motions eight side by side, by dop853, verner98 and taylor (sweep.cpp says what is
# printed). Without scenes: the double pendulum, Pleiades and scenes/benchmark/trees/. BUILD is the folder of the build (build/release).
set -eu

root=$(cd -- "$(dirname -- "$0")/../.." && pwd)
build=$root/build/release
duration=10
while [ $# -gt 0 ]; do
    case $1 in
        --build) build=$2 ;;
        --duration) duration=$2 ;;
        *) break ;;
    esac
    shift 2
done
if [ $# -eq 0 ]; then
    set -- "$root"/scenes/benchmark/{double_pendulum_regular,pleiades,outer_solar_system,heavy_top_fast}.toml \
        "$root"/scenes/benchmark/trees/{pend8,pend16,pend32,arm7,arm7g}.toml
fi
log=$(cmake --build "$build" --target bench_sweep 2>&1) || { printf '%s\n' "$log" >&2; exit 5; }
"$build/tests/bench_sweep" --duration "$duration" "$@"
