#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Reads all sources of the program with emscripten's compiler and C++ library, and makes nothing of them. So what these
# have not is found without CLN and GiNaC, whose headers are those of Debian's packages.
#   web/read.sh [FOLDER]     build/web/read where none is named; it keeps what has been read until that changes
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
folder=${1:-$root/build/web/read}
for tool in em++ em-config cmake ninja; do
  command -v "$tool" >/dev/null || { echo "there is no $tool here"; exit "${ALEMBERT_NO_SKIP:-77}"; }
done
mkdir -p "$folder"
flags=$(em++ --cflags | sed 's/-fignore-exceptions//')
export ALEMBERT_READER="$(em-config LLVM_ROOT)/clang++-$(em-config CLANG_ADD_VERSION) $flags -fwasm-exceptions"
key=$({ cat "$root"/web/{headers,configure,read,reader}.sh "$root"/web/libraries/*; echo "$root $ALEMBERT_READER"; } | sha256sum)
if [ "$key" != "$(cat "$folder/complete" 2>/dev/null)" ]; then
  rm -rf "$folder/program" "$folder/complete"
  "$root/web/headers.sh" "$folder/root"
  "$root/web/configure.sh" "$folder/program" "$folder/root" -DCMAKE_CXX_COMPILER_LAUNCHER="$root/web/reader.sh" \
    -DCMAKE_EXPORT_COMPILE_COMMANDS=ON >"$folder/configured.log" 2>&1 ||
    { tail -n 20 "$folder/configured.log"; exit 1; }
  echo "$key" >"$folder/complete"
fi
cd "$folder/program"
cmake . >"$folder/configured.log"
mapfile -t objects < <(sed -nE 's/.* -o ([^ ]*\.o) -c .*/\1/p' compile_commands.json)
[ ${#objects[@]} -gt 30 ] || { echo "only ${#objects[@]} sources in $folder/program/compile_commands.json"; exit 1; }
cmake --build . --target "${objects[@]}" -- -k 0 >"$folder/read.log" || { grep -v '^\[' "$folder/read.log" | head -n 60; exit 1; }
echo "emscripten's compiler and library read all ${#objects[@]} sources"
