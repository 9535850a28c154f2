#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Both commands of README.md on a bare Debian 12: debootstrap makes a system in a temporary folder, HEAD is cloned into
# it, and the two commands run there, each in a clean environment. Afterwards all works that README.md names, and no test
# was skipped (fresh_check.sh). This is done on a system that has the packages of the release alone; then what it has
# built goes to a second one, which has the updates and the security updates too, and all is tried there.
#   fresh_both.sh [--whole]       --whole: the second system builds all by itself
# Needs root, debootstrap, 8 GB in $TMPDIR or /tmp, and a mirror of Debian among the sources of this machine's apt.
# Exit code: 0 all works, 1 something does not, 77 no such system can be made here.
set -euo pipefail
# shellcheck source=tests/bare_debian.sh
. "$(dirname -- "$0")/bare_debian.sh"
[ "${1-}" = --inside ] || in_own_namespace "$0" "$@"
work=$2
whole=${3-}
repository=$(cd -- "$(dirname -- "$0")/.." && pwd)

# What the registry did not give is no fault of ours.
stutters='Failed to fetch|Unable to fetch|Could not (connect|resolve)|Temporary failure|timed out|Hash Sum mismatch'
run() { # COMMAND: in the clone; tells the time that it took; its output stays in $work/said
    local before=$SECONDS code=0
    printf '\n$ %s\n' "$1"
    in_debian "$system" "$1" | tee "$work/said" || code=$?
    printf '\n%s: %d s\n' "$1" $((SECONDS - before))
    [ "$code" -ne 0 ] || return 0
    if grep -q '^failed: .*apt-get' "$work/said" && grep -qE "$stutters" "$system/root/alembert/build/packages.log"; then
        cannot 'the registry does not give the packages'
    fi
    printf '%s ended with %d in a fresh Debian 12 with %s\n' "$1" "$code" "$has" >&2
    exit 1
}

mapfile -t commands < <(sed -n '/^## Two commands/,/^## /s/^\(\.\/[^#]*[^# ]\) *#.*/\1/p' "$repository/README.md")
[ "${#commands[@]}" -eq 2 ] || { echo 'README.md does not have its two commands' >&2; exit 1; }
exports=$(sed -n '/^## Two commands/,/^## /s/^\(export [^#]*[^# ]\) *#.*/\1/p' "$repository/README.md")

tried() { # both commands, and what README.md names between them
    run "${commands[0]}"
    in_debian "$system" "$exports; tests/fresh_check.sh" || exit 1
    run "${commands[1]}"
    if grep -E '\*\*\*(Skipped|Not Run)|did not run:' "$work/said" || ! grep -qE ' browser \.+ +Passed' "$work/said"; then
        echo 'a test was skipped' >&2
        exit 1
    fi
    printf 'both commands work in a fresh Debian 12 with %s, and no test was skipped: %d s in all\n' "$has" "$SECONDS"
}

release=$(mirrors_of_debian bookworm) || cannot 'no mirror of Debian 12 is among the sources of apt'
newer=$(mirrors_of_debian 'bookworm(-updates|-security)?')
has='the packages of the release' system=$work/release
make_debian "$system" "$release"
printf 'a fresh Debian 12 with %s after %d s\n' "$has" "$SECONDS"
tried
[ "$newer" != "$release" ] || { echo "this machine's apt has no updates" && exit; }

has='all updates' system=$work/updated
make_debian "$system" "$newer"
printf '\na fresh Debian 12 with %s after %d s\n' "$has" "$SECONDS"
if [ "$whole" != --whole ]; then
    rm -rf "$system/root/alembert"
    mv "$work/release/root/alembert" "$system/root/alembert"
fi
for folder in dev/shm dev/pts dev proc; do umount --lazy "$work/release/$folder"; done
rm -rf --one-file-system "$work/release"
tried
