#!/bin/bash
# SPDX-License-Identifier: MIT
# Makes the documentation site: the pages of docs/, README.md and others as they are, in English and Chinese, with search and a
# gallery of all scenes. A folder of files for any web server, which also opens from disk, and one archive of it.
#   web/site.sh [FOLDER]     build/site where none is named; the archive is build/alembert-VERSION-site.tar.xz
# Needs the program (run.sh), python3-venv, and PyPI for MkDocs, which stays in build/site-work. What the program draws and derives
# for the gallery is kept there too, until the program or the scene changes. Where the playground has been made (web/playground.sh),
# the site has it.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
folder=${1:-$root/build/site}
work=$root/build/site-work
program=${ALEMBERT:-$root/build/release/generator/alembert}
python=${PYTHON-/usr/bin/python3}
version=$("$root/packaging/version.sh")
[ -x "$program" ] || { echo "there is no $program: run.sh makes it"; exit 5; }
tools=$work/tools
cmp -s "$root/web/site/requirements.txt" "$tools/requirements.txt" || {
  "$python" -m venv --clear "$tools"
  "$tools/bin/pip" --quiet --disable-pip-version-check install -r "$root/web/site/requirements.txt"
  cp "$root/web/site/requirements.txt" "$tools"
}

# The pages as they stand in the repository, with what they link to.
pages=$work/pages
rm -rf "$pages"
mkdir -p "$pages/assets" "$pages/web/package"
cp "$root"/{README,README.zh,CONTRIBUTING,CHANGELOG}.md "$pages"
cp -r "$root"/{docs,examples} "$pages"
cp "$root/web/README.md" "$pages/web"
cp "$root/web/package/README.md" "$pages/web/package"
cp "$root"/web/site/{site.css,iframe-worker.js} "$root/web/playground/icon.svg" "$pages/assets"
playground=$root/build/web/playground
[ ! -e "$playground/alembert.wasm" ] || cp -r "$playground" "$pages/playground"

code=0
"$tools/bin/python" "$root/web/site/gallery.py" "$program" "$root/scenes" "$pages" "$work/scenes" || code=$?
NO_MKDOCS_2_WARNING=1 SITE_NAME="alembert $version" PAGES=$pages "$tools/bin/mkdocs" --quiet build --strict --clean -f "$root/web/site/mkdocs.yml" -d "$folder"
archive=$root/build/alembert-$version-site.tar.xz
XZ_OPT='-T0 -3' tar --sort=name --owner=0 --group=0 --transform "s|^\.|alembert-$version-site|" -C "$folder" -cJf "$archive" .
printf '%s: %d pages, %d kB; %s: %d kB\n' "$folder" "$(find "$folder" -name '*.html' | wc -l)" "$(du -sk "$folder" | cut -f 1)" \
  "$(basename "$archive")" "$(du -k "$archive" | cut -f 1)"
exit $code
