#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Compares the program as WebAssembly (web/build.sh) with the native one, in Node and in headless Chromium: every verb
# that needs no operating system, on all textbook scenes (web/compare.mjs says what must be the same).
#   web/test.sh [PROGRAM [OPTION...]]     PROGRAM: build/release/generator/alembert where none is named
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
program=${1:-$root/build/release/generator/alembert}
[ $# -eq 0 ] || shift
for tool in node chromium; do
  command -v "$tool" >/dev/null || { echo "there is no $tool here"; exit 5; }
done
for file in "$program" "$root/build/web/alembert.wasm"; do
  [ -e "$file" ] || { echo "there is no $file: build it first"; exit 5; }
done
node "$root/web/small.mjs" "$root/build/web"
[ $# -gt 0 ] || set -- --chromium
node "$root/web/compare.mjs" "$program" "$root/build/web" "$@"
# The playground and the package, where they have been made (web/playground.sh, web/package.sh).
[ ! -d "$root/build/web/playground" ] || python3 "$root/web/test_playground.py"
[ ! -e "$root"/build/web/alembert-*.tgz ] || "$root/web/test_package.sh"
