// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Messages of libraries that know no catalogue: the runtime (lib/alembert) and toml++. Each is recognized by its
/// English text and translated with the values in it; what is not recognized stays as it is.

#include <string>

namespace alembert {

/// The message in the language of the reader. English is given back unchanged.
std::string translated_from_library(const std::string& message);

/// The same for a message of toml++, whose values are words such as "table" and parts of the file.
std::string translated_from_toml(const std::string& message);

}  // namespace alembert
