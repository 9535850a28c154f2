// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Words of other programs and what they are called here. Words are in small letters, without what separates their
/// parts (`bare` of scene/advice.hpp).
///
///     verb_meant_by("animate");     // "report --watch"
///     option_meant_by("rtol");      // "--tolerance"

#include <string_view>

namespace alembert {

/// Verb and option, or an option of the program; empty for an unknown word.
std::string_view verb_meant_by(std::string_view word);

/// Empty for an unknown word.
std::string_view option_meant_by(std::string_view word);

}  // namespace alembert
