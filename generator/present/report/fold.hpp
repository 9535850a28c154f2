// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Shortens long lists for people.
///
///     show(verb.full ? text : folded(text));

#include <string>
#include <string_view>

namespace alembert {

/// A text of at most about two screens. Where it is longer, long paragraphs keep their first lines and their last,
/// then paragraphs before the last one are left out; in each place it is told how many lines are missing, and at
/// the end how to get them. A text of up to two screens, in rows of 100 columns, is not changed.
std::string folded(std::string_view text);

}  // namespace alembert
