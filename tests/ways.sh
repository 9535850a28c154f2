#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Every row of the table "Other ways to have it" of README.md, on a bare Debian 12: HEAD is cloned there, ./run.sh builds the
# program, and then each row is made by the command in its second column and tried by that in its third. A line for each says
# whether it works and how long it took; what a row that does not work has printed follows its line.
#   ways.sh [WORD...]        only the rows whose first column has one of these words: browser, npm, archive, wheel, source, apt,
#                          documentation
#   ways.sh --here [WORD...] in this tree and on this machine as they are, with what has been built
#   ways.sh --here --install [WORD...]   the same, after the tools of each row were installed by apt-get (root)
# Needs what fresh.sh needs, PyPI for the wheel, and on two cores an hour. Exit code: 0 all work, 1 some do not, 77 no bare Debian
# can be made here.
set -euo pipefail
# shellcheck source=tests/bare_debian.sh
. "$(dirname -- "$0")/bare_debian.sh"
repository=$(cd -- "$(dirname -- "$0")/.." && pwd)
installs=no
case ${1-} in
    --inside)
        work=$2 system=$2/system installs=yes
        shift 2
        ;;
    --here)
        work=$(mktemp -d) system=
        trap 'rm -rf "$work"' EXIT
        shift
        [ "${1-}" != --install ] || { installs=yes && shift; }
        ;;
    *) in_own_namespace "$0" "$@" ;;
esac

# The rows: what it is for, the commands that make it, the command that tries it, by tabs.
rows=$(sed -n '/^## Other ways to have it/,/^## /s/^| \(.*\) | \(.*\) | \(.*\) |$/\1\t\2\t\3/p' "$repository/README.md" | tail -n +3)
[ "$(wc -l <<<"$rows")" -ge 7 ] || { echo 'README.md does not have its table of ways' >&2; exit 1; }
code_in() { # TEXT: what stands first in backquotes
    sed -E 's/^[^`]*`([^`]*)`.*/\1/' <<<"$1"
}

# What the tools of a row are, beside what its commands install by themselves.
packages_for() { # WHAT MAKES IT
    case $1 in
        *site*) echo python3-venv xz-utils chromium chromium-driver fonts-dejavu-core ;;
        *playground*) echo python3 chromium chromium-driver fonts-dejavu-core ;;
        *web/package*) echo npm ;;
        *portable*) echo debootstrap binutils xz-utils ;;
        *wheel*) echo debootstrap python3-venv ;;
        *pip*) echo python3-venv pybind11-dev python3-dev ;;
        *'target package'*) echo dpkg-dev file lintian ;;
    esac
}

if [ -n "$system" ]; then
    make_debian "$system" "$(mirrors_of_debian 'bookworm(-updates|-security)?')"
    # PyPI as this machine reaches it.
    in_debian "$system" 'apt-get -qq update && apt-get -qq -y --no-install-recommends install ca-certificates git' >"$work/log" ||
        cannot 'the registry does not give the packages' "$(tail -n 5 "$work/log")"
    for file in /etc/pip.conf /etc/ssl/certs/ca-certificates.crt; do
        [ ! -e "$file" ] || cp -L "$file" "$system$file"
    done
    run() { in_debian "$system" "export DEBIAN_FRONTEND=noninteractive PIP_CERT=/etc/ssl/certs/ca-certificates.crt; $1"; }
    run './run.sh scenes/textbook/double_pendulum.toml' >"$work/log" ||
        { tail -n 30 "$work/log"; echo './run.sh does not work on a bare Debian 12' >&2; exit 1; }
    printf 'a bare Debian 12 with the program after %d s\n' "$SECONDS"
else
    run() { (cd "$repository" && bash -c "$1") </dev/null 2>&1; }
fi

failed=0
while IFS=$'\t' read -r what made tried; do
    [ $# -eq 0 ] || grep -qiE "$(IFS='|' && echo "$*")" <<<"$what" || continue
    made=$(code_in "$made") tried=$(code_in "$tried")
    case $made in # pip installs into an environment of its own; its test is run with the package that is there
        'pip install .')
            made='python3 -m venv build/ways && build/ways/bin/pip --quiet install .'
            tried='cd build && ways/bin/python ../tests/python_package.py "$PWD/release/generator/alembert"'
            ;;
    esac
    packages=$(packages_for "$made")
    before=$SECONDS result='works'
    if [ $installs = yes ] && ! run "DEBIAN_FRONTEND=noninteractive apt-get -qq -y --no-install-recommends install $packages" >"$work/installed"; then
        result='does not work: its tools cannot be installed' && mv "$work/installed" "$work/said"
    elif ! run "set -e; $made" >"$work/said"; then
        result="cannot be made"
    elif ! run "set -e; $tried" >"$work/said"; then
        result="does not work"
    fi
    printf '%-15s %5d s  %s: %s; %s\n' "$result" $((SECONDS - before)) "${what%%:*}" "$made" "$tried"
    if [ "$result" != works ]; then
        failed=1
        tail -n 25 "$work/said" | sed 's/^/    /'
    fi
done <<<"$rows"
exit $failed
