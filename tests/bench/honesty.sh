#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Is the error that `simulate` tells at least the true one? Runs honesty.py, which says what it counts.
#
#   tests/bench/honesty.sh [--scenes GLOB] [--methods LIST] [--tolerances LIST] [--duration SECONDS] [--csv FILE] [BUILD]
#
# BUILD: the folder of the build (build/release), as the last argument. All scenes and methods take an hour or two.
set -eu
here=$(cd -- "$(dirname -- "$0")" && pwd)
build=$here/../../build/release
if [ $# -gt 0 ] && [ -d "${!#}" ]; then
    build=${!#}
    set -- "${@:1:$#-1}"
fi
exec python3 "$here/honesty.py" "$build/generator/alembert" "$@"
