#!/bin/sh
# SPDX-License-Identifier: MIT
# Operations of one right-hand side, and seconds of emitting and of compiling it, for floating robots that turn by
# angles, by a quaternion, and by a quaternion with Lagrange's equations and a multiplier (--by routh).
#   tests/bench/quaternions.sh [BUILD]
set -eu
here=$(dirname "$0")
alembert=${1:-build/release}/generator/alembert
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 "$here/robots.py" "$folder"
cp "$here/../robots/quadruped.urdf" "$folder"

seconds() { # runs a command; prints its processor time
    python3 - "$@" <<'PYTHON'
import resource, subprocess, sys
subprocess.run(sys.argv[1:], stdout=subprocess.DEVNULL, check=True)
used = resource.getrusage(resource.RUSAGE_CHILDREN)
print(f"{used.ru_utime + used.ru_stime:.2f}")
PYTHON
}

for robot in quadruped humanoid32; do
    floating=$(case $robot in humanoid*) echo --floating ;; esac)
    for form in angles quaternion routh; do
        turn=$(case $form in angles) ;; *) echo --quaternion ;; esac)
        by=$(case $form in routh) echo --by routh ;; esac)
        # shellcheck disable=SC2086  # empty options vanish
        "$alembert" import "$folder/$robot.urdf" -o "$folder/$robot.toml" $floating $turn >"$folder/log" 2>&1
        # shellcheck disable=SC2086
        emission=$(seconds "$alembert" emit "$folder/$robot.toml" -o "$folder/$form" $by)
        file=$folder/$form/$robot.cpp
        compilation=$(seconds "${CXX:-g++}" -std=c++20 -O2 -fPIC -shared -o "$folder/object.so" "$file")
        printf '%-11s %-10s %s; emission %s s, compilation %s s\n' "$robot" "$form" \
            "$(sed -n 's/.*[^0-9]\([0-9][0-9]* operations\).*/\1/p' "$file" | head -1)" "$emission" "$compilation"
    done
done
