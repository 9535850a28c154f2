// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Where results leave the program: standard output, standard error, files.

#include <string>
#include <vector>

#include "report/json.hpp"

namespace alembert {

/// Prints one JSON object, or text for a person.
void show(const Json& result);
void show(const std::string& text);

/// Prints each warning to standard error.
void warn(const std::vector<std::string>& warnings);

/// Writes beside and renames. Throws CompileError (the environment failed) with the reason.
void write_file(const std::string& path, const std::string& text);

}  // namespace alembert
