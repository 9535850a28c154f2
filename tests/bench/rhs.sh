#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# rhs.sh [--alone] [--json FILE] [BUILD]: the time of one emitted right-hand side, in floors (n calls of glibc's sincos), for chains
# of 2 to 32 rods with joint torques, the double pendulum and the four-bar; BUILD is the folder of the build (build/release).
# --json writes a list of {system, floor_ns, ours_ns, ours_pack_ns, formulation, operations, error, compile_s, rivals}.
# --alone leaves rivals out; none is built yet. rhs.cpp says how time is taken.
set -eu

root=$(cd -- "$(dirname -- "$0")/../.." && pwd)
build=$root/build/release
json=()
while [ $# -gt 0 ]; do
    case $1 in
        --alone) ;;
        --json) json=(--json "$2"); shift ;;
        -*) echo "usage: rhs.sh [--alone] [--json FILE] [BUILD]" >&2; exit 3 ;;
        *) build=$1 ;;
    esac
    shift
done
cmake --build "$build" --target alembert bench_rhs >/dev/null
alembert=$build/generator/alembert
folder=$(mktemp -d)
trap 'rm -rf -- "$folder"' EXIT
export XDG_CACHE_HOME=$folder/cache

systems=()
add() { # SCENE
    local name
    name=$(basename "$1" .toml)
    "$alembert" emit --batch --json "$1" -o "$folder" >"$folder/$name.json"
    systems+=("$folder/$name.json" "$folder/$name.cpp")
}
for n in 2 4 8 16 32; do
    python3 -B "$root/scenes/benchmark/chain.py" "$n" --torques >"$folder/pend$n.toml"
    add "$folder/pend$n.toml"
done
for arm in arm7 arm7g; do add "$root/scenes/benchmark/trees/$arm.toml"; done
add "$root/scenes/textbook/double_pendulum.toml"
add "$root/scenes/textbook/four_bar.toml"
"$build/tests/bench_rhs" "${json[@]}" "$root/tests/reference/chains.json" "${systems[@]}"
