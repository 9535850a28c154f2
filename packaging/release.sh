#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Makes a folder of files into a release: the sources as one archive, the recipes that name it, and checksums of all.
#   packaging/release.sh TAG FOLDER              TAG: v and the version of CMakeLists.txt
#   packaging/release.sh --publish TAG FOLDER    then releases them on GitHub, with the section of CHANGELOG.md as its text
# FOLDER has what is released besides (wheels, packages); files of its subfolders are moved up. Needs git, unless the sources
# are there as alembert-VERSION.tar.gz; --publish needs gh with $GH_TOKEN, and $GITHUB_REPOSITORY, which the recipes name too.
set -euo pipefail
root=$(cd -- "$(dirname -- "$0")/.." && pwd)
publishes=no
if [ "${1-}" = --publish ]; then
    publishes=yes
    shift
fi
[ $# -eq 2 ] || { echo 'usage: packaging/release.sh [--publish] TAG FOLDER' >&2; exit 3; }
tag=$1 folder=$2
fail() { printf '%s\n' "$@" >&2; exit 3; }

version=$("$root/packaging/version.sh")
[ "$tag" = "v$version" ] || fail "the tag is $tag, and CMakeLists.txt has the version $version: expected v$version"
notes=$(awk -v title="## $version" '$0 == title || index($0, title " ") == 1 { on = 1; next } /^## / { on = 0 } on' "$root/CHANGELOG.md")
[ -n "${notes//[[:space:]]/}" ] || fail "CHANGELOG.md has no section \"## $version\": write what is new there"
[ -d "$folder" ] || fail "$folder: no such folder"
folder=$(cd -- "$folder" && pwd)

find "$folder" -mindepth 2 -type f -exec mv -n -t "$folder" {} +
find "$folder" -mindepth 1 -type d -empty -delete
left=$(find "$folder" -mindepth 2 -type f)
[ -z "$left" ] || fail 'two files have one name:' "$left"

sources=$folder/alembert-$version.tar.gz
[ -e "$sources" ] || git -C "$root" archive --prefix="alembert-$version/" -o "$sources" HEAD
"$root/packaging/recipes.sh" "$sources" "https://github.com/${GITHUB_REPOSITORY:-OWNER/alembert}/releases/download/$tag/$(basename "$sources")" "$folder/recipes"
tar --sort=name --owner=0 --group=0 -C "$folder" -czf "$folder/alembert-$version-recipes.tar.gz" recipes
rm -r "$folder/recipes"

cd -- "$folder"
rm -f SHA256SUMS
# shellcheck disable=SC2035 # names begin with alembert
LC_ALL=C sha256sum * >"$folder/.sums"
mv .sums SHA256SUMS
cat SHA256SUMS
[ $publishes = yes ] || exit 0
gh release create "$tag" --repo "$GITHUB_REPOSITORY" --verify-tag --title "alembert $version" --notes "$notes" -- *
