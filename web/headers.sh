#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# The headers that the program needs of others, as they are for WebAssembly: FOLDER/include, and FOLDER/lib/pkgconfig.
#   web/headers.sh FOLDER [CLN GINAC...]      CLN: the folder with CLN's headers; GINAC: those with GiNaC's.
# Without these two they are taken from Debian's libcln-dev and libginac-dev, which is enough to read the program
# (web/read.sh); web/libraries.sh takes them from the sources that it compiles.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
mkdir -p "$1"
to=$(cd "$1" && pwd)
shift
[ $# -gt 0 ] || set -- /usr/include/cln /usr/include/ginac
rm -rf "$to/include"
mkdir -p "$to/include/ginac" "$to/lib/pkgconfig"

cln=$to/include/cln
cp -r "$1" "$cln"
shift
# What the processor is: none of those that CLN knows, so there is nothing to define.
echo > "$cln/host_cpu.h"
printf '%s\n' '#pragma once' '#include "cln/host_cpu.h"' '#include "cln/version.h"' '#define HAVE_LONGLONG' > "$cln/config.h"
cp "$here/libraries/intparam.h" "$here/libraries/floatparam.h" "$cln"
# Pointers lie at multiples of four bytes.
sed -i '0,/^#if defined(__m68k__)/s//#if defined(__wasm__)\n  #define cl_word_alignment  4\n#endif\n&/' "$cln/object.h"
# Numbers of 64 bits are calculated by the processor, and digits have 32, because no product has 128.
sed -i '0,/#define HAVE_FAST_LONGLONG/s//#define HAVE_FAST_LONGLONG\n  #elif defined(__wasm__)\n    #define HAVE_FAST_LONGLONG/' "$cln/types.h"

for folder in "$@"; do
  cp "$folder"/*.h "$to/include/ginac"
done

# Libraries of headers, the same for every processor, without the headers of Debian's C library beside them.
for name in fmt toml++ CLI nlohmann kainjow eigen3; do
  ln -sfn "/usr/include/$name" "$to/include/$name"
done

# As pkg-config describes them.
printf 'Name: cln\nDescription: numbers\nVersion: 1.3\nLibs: -L%s -lcln\nCflags: -I%s\n' "$to/lib" "$to/include" > "$to/lib/pkgconfig/cln.pc"
printf 'Name: ginac\nDescription: expressions\nVersion: 1.8\nRequires: cln\nLibs: -L%s -lginac\nCflags: -I%s\n' "$to/lib" "$to/include" \
  > "$to/lib/pkgconfig/ginac.pc"
