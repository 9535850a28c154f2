#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# ./test.sh [--sanitize]: builds everything and runs every test; with the address, undefined-behaviour and leak sanitizers if asked.
set -eu

preset=release
case ${1-} in
    '') ;;
    --sanitize) preset=sanitize ;;
    *)
        echo "usage: ./test.sh [--sanitize]" >&2
        exit 3
        ;;
esac

cd -- "$(dirname -- "$0")"
# shellcheck source=.ci/setup.sh
. .ci/setup.sh
packages="$packages clang-format-14"
set_up "$preset"

if ctest --preset "$preset" --output-on-failure -j "$(nproc)"; then
    echo "all tests pass ($preset)"
else
    echo "tests failed ($preset)" >&2
    exit 1
fi
