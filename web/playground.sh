#!/bin/bash
# SPDX-License-Identifier: MIT
# Makes the playground from the program as WebAssembly (web/build.sh): one folder of files for any web server.
#   web/playground.sh [PROGRAM_FOLDER [FOLDER]]     build/web and build/web/playground where none is named
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
program=${1:-$root/build/web}
folder=${2:-$program/playground}
command -v node >/dev/null || { echo "there is no node here"; exit 5; }
for file in alembert.wasm alembert.mjs; do
  [ -e "$program/$file" ] || { echo "there is no $program/$file: web/build.sh makes it"; exit 5; }
done
node "$root/web/playground/build.mjs" "$root" "$program" "$folder"
printf '%d bytes, %d with gzip -9\n' "$(cat "$folder"/* | wc -c)" "$(for file in "$folder"/*; do gzip -9c "$file"; done | wc -c)"
