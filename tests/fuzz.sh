#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Feeds the readers and whole commands with mutated input (libFuzzer) under the address and undefined-behaviour
# sanitizers. It needs Debian's clang.
#   fuzz.sh [--seconds N] [scene|expression|claims|urdf|commands ...]     all of them, 60 seconds each
# The first inputs are the scenes, robots and broken scenes of the repository. What is found on the way to new code
# is kept in build/fuzz/corpus for the next run; an input that breaks something is kept in build/fuzz/found, and the
# program of its name in build/fuzz/tests repeats it: build/fuzz/tests/fuzz_scene build/fuzz/found/scene-crash-...
# Exit code: 0 nothing was found, 1 something was, 5 it could not be built.
set -eu
cd "$(dirname "$0")/.."
seconds=60
if [ "${1-}" = --seconds ]; then
    seconds=${2-}
    shift 2
fi
all=(scene expression claims urdf commands)
[ $# -gt 0 ] || set -- "${all[@]}"
for input in "$@"; do
    if ! [[ $seconds =~ ^[1-9][0-9]*$ && " ${all[*]} " == *" $input "* ]]; then
        sed -n '5s/^#   /usage: /p' "$0" >&2
        exit 3
    fi
done
command -v clang++ >/dev/null || { echo "clang++ is not installed: apt-get install clang" >&2; exit 5; }
cmake --preset fuzz >/dev/null && cmake --build --preset fuzz --target "${@/#/fuzz_}" || exit 5

corpus=build/fuzz/corpus
mkdir -p $corpus/{scene,expression,claims,urdf,commands} build/fuzz/found
put() { # TARGET FILE...: under names that tell the folders, since scenes of two may have one name
    local target=$1 file
    shift
    for file in "$@"; do cp "$file" "$corpus/$target/${file//\//_}"; done
}
put scene scenes/*/*.toml tests/broken/*.toml tests/odd/*.toml
put commands scenes/*/*.toml
put urdf tests/robots/*.urdf
# Each text between quotes is an input for expressions; ten claims together are one for claims.
grep -hoE '"[^"]+"' scenes/*/*.toml | tr -d '"' | sort -u | split -l 1 -a 4 - $corpus/expression/seed-
grep -hoE '^equation = "[^"]+"' scenes/*/*.toml | sed 's/^equation = "//; s/"$//' | split -l 10 - $corpus/claims/seed-

# A sum of many terms may take long to expand, which is no finding; -fork goes on after such an input.
export ASAN_OPTIONS=detect_leaks=0
failed=0
for input in "$@"; do
    folder=build/fuzz/found/$input-
    before=$(find build/fuzz/found -name "$input-crash-*" | wc -l)
    build/fuzz/tests/fuzz_"$input" -fork="$(nproc)" -ignore_timeouts=1 -ignore_ooms=1 -timeout=20 -rss_limit_mb=4000 \
        -max_len=20000 -max_total_time="$seconds" -close_fd_mask=1 -artifact_prefix="$folder" $corpus/"$input" \
        >build/fuzz/"$input".log 2>&1 || true
    after=$(find build/fuzz/found -name "$input-crash-*" | wc -l)
    runs=$(grep -oE '^#[0-9]+' build/fuzz/"$input".log | tail -n 1)
    if [ "$after" -gt "$before" ]; then
        failed=1
        echo "$input: FAILED, see build/fuzz/$input.log and ${folder}crash-*"
    elif [ -z "$runs" ]; then
        failed=1
        echo "$input: FAILED to run, see build/fuzz/$input.log"
    else
        echo "$input: ${runs#\#} inputs, nothing found"
    fi
done
exit $failed
