#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Makes the package for npm from the program as WebAssembly (web/build.sh): alembert-VERSION.tgz.
#   web/package.sh [PROGRAM_FOLDER]     build/web where none is named; the package is put there
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
program=$(realpath "${1:-$root/build/web}")
for tool in node npm; do
  command -v "$tool" >/dev/null || { echo "there is no $tool here"; exit 5; }
done
for file in alembert.wasm alembert.mjs; do
  [ -e "$program/$file" ] || { echo "there is no $program/$file: web/build.sh makes it"; exit 5; }
done
node "$root/web/package/build.mjs" "$root" "$program" "$program/package"
cd "$program"
name=$(npm pack --silent --offline --pack-destination "$program" "$program/package")
printf '%s: %d bytes\n' "$program/$name" "$(stat -c %s "$name")"
