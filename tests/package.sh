#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds the package of Debian, holds it against lintian, installs it, and uses what it brings: the program, the manual,
# the completion, and find_package(alembert). Needs root (it installs), Debian, and minutes.
#   package.sh [--keep]      --keep: the package stays installed
# Without --keep the package is removed at the end, or what was installed of it before the failure.
set -eu
cd "$(dirname "$0")/.."
keep=${1-}
[ "$(id -u)" = 0 ] || { echo 'package.sh installs a package: run it as root' >&2; exit 5; }
work=$(mktemp -d)
clean() {
    rm -rf "$work"
    [ "$keep" = --keep ] || dpkg --purge alembert >/dev/null 2>&1 || true
}
trap clean EXIT
fail() { printf '%s\n' "$@" >&2; exit 1; }

cmake --preset release >"$work/log"
cmake --build build/release >>"$work/log" 2>&1 || { tail -n 30 "$work/log"; exit 1; }
(cd build/release && cpack -G DEB -B "$work/deb") >>"$work/log" 2>&1 || { tail -n 30 "$work/log"; exit 1; }
package=$(echo "$work"/deb/*.deb)
echo "$(basename "$package"): $(du -h "$package" | cut -f1)"
command -v lintian >/dev/null || fail 'lintian is not installed'
lintian --fail-on error --allow-root "$package" || fail 'lintian finds errors'

DEBIAN_FRONTEND=noninteractive apt-get -qq -y install "$package" >>"$work/log" 2>&1 || { tail -n 30 "$work/log"; exit 1; }
cp scenes/textbook/double_pendulum.toml "$work/scene.toml"
root=$PWD
cd "$work"
export XDG_CACHE_HOME=$work/cache
[ "$(command -v alembert)" = /usr/bin/alembert ] || fail 'alembert is not /usr/bin/alembert'
alembert derive scene.toml >/dev/null
alembert simulate scene.toml --duration 1 --plot motion.svg >/dev/null
[ -s motion.svg ] || fail 'there is no picture'
bash -c '. /usr/share/bash-completion/completions/alembert && complete -p alembert' >/dev/null
# What a container's dpkg leaves out (manual, documentation) is in the list all the same.
dpkg -L alembert >list
for file in share/man/man1/alembert.1.gz share/man/man1/alembert-simulate.1.gz share/alembert/scene.schema.json \
    share/doc/alembert/docs/guide.md share/doc/alembert/copyright share/zsh/vendor-completions/_alembert \
    share/fish/vendor_completions.d/alembert.fish share/doc/alembert/examples/textbook/double_pendulum.toml; do
    grep -qx "/usr/$file" list || fail "/usr/$file is missing"
done
cmake -G Ninja -S "$root/examples" -B examples >log 2>&1 || { tail -n 30 log; exit 1; }
cmake --build examples >log 2>&1 || { tail -n 30 log; exit 1; }
examples/bouncing_ball | tail -n 1
echo 'the package is built, passes lintian, installs and works'
