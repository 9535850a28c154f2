#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Random valid scenes, and one number of each by all ways out of the program: tests/cross/cross.py says what is compared.
#   tests/cross.sh [--seconds N] [--seed S] [--scenes N] [--scene FILE.json] [--program FILE]
# Needs what ./run.sh and ./test.sh install. The exit code is 1 where anything differs; such scenes are kept in build/cross.
set -eu
cd "$(dirname "$0")/.."
/usr/bin/python3 -c 'import mpmath' 2>/dev/null || { echo 'python3-mpmath is not installed'; exit "${ALEMBERT_NO_SKIP:-77}"; }
exec /usr/bin/python3 -B tests/cross/cross.py --program build/release/generator/alembert --package build/release/python "$@"
