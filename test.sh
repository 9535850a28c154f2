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
# The form of C++ files; other compilers, that for WebAssembly too; pages in a browser; what opens the files that are written; workflows;
# what others compute, in C++ and in Python; the manual's form; the shells that complete words; emitted code of MATLAB and Rust;
# notebooks.
wanted="$wanted clang-format-14 clang gcc-arm-none-eabi libnewlib-dev emscripten chromium chromium-driver fonts-dejavu-core
    python3-h5py hdf5-tools librsvg2-bin python3-yaml liborocos-kdl-dev libmujoco-dev python3-scipy python3-mpmath python3-venv python3-setuptools python3-wheel mandoc zsh fish octave rustc
    python3-nbclient python3-ipykernel"
set_up "$preset" all
[ "$is_complete" = no ] || export ALEMBERT_NO_SKIP=1 # all tools are there: a test that misses one fails

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
