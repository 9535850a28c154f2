#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Random claims where something must be assumed, held against an evaluation of its own: tests/adversary/adversary.py says how.
#   tests/adversary.sh [--claims N] [--seed S] [--kinds sides,rates,...] [--jobs J] [--program FILE] [--folder DIR] [--self]
# Needs python3-mpmath and python3-numpy. The exit code is 1 where a false word is said; such scenes are kept in build/adversary.
set -eu
cd "$(dirname "$0")/.."
/usr/bin/python3 -c 'import mpmath, numpy' 2>/dev/null || {
    echo 'python3-mpmath or python3-numpy is not installed'
    exit "${ALEMBERT_NO_SKIP:-77}"
}
export OPENBLAS_NUM_THREADS=1 PYTHONHASHSEED=0
exec /usr/bin/python3 -B tests/adversary/adversary.py "$@"
