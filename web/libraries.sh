#!/bin/bash
# Compiles CLN and GiNaC, from Debian's source packages, for WebAssembly.
#   web/libraries.sh SOURCES TO      SOURCES: the folder with the unpacked packages; TO: gets include/ and lib/
# Their own `configure` starts the compiler 600 times and measures this machine in place of the target, so the few
# answers that matter are written here. The standard library's headers are read once and not 900 times, which takes
# five sixths of the time that a file takes otherwise.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
sources=$(cd "$1" && pwd)
mkdir -p "$2"
to=$(cd "$2" && pwd)
clang=$(em-config LLVM_ROOT)/clang++-$(em-config CLANG_ADD_VERSION)  # the one that em++ calls
flags=($(em++ --cflags | sed 's/-fignore-exceptions//') -fwasm-exceptions -O2 -w)
jobs=${JOBS:-$(nproc)}

# The headers that both libraries and their users begin with.
standard=$to/standard
printf '#include <%s>\n' algorithm cmath cstddef cstdint cstdlib cstring cstdio functional iomanip iostream limits \
  list map memory set sstream stdexcept string utility vector > "$standard.hpp"
"$clang" "${flags[@]}" -x c++-header "$standard.hpp" -o "$standard.pch"

# compile FOLDER FLAG... < LIST of sources: objects in FOLDER
compile() {
  local folder=$1
  shift
  rm -rf "$folder"
  mkdir -p "$folder"
  (cd "$folder" && xargs -n 8 -P "$jobs" "$clang" "${flags[@]}" -include-pch "$standard.pch" "$@" -c)
}

# archive FILE FOLDER
archive() {
  rm -f "$1"
  (cd "$2" && emar rcs "$1" *.o)
}

cln() {
  local from
  from=$(echo "$sources"/cln-*)
  local own=$to/cln
  rm -rf "$own"
  mkdir -p "$own"
  for file in cl_config.h cl_base_config.h cl_gmpconfig.h; do
    printf '%s\n' '#include "cln/config.h"' '#define CL_HAVE_ATTRIBUTE_FLATTEN' > "$own/$file"
  done
  printf '%s\n' '#define HAVE_GETTIMEOFDAY' '#define GETTIMEOFDAY_TZP_T void*' >> "$own/cl_base_config.h"
  mkdir -p "$own/base" && mv "$own"/cl_base_config.h "$own"/cl_gmpconfig.h "$own/base"
  # A variable of a namespace with C's linkage is declared in a block, and defined outside: clang wants both the same.
  sed -i -E 's/^(uint64 (divu_64_rest|mulu64_high);)/extern "C" { \1 }/' "$from/src/base/low/cl_low_div.cc" "$from/src/base/low/cl_low_mul.cc"
  # All that the library consists of, but the clock, which asks for the system's.
  sed -n '/^libcln_la_SOURCES/,/^$/p' "$from/src/Makefile.am" | grep -oE '[a-zA-Z0-9_/-]+\.cc' | grep -v ^timing/ |
    sed "s,^,$from/src/," | compile "$own/objects" -DNO_ASM -I "$to/include" -I "$own" -I "$from/src"
  archive "$to/lib/libcln.a" "$own/objects"
}

ginac() {
  local from
  from=$(echo "$sources"/ginac-*)
  local own=$to/ginac
  rm -rf "$own"
  mkdir -p "$own"
  sed -nE "s/^PACKAGE_VERSION='(.*)'/#define PACKAGE_VERSION \"\1\"/p" "$from/configure" > "$own/config.h"
  ls "$from"/ginac/*.cpp "$from"/ginac/parser/*.cpp "$from"/ginac/polynomial/*.cpp | grep -vE '/(excompiler_.*)$' |
    compile "$own/objects" -DHAVE_CONFIG_H -DIN_GINAC -I "$own" -I "$to/include" -I "$from/ginac" -I "$from"
  archive "$to/lib/libginac.a" "$own/objects"
}

mkdir -p "$to/lib"
"$here/headers.sh" "$to" "$sources"/cln-*/include/cln "$sources"/ginac-*/ginac{,/parser}
cln
ginac
