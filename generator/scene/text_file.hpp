// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The whole text of a file that a user named.

#include <string>

namespace alembert {

/// Throws SceneError for a file that is missing, a directory, unreadable, or larger than 1 MiB.
std::string text_of_file(const std::string& file);

}  // namespace alembert
