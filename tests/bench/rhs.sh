#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# rhs.sh [--alone] [--json FILE] [--svg FILE] [BUILD]: the time of one emitted right-hand side, in floors (n calls of glibc's sincos),
# for chains of 2 to 32 rods with joint torques, two arms of seven joints, the double pendulum and the four-bar, beside those of
# MuJoCo, KDL, Bullet, DART and Simbody from Debian's packages (--alone: without), and of two systems of one coordinate beside those
# written by hand (by_hand.cpp); BUILD is the folder of the build (build/release).
# Last come the rounding errors of right-hand sides at states along hard motions, against 50 digits (rounding.py).
# Packages that are missing are installed where this runs as root, and left out otherwise.
# --json writes a list of {system, floor_ns, ours_ns, ours_pack_ns, formulation, operations, error, compile_s, rivals: {name: ns}},
# --svg a bar chart. rhs.cpp says how time is taken.
set -eu

root=$(cd -- "$(dirname -- "$0")/../.." && pwd)
build=$root/build/release
file=
chart=
target=bench_rivals
while [ $# -gt 0 ]; do
    case $1 in
        --alone) target=bench_rhs ;;
        --json | --svg)
            [ $# -gt 1 ] || { echo "$1 needs the name of a file" >&2; exit 3; }
            if [ "$1" = --json ]; then file=$2; else chart=$2; fi
            shift ;;
        -*) echo "usage: rhs.sh [--alone] [--json FILE] [--svg FILE] [BUILD]" >&2; exit 3 ;;
        *) build=$1 ;;
    esac
    shift
done

install_rivals() {
    local package missing=()
    for package in libmujoco-dev liborocos-kdl-dev libbullet-dev libdart-dev libsimbody-dev; do
        [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || missing+=("$package")
    done
    [ ${#missing[@]} -gt 0 ] || return 0
    if [ "$(id -u)" -eq 0 ] && command -v apt-get >/dev/null; then
        echo "installing ${missing[*]}"
        apt-get -qq update >/dev/null && DEBIAN_FRONTEND=noninteractive apt-get -qq -y --no-install-recommends install "${missing[@]}" >/dev/null && return 0
    fi
    for package in "${missing[@]}"; do echo "left out: $package is not installed (apt-get install $package)"; done
}
if [ "$target" = bench_rivals ]; then
    install_rivals
    cmake "$build" >/dev/null # looks for what has been installed since
fi
log=$(cmake --build "$build" --target alembert "$target" 2>&1) || { printf '%s\n' "$log" >&2; exit 5; }
alembert=$build/generator/alembert
folder=$(mktemp -d)
trap 'rm -rf -- "$folder"' EXIT
export XDG_CACHE_HOME=$folder/cache

systems=()
add() { # SCENE
    local name
    name=$(basename "$1" .toml)
    "$alembert" emit --batch --json "$1" -o "$folder" >"$folder/$name.json"
    systems+=("$folder/$name.json" "$folder/$name.cpp")
}
for n in 2 4 8 16 32; do
    python3 -B "$root/scenes/benchmark/chain.py" "$n" --torques >"$folder/pend$n.toml"
    add "$folder/pend$n.toml"
done
for arm in arm7 arm7g; do
    python3 -B "$root/scenes/benchmark/torques.py" "$root/scenes/benchmark/trees/$arm.toml" >"$folder/$arm.toml"
    add "$folder/$arm.toml"
done
for one in pendulum oscillator spring; do add "$root/tests/bench/systems/$one.toml"; done
add "$root/scenes/textbook/double_pendulum.toml"
add "$root/scenes/textbook/four_bar.toml"
[ -n "$file" ] || file=$folder/rows.json
"$build/tests/$target" --json "$file" "$root/tests" "${systems[@]}"
[ -z "$chart" ] || python3 -B "$root/tests/bench/chart.py" "$file" >"$chart"
python3 -B "$root/tests/bench/rounding.py" "$alembert"
