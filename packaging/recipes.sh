#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Writes the recipes for conda-forge and Homebrew, filled in for one archive of the sources.
#   packaging/recipes.sh ARCHIVE URL FOLDER      URL: where ARCHIVE can be had
# In the recipes here @version@, @url@ and @sha256@ stand for the version, URL and the checksum of ARCHIVE, @home@ for the URL
# before /releases/.
set -euo pipefail
[ $# -eq 3 ] || { echo 'usage: packaging/recipes.sh ARCHIVE URL FOLDER' >&2; exit 3; }
here=$(cd -- "$(dirname -- "$0")" && pwd)
version=$("$here/version.sh")
sum=$(sha256sum "$1" | cut -d ' ' -f 1)
for recipe in conda/recipe.yaml conda/build.sh homebrew/alembert.rb; do
    mkdir -p "$3/$(dirname "$recipe")"
    sed -e "s|@version@|$version|g" -e "s|@url@|$2|g" -e "s|@sha256@|$sum|g" -e "s|@home@|${2%%/releases/*}|g" "$here/$recipe" >"$3/$recipe"
    chmod --reference="$here/$recipe" "$3/$recipe"
done
