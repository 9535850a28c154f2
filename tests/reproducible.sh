#!/usr/bin/env bash
# The committed output of every textbook scene is what the program writes, to the byte, for each third scene in 3 fresh processes (before
# there was an order, 200 wrote 185 different texts, so one differs soon): generated/NAME.cpp from `emit`, tests/golden/NAME.txt from `derive --steps`.
#   reproducible.sh PROGRAM [--update]      --update rewrites what is committed
set -eu
program=$1
update=${2:-}
root=$(cd "$(dirname "$0")/.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
processes=1
failed=0
scenes=0

for scene in "$root"/scenes/textbook/*.toml; do
    name=$(basename "$scene" .toml)
    scenes=$((scenes + 1))
    if [ "$update" = --update ]; then
        "$program" emit "$scene" -o "$root/generated" >"$work/log"
        "$program" derive "$scene" --steps >"$root/tests/golden/$name.txt"
        continue
    fi
    processes=1
    [ $((scenes % 3)) -ne 0 ] || processes=3
    for k in $(seq "$processes"); do
        "$program" emit "$scene" -o "$work" >"$work/log"
        "$program" derive "$scene" --steps >"$work/$name.txt"
        if ! cmp -s "$work/$name.cpp" "$root/generated/$name.cpp" || ! cmp -s "$work/$name.txt" "$root/tests/golden/$name.txt"; then
            echo "$name: process $k of $processes wrote something else than is committed:"
            diff "$root/generated/$name.cpp" "$work/$name.cpp" | head -n 20 || true
            diff "$root/tests/golden/$name.txt" "$work/$name.txt" | head -n 20 || true
            failed=1
            break
        fi
    done
done
for file in "$root"/generated/*.cpp; do
    [ -f "$root/scenes/textbook/$(basename "$file" .cpp).toml" ] || { echo "$file: no scene makes this file"; failed=1; }
done
[ "$failed" = 0 ] && echo "$scenes scenes, each third in three processes: the same bytes"
exit "$failed"
