// SPDX-License-Identifier: MIT
#pragma once

/// Like program.hpp, for tests of descriptors, signals and folders.

#include "program.hpp"

namespace alembert::test {

/// `sh -c SCRIPT`, where "$ALEMBERT" is the program and "$1" … are the arguments.
Run run_shell(const std::string& script, const std::vector<std::string>& args = {});

/// The same on a terminal of so many columns; returns what it shows of standard output and standard error.
std::string on_terminal(const std::string& script, const std::vector<std::string>& args, int columns);

/// An empty folder of that name in the temporary folder of this test process.
std::string temporary_folder(const std::string& name);

}  // namespace alembert::test
