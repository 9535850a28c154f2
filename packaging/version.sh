#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Prints the version of the project, which stands in CMakeLists.txt.
set -euo pipefail
sed -nE 's/^project\(alembert VERSION ([0-9.]+).*/\1/p' "$(dirname -- "$0")/../CMakeLists.txt" | grep .
