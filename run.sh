#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# ./run.sh SCENE: builds alembert, then derives, emits and simulates the scene, and makes its page. The exit code is alembert's (5: the setup failed).
set -eu

if [ $# -ne 1 ]; then
    echo "usage: ./run.sh SCENE, as in ./run.sh scenes/textbook/double_pendulum.toml" >&2
    exit 3
fi
case $1 in
    -*) scene=./$1 ;;
    *) scene=$1 ;;
esac
if [ ! -f "$scene" ]; then
    printf '%s: no such file\n' "$scene" >&2
    exit 3
fi

root=$(cd -- "$(dirname -- "$0")" && pwd)
(
    cd -- "$root"
    # shellcheck source=.ci/setup.sh
    . .ci/setup.sh
    set_up release product
)

alembert=$root/build/release/generator/alembert
name=$(basename -- "$scene" .toml)
folder=$root/build/solvers/$name
mkdir -p -- "$folder" || exit 5

printf '\n%s\n\n' "Equations of motion"
"$alembert" derive "$scene"
printf '\n%s\n\n' "Files written"
"$alembert" emit "$scene" -o "$folder"
printf '\n%s\n\n' "Motion"
code=0
"$alembert" simulate "$scene" -o "$folder/$name.csv" || code=$?  # the page shows what went wrong
printf '\n%s\n\n' "Page (open it in a browser)"
"$alembert" report "$scene" -o "$folder/$name.html" || code=$?
exit "$code"
