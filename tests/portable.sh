#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The archive of `cmake --build build/release --target portable` on releases of Debian with other versions of glibc, each
# made by debootstrap: the same words and JSON as the program here.
#   portable.sh [RELEASE...]      default: bullseye bookworm trixie
# Needs root and debootstrap for the releases; without them the archive is tried on this machine alone. A command of its
# own: no test of CTest needs it.
set -euo pipefail
cd -- "$(dirname -- "$0")/.."
[ $# -gt 0 ] || set -- bullseye bookworm trixie
program=build/release/generator/alembert
cmake --build build/release --target alembert portable >/dev/null
archive=$(echo build/release/alembert-*-linux-x86_64.tar.xz)
work=$(mktemp -d)
trap 'umount "$work"/*/proc 2>/dev/null || true; rm -rf --one-file-system "$work"' EXIT
mkdir "$work/here"
tar xJf "$archive" -C "$work/here" --strip-components=1
portable=$work/here/bin/alembert
newest=$(objdump -T "$portable" | grep -oE 'GLIBC_[0-9.]+' | sort -uV | tail -n 1)
printf '%s: %d bytes, the program %d; it asks for %s\n' "$(basename "$archive")" "$(stat -c %s "$archive")" "$(stat -c %s "$portable")" "$newest"
[ "$(printf '%s\nGLIBC_2.31\n' "$newest" | sort -V | tail -n 1)" = GLIBC_2.31 ] || { echo 'that is newer than 2.31' >&2; exit 1; }

calls=(
    'derive scenes/textbook/double_pendulum.toml --json' 'derive scenes/textbook/rolling_coin.toml --steps --language zh'
    'check scenes/textbook/heavy_top.toml --json' 'check --formalisms scenes/textbook/cart_pole.toml --json'
    'eval scenes/textbook/crane.toml --json' 'equilibrium scenes/textbook/rotating_hoop.toml --json'
    'stability scenes/textbook/rotating_hoop.toml --json' 'audit scenes/textbook/rolling_disc_in_space.toml --json'
    'emit scenes/textbook/four_bar.toml -o emitted' 'simulate scenes/textbook/double_pendulum.toml --csv motion.csv'
    'simulate scenes/textbook/bouncing_ball.toml --csv bounces.csv' 'simulate scenes/textbook/four_bar.toml --csv four.csv --method radau'
    'report scenes/textbook/spherical_pendulum.toml -o page.html' 'derive missing.toml'
)
# Every call in a folder with the scenes: what it prints and its exit code, without times; then the files.
cat >"$work/calls.sh" <<'EOF'
while read -r call; do
    code=0
    "$1" $call >said 2>&1 || code=$?
    printf '== %s -> %d\n' "$call" "$code"
    grep -vE 'seconds|秒' said || true
done
cat emitted/*.cpp motion.csv bounces.csv four.csv
wc -l <page.html
EOF
all_of() { # COMMAND...: runs calls.sh where the scenes are
    printf '%s\n' "${calls[@]}" | "$@" bash -e calls.sh "$program_there"
}
mkdir "$work/said"
for place in "$work/here"; do
    cp "$work/calls.sh" "$place"
    program_there=$PWD/$program
    (cd "$place" && all_of env -i HOME=/root PATH=/usr/bin:/bin LANG=C.UTF-8) >"$work/said/native"
    program_there=bin/alembert
    (cd "$place" && all_of env -i HOME=/root PATH=/usr/bin:/bin LANG=C.UTF-8) >"$work/said/here"
done
diff "$work/said/native" "$work/said/here" || { echo 'the archive says something else here' >&2; exit 1; }
printf '%d calls say the same here\n' "${#calls[@]}"

mirror=$(apt-get indextargets --format '$(REPO_URI) $(RELEASE)' 'Created-By: Packages' 2>/dev/null | awk '$2 == "bookworm" { print $1; exit }')
if [ "$(id -u)" -ne 0 ] || [ -z "$mirror" ] || ! command -v debootstrap >/dev/null; then
    echo 'no other releases can be made here'
    exit
fi
for release in "$@"; do
    system=$work/$release
    debootstrap --variant=minbase "$release" "$system" "$mirror" >"$work/log" 2>&1 || { echo "$release: cannot be made here"; continue; }
    cp -r "$work/here" "$system/root/portable"
    mount -t proc proc "$system/proc"
    program_there=bin/alembert
    all_of chroot "$system" env -i HOME=/root PATH=/usr/bin:/bin LANG=C.UTF-8 bash -c 'cd /root/portable && exec "$@"' bash >"$work/said/$release"
    diff "$work/said/native" "$work/said/$release" || { echo "the archive says something else in $release" >&2; exit 1; }
    printf '%s (%s): the same\n' "$release" "$(chroot "$system" ldd --version | head -n 1)"
    umount "$system/proc"
done
