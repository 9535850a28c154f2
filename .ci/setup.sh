# SPDX-License-Identifier: MIT
# shellcheck shell=bash
# Sourced by run.sh and test.sh, in the root of the repository: installs what is missing, configures, builds.

packages="g++ cmake ninja-build pkg-config libginac-dev libcln-dev libeigen3-dev libfmt-dev libtomlplusplus-dev
    libcli11-dev libkainjow-mustache-dev nlohmann-json3-dev liburdfdom-dev libtinyxml2-dev doctest-dev gettext"

# What failed is the environment, not the scene (shared with the exit codes of alembert).
fail() {
    printf '%s\n' "$@" >&2
    exit 5
}

# logged LOG COMMAND...: quiet; the end of the log is shown where the command fails.
logged() {
    log=$1
    shift
    "$@" >"$log" 2>&1 </dev/null && return
    tail -n 40 "$log" >&2
    fail "failed: $*" "the whole log is in $PWD/$log"
}

install_missing() {
    command -v dpkg-query >/dev/null || return 0 # not Debian: CMake will say what it does not find
    missing=()
    for package in $packages; do
        [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || missing+=("$package")
    done
    [ ${#missing[@]} -gt 0 ] || return 0
    as_root=(env)
    if [ "$(id -u)" -ne 0 ]; then
        command -v sudo >/dev/null || fail "missing packages; install them as root:" "    apt-get install ${missing[*]}"
        sudo true || fail "sudo was refused; install as root:" "    apt-get install ${missing[*]}"
        as_root=(sudo env)
    fi
    printf 'installing %s\n' "${missing[*]}"
    as_root+=(DEBIAN_FRONTEND=noninteractive apt-get -qq)
    logged build/packages.log "${as_root[@]}" update
    logged build/packages.log "${as_root[@]}" -y --no-install-recommends install "${missing[@]}"
}

# set_up PRESET [TARGET]: what is missing, then configure and build.
set_up() {
    mkdir -p build || fail "cannot make the folder $PWD/build"
    install_missing
    logged "build/$1-configure.log" cmake --preset "$1"
    build=(cmake --build "build/$1" --target "${2:-all}")
    if [ -t 1 ]; then
        "${build[@]}" || fail "failed: ${build[*]}" # ninja shows its progress and its errors
    else
        logged "build/$1-build.log" "${build[@]}"
    fi
}
