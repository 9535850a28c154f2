#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The wheel of python/wheel.sh in a clean virtual environment: import, derive, check, simulate by code in memory, with
# no library of this machine but those of C and C++; all tests of the package with NumPy 1 and with NumPy 2; then in a
# bare Debian, where debootstrap can make one.
#   wheel.sh
# Needs PyPI (auditwheel, NumPy, SciPy, SymPy). A command of its own: no test of CTest needs it.
set -euo pipefail
cd -- "$(dirname -- "$0")/.."
root=$PWD
python/wheel.sh
wheel=$(echo "$root"/build/wheel/alembert-*.whl)
work=$(mktemp -d)
trap 'umount "$work/system/proc" 2>/dev/null || true; rm -rf --one-file-system "$work"' EXIT
cp scenes/textbook/double_pendulum.toml "$work/scene.toml"
cat >"$work/use.py" <<'EOF'
import pathlib, re
import alembert
scene = alembert.Scene(str(pathlib.Path(__file__).with_name("scene.toml")))
equations = scene.derive().json["equations"]
assert len(equations) == 2 and "theta1''" in equations[0]["text"], equations
assert scene.check(equations[0]["text"]).verdicts == ["proved"]
run = scene.simulate(duration=1)
assert run.json["code"] == "memory", run.json["code"]
again = scene.simulate(duration=1, method="verner98", tolerance=1e-12)
assert abs(run["theta1"][-1] - again["theta1"][-1]) < 1e-8
others = {path for path in re.findall(r"(/\S+\.so\S*)", open("/proc/self/maps").read())
          if re.search("ginac|cln|gmp|fmt|urdfdom|sundials", path) and "alembert" not in path}
assert not others, others
print(alembert.__version__, run["theta1"][-1])
EOF
python=${PYTHON-/usr/bin/python3}
"$python" -m venv "$work/venv"
"$work/venv/bin/pip" --quiet --disable-pip-version-check install "$wheel"
(cd "$work" && venv/bin/python use.py)
echo 'the wheel works in a clean virtual environment'

# Every function, with the arrays of both. The program that the tests compare with is that of run.sh.
program=$root/build/release/generator/alembert
for numpy in 'numpy<2' 'numpy>=2'; do
    "$python" -m venv --clear "$work/of_numpy"
    "$work/of_numpy/bin/pip" --quiet --disable-pip-version-check install "$numpy" scipy sympy "$wheel"
    version=$("$work/of_numpy/bin/python" -c 'import numpy; print(numpy.__version__)')
    if [ -x "$program" ]; then
        env -u ALEMBERT_NO_SKIP "$work/of_numpy/bin/python" -W error::DeprecationWarning:alembert tests/python_package.py "$program" >"$work/log" 2>&1 ||
            { tail -n 40 "$work/log"; exit 1; }
        echo "all tests of the package pass with NumPy $version"
    else
        (cd tests && "$work/of_numpy/bin/python" -c 'import sys; sys.argv = ["", "none"]
import unittest, python_arrays; unittest.main(python_arrays, argv=["wheel"])') >"$work/log" 2>&1 ||
            { tail -n 40 "$work/log"; exit 1; }
        echo "arrays of every kind are right with NumPy $version; for all tests of the package build the program first (./run.sh)"
    fi
done

# Without anything of the sort installed.
mirror=$(apt-get indextargets --format '$(REPO_URI) $(RELEASE)' 'Created-By: Packages' 2>/dev/null | awk '$2 == "bookworm" { print $1; exit }')
if [ "$(id -u)" -ne 0 ] || [ -z "$mirror" ] || ! command -v debootstrap >/dev/null; then
    echo 'no bare Debian can be made here'
    exit
fi
debootstrap --variant=minbase --include=python3-venv,ca-certificates bookworm "$work/system" "$mirror" >"$work/log" 2>&1 ||
    { tail -n 5 "$work/log"; exit 77; }
cp -L /etc/resolv.conf /etc/hosts "$work/system/etc"
cp "$wheel" "$work/use.py" "$work/scene.toml" "$work/system/root"
"$work/venv/bin/pip" --quiet --disable-pip-version-check download --dest "$work/system/root" numpy
mount -t proc proc "$work/system/proc"
chroot "$work/system" env -i HOME=/root PATH=/usr/bin:/bin LANG=C.UTF-8 bash -ec \
    'cd /root && python3 -m venv v && v/bin/pip --quiet install --no-index --find-links . alembert && v/bin/python use.py'
echo 'the wheel works in a bare Debian with its Python'
