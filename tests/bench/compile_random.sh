#!/bin/sh
# SPDX-License-Identifier: MIT
# tests/bench/compile_random.sh BUILD [COUNT]: emits COUNT random small scenes (5000) with all options and lets the compiler read them.
set -eu
build=${1:?usage: compile_random.sh BUILD [COUNT]}
ALEMBERT_RANDOM_SCENES=${2:-5000} exec "$build/tests/test_generator" --no-version -tc='emit: what is emitted for five hundred*'
