# SPDX-License-Identifier: MIT
# shellcheck shell=bash
# Sourced by run.sh and test.sh, in the root of the repository: installs what is missing, configures, builds. README.md
# says what each package is for.

# Without these it is not built.
needed="g++ cmake ninja-build pkg-config libginac-dev libcln-dev libeigen3-dev libfmt-dev libtomlplusplus-dev
    libcli11-dev libkainjow-mustache-dev nlohmann-json3-dev liburdfdom-dev libtinyxml-dev libtinyxml2-dev doctest-dev gettext"
# Without these a part of it is not built, or not tested.
wanted="libcpp-httplib-dev pybind11-dev python3-dev python3-numpy libhdf5-dev libopenmpi-dev libsundials-dev libgsl-dev
    libboost-dev"
[ "$(dpkg --print-architecture 2>/dev/null)" != amd64 ] || wanted="$wanted libxbyak-dev" # Debian has it for amd64 alone
is_complete=no # whether all of them are there in the end

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

# missing_of PACKAGE...: those that are not installed, in the array `missing`.
missing_of() {
    missing=()
    for package in "$@"; do
        [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || missing+=("$package")
    done
}

# without_root WHY: goes on without the wanted packages, but not without the needed ones.
without_root() {
    local all="${missing[*]}"
    # shellcheck disable=SC2086 # a list of words
    missing_of $needed
    [ ${#missing[@]} -eq 0 ] || fail "$1; install as root:" "    apt-get install $all"
    printf '%s; going on without what needs these packages:\n    %s\n' "$1" "$all" >&2
}

install_missing() {
    command -v dpkg-query >/dev/null || return 0 # not Debian: CMake will say what it does not find
    # shellcheck disable=SC2086
    missing_of $needed $wanted
    if [ ${#missing[@]} -gt 0 ]; then
        as_root=(env)
        if [ "$(id -u)" -ne 0 ]; then
            command -v sudo >/dev/null || { without_root "packages are missing" && return; }
            sudo true || { without_root "sudo was refused" && return; }
            as_root=(sudo env)
        fi
        printf 'installing %s\n' "${missing[*]}"
        as_root+=(DEBIAN_FRONTEND=noninteractive apt-get -qq -o Acquire::Retries=3)
        logged build/packages.log "${as_root[@]}" update
        logged build/packages.log "${as_root[@]}" -y --no-install-recommends install "${missing[@]}"
    fi
    is_complete=yes
}

# set_up PRESET TARGET: what is missing, then configure and build.
set_up() {
    mkdir -p build || fail "cannot make the folder $PWD/build"
    install_missing
    [ -f "build/$1/build.ninja" ] || printf 'building %s for the first time, which takes minutes; the log is build/%s-build.log\n' "$2" "$1"
    logged "build/$1-configure.log" cmake --preset "$1"
    build=(cmake --build "build/$1" --target "$2")
    if [ -t 1 ]; then
        "${build[@]}" || fail "failed: ${build[*]}" # ninja shows its progress and its errors
    else
        logged "build/$1-build.log" "${build[@]}"
    fi
}
