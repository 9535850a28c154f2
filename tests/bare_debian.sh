# SPDX-License-Identifier: MIT
# shellcheck shell=bash
# Sourced by what tries things on a bare Debian 12 (fresh.sh, ways.sh), as root, in a namespace of mounts of its own:
#
#   in_own_namespace "$0" "$@"       # the same script again with --inside FOLDER before its words, then exit
#   make_debian "$FOLDER" "$(mirrors_of_debian bookworm)"
#   in_debian "$FOLDER" 'apt-get update'

cannot() { # WHY [LINE...]
    printf 'no fresh machine: %s\n' "$1" >&2
    [ $# -eq 1 ] || printf '%s\n' "${@:2}" >&2
    exit 77
}

# What is mounted is mounted in a namespace of its own, with processes of its own: they end with it, and the folder can be
# removed without harm.
in_own_namespace() { # SCRIPT WORD...
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
    unshare --mount --pid --fork --kill-child "$1" --inside "$work" "${@:2}" &
    child=$!
    local code=0
    wait "$child" || code=$?
    child=
    exit "$code"
}

logged() { # WHAT COMMAND...: quiet; without it there is no fresh machine
    local what=$1
    shift
    "$@" >"$work/log" 2>&1 </dev/null || cannot "$what" "$(tail -n 5 "$work/log")"
}

# The mirrors of this machine's apt for these releases, a regular expression: "URI RELEASE COMPONENT" in each line.
mirrors_of_debian() { # RELEASES
    apt-get indextargets --format '$(REPO_URI) $(RELEASE) $(COMPONENT)' 'Created-By: Packages' | grep -E " ($1) main$" | sort -u
}

# A bare Debian 12 in a folder, with these mirrors, reached as this machine reaches them, and a clone of HEAD.
make_debian() { # FOLDER MIRRORS
    local system=$1 mirror repository
    mirror=$(awk '$2 == "bookworm" { print $1; exit }' <<<"$2")
    [ -n "$mirror" ] || cannot 'no mirror of Debian 12 is among the sources of apt'
    logged 'debootstrap failed' debootstrap --variant=minbase bookworm "$system" "$mirror"
    sed 's/^/deb /' <<<"$2" >"$system/etc/apt/sources.list"
    {
        apt-config dump | grep -E '^Acquire::(https?|Check|Force|Allow|Max)[^ ]* "' || true
        echo 'Acquire::Retries "5"; APT::Update::Error-Mode "any";' # what cannot be fetched is told
    } >"$system/etc/apt/apt.conf.d/90this-machine"
    logged 'the network is unknown' cp -L /etc/resolv.conf /etc/hosts "$system/etc"
    logged 'mounts are refused' mount -t proc proc "$system/proc"
    logged 'mounts are refused' mount --bind /dev "$system/dev"
    logged 'mounts are refused' mount -t devpts -o newinstance,ptmxmode=0666,mode=620,gid=5 devpts "$system/dev/pts"
    logged 'mounts are refused' mount -t tmpfs tmpfs "$system/dev/shm"
    repository=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)
    logged 'HEAD cannot be cloned' git clone -q --depth 1 "file://$repository" "$system/root/alembert"
}

in_debian() { # FOLDER COMMAND: a line for a shell in the clone, in a clean environment
    chroot "$1" env -i HOME=/root PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 \
        bash -c "cd /root/alembert && $2" </dev/null 2>&1
}
