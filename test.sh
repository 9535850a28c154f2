#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# ./test.sh [--sanitize] [PART...]: builds everything and runs every test, or only the parts that are named (names of
# CTest: runtime, scene, generator, commands, ...); with the address, undefined-behaviour and leak sanitizers if asked.
set -eu

preset=release
if [ "${1-}" = --sanitize ]; then
    preset=sanitize
    shift
fi
for part in "$@"; do
    if ! [[ $part =~ ^[a-z_]+$ ]]; then
        echo "usage: ./test.sh [--sanitize] [PART...]" >&2
        exit 3
    fi
done

cd -- "$(dirname -- "$0")"
# shellcheck source=.ci/setup.sh
. .ci/setup.sh
packages="$packages clang-format-14"
set_up "$preset"

parts=.
if [ $# -gt 0 ]; then
    parts="^($(IFS='|' && echo "$*"))\$"
fi
if ctest --preset "$preset" --output-on-failure --no-tests=error -j "$(nproc)" -R "$parts"; then
    echo "${*:-all} tests pass ($preset)"
else
    echo "tests failed ($preset)" >&2
    exit 1
fi
