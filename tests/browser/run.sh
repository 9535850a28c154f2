#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Opens the pages of scenes in headless Chromium and looks whether they are right (check.py says at what), and drives the sliders
# and bodies of some (live.py). Before that, a page with faults must be found wrong in each of the ways that it announces.
#   run.sh PROGRAM [SCENE...]        a few scenes of all kinds where none is named
#   run.sh PROGRAM --all             every scene of the repository, with a short motion
# Needs Debian's chromium and chromium-driver, and Python; skipped with exit code 77 where one is missing, which is a
# failure where test.sh has installed them. SHOTS=FOLDER keeps a picture of each page.
set -u
program=$(realpath "$1")
shift
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
for tool in chromium chromedriver python3; do
    command -v "$tool" >/dev/null || { echo "there is no $tool here"; exit "${ALEMBERT_NO_SKIP:-77}"; }
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export XDG_CACHE_HOME=$work/cache PYTHONDONTWRITEBYTECODE=1
mkdir "$work/faulty" "$work/pages"
cp "$here/faulty.html" "$work/faulty"
python3 "$here/check.py" "$work/faulty" >"$work/found" && { echo 'FAILED: a page with faults is found right'; exit 1; }
sed -n 's/^ *expect: //p' "$here/faulty.html" | while IFS= read -r fault; do
    grep -qF "$fault" "$work/found" || { echo "FAILED: not found in faulty.html: $fault"; cat "$work/found"; exit 1; }
done || exit 1
named=1
short=()
if [ "${1-}" = --all ]; then
    set -- "$root"/scenes/*/*.toml "$root"/scenes/benchmark/*/*.toml
    short=(--duration 0.05 --budget 100000)
elif [ $# -eq 0 ]; then
    named=0
    for name in double_pendulum four_bar slider_crank coupled_oscillators bouncing_ball rolling_disc rolling_disc_in_space \
        heavy_top free_body; do
        set -- "$@" "$root/scenes/textbook/$name.toml"
    done
    set -- "$@" "$root/tests/browser/hostile.toml" "$root/scenes/benchmark/trees/pend32.toml" \
        "$root/scenes/benchmark/andrews.toml"
fi
for scene in "$@"; do
    page=$(basename "$(dirname "$scene")")-$(basename "$scene" .toml)
    "$program" report "$scene" "${short[@]}" -o "$work/pages/$page.html" >/dev/null 2>"$work/errors" || {
        echo "FAILED: report $scene"
        cat "$work/errors"
        exit 1
    }
done
python3 "$here/check.py" "$work/pages" "${SHOTS:-}" || exit 1
[ $named = 1 ] || python3 "$here/live.py" "$program" "$root/scenes" "${SHOTS:-}"
