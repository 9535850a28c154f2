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
# Falls 5 m in 1 s, comes back at half the speed 1 s later.
expected='m \ddot{y} + m g = \lambda_{\mathrm{floor}}
impact at 1.000000000
impact at 2.000000000
the estimated error is below 1e-8'
printed=$(XDG_CACHE_HOME="$work/cache" "$work/build/stranger")
[ "$printed" = "$expected" ] || { printf 'printed:\n%s\nexpected:\n%s\n' "$printed" "$expected"; exit 1; }
"$work/prefix/bin/alembert" --version
