// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

namespace alembert {

/// The program or the shared library (the module of Python, for one) in which this code is.
std::filesystem::path own_file();

}  // namespace alembert
