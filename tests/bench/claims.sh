#!/bin/sh
# SPDX-License-Identifier: MIT
# tests/bench/claims.sh BUILD [COUNT]: COUNT random claims (10800), a half of them right and a half wrong, shared out over the textbook
# scenes and over scenes whose constraints have several branches, judged by `check` and by an evaluation in 60 digits. Prints for each scene how many were proved, refuted and left undecided,
# how many of these were false, and the seconds. Then every equation that any formalism prints of any of these scenes is held
# against `check`. The exit code is 0 if no verdict was false and nothing that is printed was left unproved.
set -eu
build=${1:?usage: claims.sh BUILD [COUNT]}
count=${2:-10800}
scenes=$(ls "$(dirname "$0")"/../../scenes/textbook/*.toml | wc -l)
ALEMBERT_ALL_SCENES=1 ALEMBERT_CLAIMS=$(((count + 2 * scenes - 1) / (2 * scenes))) exec "$build/tests/test_generator" --no-version \
    -tc='check: random right claims*,check: random claims on*,check: the equations that each formalism prints*'
