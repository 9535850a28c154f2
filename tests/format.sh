#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Every C++ file stands as .clang-format writes it (lines of at most 115 columns).
#   format.sh          names those that do not (exit code 77, skipped, where clang-format is not installed; a failure
#                      where test.sh has installed it)
#   format.sh --fix    rewrites them
# Other versions of clang-format break lines at other places, so that only version 14, Debian 12's, is taken.
set -eu
cd "$(dirname "$0")/.."
program=
for name in clang-format-14 clang-format; do
    if command -v "$name" >/dev/null && "$name" --version | grep -q 'version 14\.'; then
        program=$name
        break
    fi
done
if [ -z "$program" ]; then
    echo "clang-format 14 is not installed: the format was not checked"
    exit "${ALEMBERT_NO_SKIP:-77}"
fi
files() { find lib generator tools python tests examples -name '*.[ch]pp' -print0 | sort -z; }
if [ "${1-}" = --fix ]; then
    files | xargs -0 "$program" -i
    exit
fi
if files | xargs -0 -P "$(nproc)" -n 40 "$program" --dry-run --Werror 2>&1 | grep -oE '^[^:]+' | sort -u | grep .; then
    echo "These files are not formatted; tests/format.sh --fix formats them."
    exit 1
fi
