#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Does architecture.sh see a breach? Each of these is put into a copy of the sources, where it has to fail.
set -eu
cd "$(dirname "$0")/.."
copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT
cp -r generator lib python templates generated "$copy"
mkdir "$copy/tests"
cp tests/architecture.sh "$copy/tests"
"$copy/tests/architecture.sh" >/dev/null || { echo 'the copy without a breach is refused'; exit 1; }
must_fail() { # FILE LINE
    cp "$copy/$1" "$copy/before"
    printf '%s\n' "$2" >>"$copy/$1"
    if "$copy/tests/architecture.sh" >/dev/null 2>&1; then
        echo "$2 in $1 is not seen"
        exit 1
    fi
    mv "$copy/before" "$copy/$1"
}
must_fail generator/model/mechanism.hpp '#include "simulate/simulate.hpp"'
must_fail generator/model/formalism/lagrange.cpp '#include "present/report/json.hpp"'
must_fail generator/program/program.hpp '#include <ginac/ginac.h>'
must_fail generator/codegen/emit/emit.cpp '#include "program/lower/lower.hpp"'
must_fail lib/alembert/ode/driver.hpp '#include "scene/scene.hpp"'
must_fail generator/simulate/simulate.cpp '#include "commands/show.hpp"'
must_fail generator/check/check.cpp '#include <toml++/toml.h>'
must_fail generator/check/check.hpp $'namespace alembert {\nstruct Crossing {'
must_fail generator/commands/show.cpp '#include <CLI/CLI.hpp>'
echo 'every breach is seen'
