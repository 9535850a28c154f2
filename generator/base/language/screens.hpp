// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// How much people read at once; more is shortened, or told with its size.
///
///     if (rows > lines_of_two_screens) …

namespace alembert {

inline constexpr int lines_of_two_screens = 100;

}  // namespace alembert
