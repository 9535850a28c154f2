#!/usr/bin/env bash
# Installs the build into a temporary folder and builds and runs the stranger's project against it.
#   run.sh BUILD_DIRECTORY COMPILER [FLAGS]     flags: those that the build itself needs (sanitizers)
set -eu
build=$1
compiler=$2
flags=${3:-}
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cmake --install "$build" --prefix "$work/prefix" >"$work/log"
cmake -G Ninja -S "$here" -B "$work/build" -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_CXX_FLAGS="$flags" >>"$work/log" 2>&1 ||
    { tail -n 30 "$work/log"; exit 1; }
cmake --build "$work/build" >>"$work/log" 2>&1 || { tail -n 30 "$work/log"; exit 1; }
period=$(XDG_CACHE_HOME="$work/cache" "$work/build/stranger")
# 4 K(sin²(1/2)), the pendulum's period at an amplitude of 1 rad
[ "$period" = 6.6999756644 ] || { echo "period $period, expected 6.6999756644"; exit 1; }
"$work/prefix/bin/alembert" --version
