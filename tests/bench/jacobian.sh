#!/bin/sh
# SPDX-License-Identifier: MIT
# Counts the operations of one right-hand side and of its Jacobian for robots of 20 to 40 joints (robots.py).
#   tests/bench/jacobian.sh [BUILD]
set -eu
here=$(dirname "$0")
alembert=${1:-build/release}/generator/alembert
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 "$here/robots.py" "$folder"
for robot in "$folder"/*.urdf; do
    name=$(basename "$robot" .urdf)
    floating=$(case "$name" in humanoid*) echo --floating ;; esac)
    "$alembert" import "$robot" -o "$folder/$name.toml" $floating >"$folder/log" 2>&1 || cat "$folder/log"
    printf '%s\n' "$name"
    "$alembert" emit "$folder/$name.toml" --jacobian -o "$folder/$name" | grep operations
done
