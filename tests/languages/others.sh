#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Emitted Python in JAX and emitted Modelica in two of its tools, all from PyPI: each function of several scenes under jit gives what
# NumPy gives, the text is one that pymoca parses, and the motion that rumoca computes ends where 'alembert simulate' ends.
#   others.sh [PROGRAM]      the program alembert; default: that of build/release
# Needs PyPI and 600 MB for a minute. Exit code: 0 all agree, 1 some do not, 77 PyPI does not give the packages.
set -euo pipefail
root=$(cd -- "$(dirname -- "$0")/../.." && pwd)
program=${1:-$root/build/release/generator/alembert}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
python=$work/venv/bin/python
if ! "$work/venv/bin/pip" -q install jax pymoca rumoca >"$work/log" 2>&1; then
    tail -n 5 "$work/log" >&2
    exit 77
fi
"$python" "$root/tests/languages/others.py" "$program" "$work" "$root"/scenes/textbook/{double_pendulum,four_bar,sled,heavy_top,two_body}.toml \
    "$root"/scenes/textbook/{elastic_pendulum,free_body_quaternion,rolling_disc_in_space}.toml \
    "$root"/scenes/elements/{cam,drag_table}.toml
