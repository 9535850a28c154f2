#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Makes the pages of scenes, with a short motion: each is made, smaller than 2 MB, and a whole HTML file.
#   pages.sh PROGRAM              the scenes with the largest pages of their kind (seconds)
#   pages.sh PROGRAM --all        every scene of the repository (a minute or two); prints size and processor time of each
set -u
program=$(realpath "$1")
root=$(cd "$(dirname "$0")/.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export XDG_CACHE_HOME=$work/cache
if [ "${2-}" = --all ]; then
    set -- "$root"/scenes/*/*.toml "$root"/scenes/benchmark/*/*.toml
else
    set -- "$root"/scenes/benchmark/trees/pend32.toml "$root"/scenes/benchmark/large/four_bars_10.toml \
        "$root"/scenes/benchmark/pleiades.toml "$root"/scenes/gallery/rssr.toml
fi
failed=0
for scene in "$@"; do
    page=$work/page.html
    rm -f "$page"
    seconds=$( { TIMEFORMAT=%U; time "$program" report "$scene" --duration 0.05 --budget 100000 -o "$page" \
        >/dev/null 2>"$work/errors"; } 2>&1)
    size=$(stat -c %s "$page" 2>/dev/null || echo 0)
    printf '%8d bytes %8s s  %s\n' "$size" "$seconds" "${scene#"$root"/}"
    if [ "$size" -ge 2000000 ] || [ "$size" -eq 0 ] || ! tail -n 1 "$page" | grep -qxF '</html>'; then
        echo "FAILED: no page, or more than 2 MB"
        cat "$work/errors"
        failed=1
    fi
done
exit "$failed"
