#!/bin/sh
# SPDX-License-Identifier: MIT
# tests/bench/check_property.sh BUILD [COUNT]: random right and wrong claims about every textbook scene, COUNT of each (500), judged
# by `check` and by an evaluation in 60 digits. Prints for each scene how many were proved, refuted and left undecided, how many of
# these were false, and the slowest check.
set -eu
build=${1:?usage: check_property.sh BUILD [COUNT]}
ALEMBERT_CLAIMS=${2:-500} exec "$build/tests/test_generator" --no-version -tc='check: random right claims*'
