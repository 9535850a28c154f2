#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Does architecture.sh see a breach? Each of these is put into a copy of the sources, where it has to fail.
set -eu
cd "$(dirname "$0")/.."
copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT
cp -r generator lib python templates generated "$copy"
mkdir "$copy/tests"
cp tests/architecture.sh tests/measures.py "$copy/tests"
"$copy/tests/architecture.sh" >/dev/null || { echo 'the copy without a breach is refused'; exit 1; }
passes_with() { # FILE LINES
    cp "$copy/$1" "$copy/before"
    printf '%s\n' "$2" >>"$copy/$1"
    local seen=0
    "$copy/tests/architecture.sh" >/dev/null 2>&1 || seen=1
    mv "$copy/before" "$copy/$1"
    return "$seen"
}
must_fail() {
    passes_with "$@" || return 0
    echo "$2 in $1 is not seen"
    exit 1
}
must_pass() {
    passes_with "$@" && return
    echo "$2 in $1 is refused"
    exit 1
}
lines() { for ((i = 0; i < $1; ++i)); do echo '    // one more'; done; }
must_fail generator/model/mechanism.hpp '#include "simulate/simulate.hpp"'
must_fail generator/model/formalism/lagrange.cpp '#include "present/report/json.hpp"'
must_fail generator/program/program.hpp '#include <ginac/ginac.h>'
must_fail generator/codegen/emit/emit.cpp '#include "program/lower/lower.hpp"'
must_fail lib/alembert/ode/driver.hpp '#include "scene/scene.hpp"'
must_fail generator/simulate/simulate.cpp '#include "commands/show.hpp"'
must_fail generator/check/check.cpp '#include <toml++/toml.h>'
must_fail generator/check/check.hpp $'namespace alembert {\nstruct Crossing {'
must_fail generator/commands/show.cpp '#include <CLI/CLI.hpp>'
must_fail lib/alembert/ode/radau_table.cpp "int long_function(int n) {
$(lines 79)
}"
must_fail generator/check/check.hpp "inline constexpr auto long_lambda = [](int n) {
$(lines 79)
};"
must_fail python/system.cpp 'namespace { void wide(int a, int b, int c, int d, int e, int f, int g) {} }'
must_fail generator/check/check.cpp "$(lines 700)"
# None of these is too long or takes more than six parameters.
must_pass generator/check/check.hpp "namespace alembert {
template <typename A, typename B, typename C, typename D, typename E, typename F, typename G>
class Long : public std::vector<std::map<int, int>> {
    Long(int a, std::map<int, int> b = {{1, 2}, {3, 4}}) : a_(a), b_{a, a, a, a, a, a, a} {
$(lines 78)
    }
    // void wide(int a, int b, int c, int d, int e, int f, int g) {
    const char* text = R\"(void wide(int a, int b, int c, int d, int e, int f, int g) {)\";
$(lines 80)
};
}"
echo 'every breach is seen'
