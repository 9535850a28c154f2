// SPDX-License-Identifier: MIT
#pragma once

/// Programs in Python that use the package, for tests that compare it with the library.
///
///     if (const std::optional<std::string> printed = by_python("print(alembert.__version__)")) …

#include <doctest/doctest.h>

#include <cstdlib>
#include <optional>
#include <string>

#include "shell.hpp"
#include "tools.hpp"

namespace alembert::test {

/// What a program in Python prints that uses the package; nothing where the package was not built. CTest says
/// where it is (tests/CMakeLists.txt).
inline std::optional<std::string> by_python(const std::string& code) {
    const char *const python = std::getenv("ALEMBERT_PYTHON"), *const package = std::getenv("ALEMBERT_PACKAGE");
    const bool there = python != nullptr && package != nullptr;
    if (!(is_sanitized ? there : is_provided(there, "the Python package"))) return std::nullopt;
    const std::string script =
        temporary("script.py", "import alembert, warnings\nwarnings.simplefilter('ignore')\n" + code);
    const auto told = run_shell(R"(PYTHONPATH="$1" "$2" "$3")", {package, python, script});
    REQUIRE_MESSAGE(told.exit == 0, told.err);
    return told.out;
}

}  // namespace alembert::test
