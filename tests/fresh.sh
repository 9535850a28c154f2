#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Both commands of README.md on a bare Debian 12: debootstrap makes a system in a temporary folder, HEAD is cloned into
# it, and the two commands run there, each in a clean environment. Afterwards all works that README.md names, and no test
# was skipped (fresh_check.sh).
#   fresh.sh
# Needs root, debootstrap, 8 GB in $TMPDIR or /tmp, and a mirror of Debian among the sources of this machine's apt.
# Exit code: 0 all works, 1 something does not, 77 no such system can be made here.
set -euo pipefail

cannot() {
    printf 'no fresh machine: %s\n' "$1" >&2
    [ $# -eq 1 ] || printf '%s\n' "${@:2}" >&2
    exit 77
}

# What is mounted is mounted in a namespace of its own, with processes of its own: they end with it, and the folder can be
# removed without harm.
if [ "${1-}" != --inside ]; then
    [ "$(id -u)" -eq 0 ] || cannot 'only root can make one'
    command -v debootstrap >/dev/null || cannot 'debootstrap is not installed'
    unshare --mount --pid --fork true || cannot 'mounts of its own are refused'
    work=$(mktemp -d "${TMPDIR:-/tmp}/alembert-fresh-XXXXXX")
    clean() { # unshare does not listen to TERM; what it has started ends with it
        if [ -n "${child-}" ] && kill -KILL "$child" 2>/dev/null; then wait "$child" || true; fi
        rm -rf --one-file-system "$work" 2>/dev/null || { sleep 2 && rm -rf --one-file-system "$work"; }
    }
    trap clean EXIT
    trap 'exit 143' HUP INT TERM
    unshare --mount --pid --fork --kill-child "$0" --inside "$work" &
    child=$!
    code=0
    wait "$child" || code=$?
    child=
    exit "$code"
fi

work=$2
system=$work/system
here=$(cd -- "$(dirname -- "$0")" && pwd)
repository=$(cd -- "$here/.." && pwd)
log=$work/log

logged() { # WHAT COMMAND...: quiet; without it there is no fresh machine
    local what=$1
    shift
    "$@" >"$log" 2>&1 </dev/null || cannot "$what" "$(tail -n 5 "$log")"
}

# The same mirror as this machine's, reached in the same way.
mirrors=$(apt-get indextargets --format '$(REPO_URI) $(RELEASE) $(COMPONENT)' 'Created-By: Packages' |
    grep -E ' bookworm(-updates|-security)? main$' | sort -u) || cannot 'no mirror of Debian 12 is among the sources of apt'
mirror=$(awk '$2 == "bookworm" { print $1; exit }' <<<"$mirrors")
[ -n "$mirror" ] || cannot 'no mirror of Debian 12 is among the sources of apt'
logged 'debootstrap failed' debootstrap --variant=minbase bookworm "$system" "$mirror"
sed 's/^/deb /' <<<"$mirrors" >"$system/etc/apt/sources.list"
{
    apt-config dump | grep -E '^Acquire::(https?|Check|Force|Allow|Max)[^ ]* "' || true
    echo 'Acquire::Retries "5"; APT::Update::Error-Mode "any";' # what cannot be fetched is told, see `run`
} >"$system/etc/apt/apt.conf.d/90this-machine"
logged 'the network is unknown' cp -L /etc/resolv.conf /etc/hosts "$system/etc"
logged 'mounts are refused' mount -t proc proc "$system/proc"
logged 'mounts are refused' mount --bind /dev "$system/dev"
logged 'mounts are refused' mount -t devpts -o newinstance,ptmxmode=0666,mode=620,gid=5 devpts "$system/dev/pts"
logged 'mounts are refused' mount -t tmpfs tmpfs "$system/dev/shm"
logged 'HEAD cannot be cloned' git clone -q --depth 1 "file://$repository" "$system/root/alembert"
printf 'a fresh Debian 12 after %d s\n' "$SECONDS"

inside() { # COMMAND: a line for a shell in the clone
    chroot "$system" env -i HOME=/root PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 \
        bash -c "cd /root/alembert && $1" </dev/null 2>&1
}

# What the registry did not give is no fault of ours.
stutters='Failed to fetch|Unable to fetch|Could not (connect|resolve)|Temporary failure|timed out|Hash Sum mismatch'
run() { # COMMAND: tells the time that it took; its output stays in $work/said
    local before=$SECONDS code=0
    printf '\n$ %s\n' "$1"
    inside "$1" | tee "$work/said" || code=$?
    printf '\n%s: %d s\n' "$1" $((SECONDS - before))
    [ "$code" -ne 0 ] || return 0
    if grep -q '^failed: .*apt-get' "$work/said" && grep -qE "$stutters" "$system/root/alembert/build/packages.log"; then
        cannot 'the registry does not give the packages'
    fi
    printf '%s ended with %d in a fresh Debian 12\n' "$1" "$code" >&2
    exit 1
}

mapfile -t commands < <(sed -n '/^## Two commands/,/^## /s/^\(\.\/[^#]*[^# ]\) *#.*/\1/p' "$repository/README.md")
[ "${#commands[@]}" -eq 2 ] || { echo 'README.md does not have its two commands' >&2; exit 1; }
run "${commands[0]}"
exports=$(sed -n '/^## Two commands/,/^## /s/^\(export [^#]*[^# ]\) *#.*/\1/p' "$repository/README.md")
inside "$exports; tests/fresh_check.sh" || exit 1
run "${commands[1]}"
if grep -E '\*\*\*(Skipped|Not Run)|did not run:' "$work/said" || ! grep -qE ' browser \.+ +Passed' "$work/said"; then
    echo 'a test was skipped' >&2
    exit 1
fi
printf 'both commands work in a fresh Debian 12, and no test was skipped: %d s in all\n' "$SECONDS"
