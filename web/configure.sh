#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Configures the program as WebAssembly: web/configure.sh FOLDER ROOT [OPTION OF CMAKE...]
#   FOLDER: where it is built; ROOT: what web/headers.sh has made, with the libraries of web/libraries.sh
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
cmake -S "$root" -B "$1" -G Ninja -DCMAKE_TOOLCHAIN_FILE="$root/web/toolchain.cmake" -DALEMBERT_WEB_ROOT="$2" \
  -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=ON -DALEMBERT_TESTS=OFF \
  -DCMAKE_CXX_FLAGS="-fwasm-exceptions -w -include $root/web/standard_library.hpp" "${@:3}"
