#!/bin/sh
# SPDX-License-Identifier: MIT
# Nanoseconds of one lookup in a table ([tables] of a scene), ours and GSL's, for linear, cubic and monotone tables of 10 to
# 100 000 points, on even and uneven grids, with arguments in order and at random. lookup.cpp says how.
#   tests/bench/lookup.sh
# Needs g++ and GSL's headers (Debian: libgsl-dev); exit code 77 where they are missing.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
echo '#include <gsl/gsl_spline.h>' | c++ -E -x c++ - >/dev/null 2>&1 || {
    echo 'The headers of GSL are missing (Debian: libgsl-dev).' >&2
    exit 77
}
# Compiled as the library is.
c++ -std=c++20 -O3 -DNDEBUG -fPIC -I"$here/../../lib" "$here/lookup.cpp" "$here/../../lib/alembert/base/tabulated_function.cpp" \
    "$here/../../lib/alembert/base/interval.cpp" -lgsl -lgslcblas -lm -o "$folder/lookup"
sed -n 's/^model name[[:space:]]*: //p' /proc/cpuinfo | head -n 1
"$folder/lookup"
