// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Names of files that mean something else where emitted code is used.
///
///     is_taken_file_name("math", CodeLanguage::c)     // true: the compiler's math.h includes files beside it

#include <string>

#include "codegen/emit/statement.hpp"

namespace alembert {

bool is_taken_file_name(const std::string& name, CodeLanguage language);

}  // namespace alembert
