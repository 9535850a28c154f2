#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Both commands of README.md on a bare Debian 12: debootstrap makes a system in a temporary folder, HEAD is cloned into
# it, and the two commands run there, each in a clean environment. Afterwards all works that README.md names, and no test
# was skipped (fresh_check.sh). This system has the packages of the release alone; then it gets the updates and the security
# updates, and the tests that work with Debian's programs (browser, Python, readers of files) run once more.
#   fresh.sh
# Needs root, debootstrap, 8 GB in $TMPDIR or /tmp, and a mirror of Debian among the sources of this machine's apt.
# Exit code: 0 all works, 1 something does not, 77 no such system can be made here.
set -euo pipefail
# shellcheck source=tests/bare_debian.sh
. "$(dirname -- "$0")/bare_debian.sh"
[ "${1-}" = --inside ] || in_own_namespace "$0" "$@"
work=$2
system=$work/system
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
tests() { # COMMAND: with no test skipped
    run "$1"
    if grep -E '\*\*\*(Skipped|Not Run)|did not run:' "$work/said" || ! grep -qE ' browser \.+ +Passed' "$work/said"; then
        printf 'a test was skipped in a fresh Debian 12 with %s\n' "$has" >&2
        exit 1
    fi
}

mapfile -t commands < <(sed -n '/^## Two commands/,/^## /s/^\(\.\/[^#]*[^# ]\) *#.*/\1/p' "$repository/README.md")
[ "${#commands[@]}" -eq 2 ] || { echo 'README.md does not have its two commands' >&2; exit 1; }
exports=$(sed -n '/^## Two commands/,/^## /s/^\(export [^#]*[^# ]\) *#.*/\1/p' "$repository/README.md")

release=$(mirrors_of_debian bookworm) || cannot 'no mirror of Debian 12 is among the sources of apt'
newer=$(mirrors_of_debian 'bookworm(-updates|-security)?')
has='the packages of the release'
make_debian "$system" "$release"
printf 'a fresh Debian 12 with %s after %d s\n' "$has" "$SECONDS"
run "${commands[0]}"
in_debian "$system" "$exports; tests/fresh_check.sh" || exit 1
tests "${commands[1]}"

if [ "$newer" = "$release" ]; then
    echo "the updates are not tried: they are not among the sources of this machine's apt"
else
    has='all updates'
    sed 's/^/deb /' <<<"$newer" >"$system/etc/apt/sources.list"
    logged 'the registry does not give the updates' in_debian "$system" \
        'export DEBIAN_FRONTEND=noninteractive; apt-get -qq update && apt-get -qq -y dist-upgrade'
    # What has been built stays: new headers would have all of it compiled again.
    tests 'export ALEMBERT_NO_SKIP=1; ctest --preset release --output-on-failure -j "$(nproc)" -R "^(browser|files|mathml|python)$"'
fi
printf 'both commands work in a fresh Debian 12, and no test was skipped: %d s in all\n' "$SECONDS"
