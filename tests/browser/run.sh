#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Opens the pages of scenes in headless Chromium and looks whether they are right (check.mjs says at what).
#   run.sh PROGRAM [SCENE...]        a few scenes of all kinds where none is named
# Needs Debian's chromium, Node.js, and playwright-core from npm (`npm install` in this folder, or
# NODE_MODULES=FOLDER); without one of them it is skipped with exit code 77. SHOTS=FOLDER keeps a picture of each page.
set -u
program=$(realpath "$1")
shift
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
modules=${NODE_MODULES:-$here/node_modules}
for tool in chromium node; do
    command -v "$tool" >/dev/null || { echo "skipped: there is no $tool here"; exit 77; }
done
[ -d "$modules/playwright-core" ] || { echo "skipped: there is no playwright-core in $modules; npm install it"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export XDG_CACHE_HOME=$work/cache
if [ $# -eq 0 ]; then
    for name in double_pendulum four_bar slider_crank coupled_oscillators bouncing_ball rolling_disc rolling_disc_in_space \
        heavy_top free_body; do
        set -- "$@" "$root/scenes/textbook/$name.toml"
    done
    set -- "$@" "$root/tests/browser/hostile.toml"
fi
for scene in "$@"; do
    "$program" report "$scene" -o "$work/$(basename "$scene" .toml).html" >/dev/null 2>"$work/errors" || {
        echo "FAILED: report $scene"
        cat "$work/errors"
        exit 1
    }
done
cp "$here/check.mjs" "$work"
ln -s "$modules" "$work/node_modules"
node "$work/check.mjs" "$work" "${SHOTS:-}"
