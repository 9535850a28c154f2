// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The whole text of a file that a user named.

#include <cstddef>
#include <string>

namespace alembert {

constexpr std::size_t most_scene_bytes = 1024UL * 1024;

/// Throws SceneError for a file that is missing, a directory, unreadable, or larger than that.
std::string text_of_file(const std::string& file, std::size_t largest = most_scene_bytes);

}  // namespace alembert
