#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds HEAD and runs its tests where the compiler and the libraries are others: in a bare Debian 13 (g++ 14, GiNaC 1.8.8,
# toml++ 3.4, SUNDIALS 7), made by debootstrap, and with clang on this machine.
#   elsewhere.sh [trixie] [clang]      default: both
# Needs root, debootstrap and a mirror of Debian for the first; clang++ for the second.
# The tests that compare bytes with those of g++ 12 are not among those that run there.
set -euo pipefail
cd -- "$(dirname -- "$0")/.."
[ $# -gt 0 ] || set -- trixie clang
parts='^(runtime|scene|symbolic|written|generator|machine|stability|commands|derivations_corpus|derivations_steps)$'

in_clang() {
    command -v clang++ >/dev/null || { echo 'there is no clang++ here'; return 77; }
    cmake --preset clang -DCMAKE_UNITY_BUILD=ON >/dev/null
    cmake --build build/clang
    ctest --test-dir build/clang -j "$(nproc)" -R "$parts" --output-on-failure
}

in_release() { # RELEASE
    local mirror system
    [ "$(id -u)" -eq 0 ] && command -v debootstrap >/dev/null || { echo 'only root can make a bare Debian, with debootstrap'; return 77; }
    mirror=$(apt-get indextargets --format '$(REPO_URI) $(RELEASE)' 'Created-By: Packages' | awk '$2 == "bookworm" { print $1; exit }')
    system=$work/$1
    debootstrap --variant=minbase "$1" "$system" "$mirror" >"$work/log" 2>&1 || { tail -n 5 "$work/log"; return 77; }
    cp -L /etc/resolv.conf /etc/hosts "$system/etc"
    mount -t proc proc "$system/proc"
    mount --bind /dev "$system/dev"
    mount -t devpts -o newinstance,ptmxmode=0666,mode=620,gid=5 devpts "$system/dev/pts"
    mount -t tmpfs tmpfs "$system/dev/shm"
    git clone -q --depth 1 "file://$PWD" "$system/root/alembert"
    chroot "$system" env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 bash -ec "
        cd /root/alembert
        ./run.sh scenes/textbook/double_pendulum.toml
        cmake --build build/release
        ctest --test-dir build/release -j $(nproc) -R '$parts' --output-on-failure" </dev/null
}

# What is mounted is mounted in a namespace of its own, which ends with the script.
if [ "${ALEMBERT_ELSEWHERE-}" = '' ] && [ "$(id -u)" -eq 0 ]; then
    ALEMBERT_ELSEWHERE=inside exec unshare --mount -- "$0" "$@"
fi
work=$(mktemp -d)
trap 'umount "$work"/*/dev/pts "$work"/*/dev/shm "$work"/*/proc "$work"/*/dev 2>/dev/null || true; rm -rf --one-file-system "$work"' EXIT
for where in "$@"; do
    printf '== %s\n' "$where"
    case $where in
        clang) in_clang ;;
        *) in_release "$where" ;;
    esac
done
