#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# What the program writes, opened by programs that Debian 12 does not have or that are large: tables by the newest NumPy, h5py and
# pandas, units by FMPy (with the schemas of FMI), both from PyPI; derivations in LaTeX by pdflatex, where that is installed.
#   written_elsewhere.sh [PROGRAM]      default: that of run.sh
# Needs PyPI. A command of its own: no test of CTest needs it.
set -euo pipefail
cd -- "$(dirname -- "$0")/.."
program=$(realpath "${1-build/release/generator/alembert}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export PYTHONDONTWRITEBYTECODE=1
"${PYTHON-/usr/bin/python3}" -m venv "$work/venv"
"$work/venv/bin/pip" --quiet --disable-pip-version-check install numpy h5py pandas fmpy
"$work/venv/bin/python" -c 'import h5py, numpy, pandas
print(f"NumPy {numpy.__version__}, h5py {h5py.__version__} (HDF5 {h5py.version.hdf5_version}), pandas {pandas.__version__}")'
ALEMBERT_NO_SKIP=1 "$work/venv/bin/python" tests/written_files.py "$program"
"$work/venv/bin/python" tests/fmpy_units.py "$program"

command -v pdflatex >/dev/null || { echo 'there is no pdflatex here (texlive-latex-base): LaTeX was not set'; exit; }
count=0
for scene in scenes/textbook/*.toml; do
    {
        printf '%s\n' '\documentclass{article}' '\usepackage{amsmath,amssymb}' '\begin{document}\raggedright'
        "$program" derive "$scene" --steps --full --format latex 2>/dev/null
        printf '%s\n' '\end{document}'
    } >"$work/page.tex"
    (cd "$work" && pdflatex -halt-on-error -interaction=nonstopmode page.tex >said) ||
        { grep -A 5 '^!' "$work/said"; echo "$scene cannot be set by pdflatex" >&2; exit 1; }
    count=$((count + 1))
done
echo "pdflatex sets the derivations of $count scenes"
