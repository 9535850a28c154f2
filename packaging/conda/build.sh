#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# What conda-forge's recipe runs: configures, builds and installs the program into $PREFIX.
set -euo pipefail
mkdir -p headers/kainjow
cp mustache/mustache.hpp headers/kainjow
export CPLUS_INCLUDE_PATH=$PWD/headers${CPLUS_INCLUDE_PATH:+:$CPLUS_INCLUDE_PATH}
# shellcheck disable=SC2086 # CMAKE_ARGS is a list of words
cmake -G Ninja -B build ${CMAKE_ARGS-} -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=ON -DALEMBERT_TESTS=OFF \
    -DCMAKE_DISABLE_FIND_PACKAGE_pybind11=ON -DCMAKE_INSTALL_PREFIX="$PREFIX" -DCMAKE_INSTALL_LIBDIR=lib
cmake --build build
cmake --install build
