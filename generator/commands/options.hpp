// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The options that more than one verb takes, each once: names, kind of value, description.
///
///     verb.take("--duration", wishes.duration);                         // as the table has it
///     verb.take("--svg", svg, say("picture of the branches"));          // with a description of its own

#include <string>
#include <string_view>

namespace alembert {

struct SharedOption {
    /// With commas. The first long name is shown; those after it are earlier names, which are taken silently. A
    /// "!" stands before a flag that sets false.
    const char* names;
    const char* kind;   ///< of its value (commands/values.hpp); null for a flag
    std::string about;  ///< empty where each verb has its own
    enum class Number { any, positive, nonnegative } number = Number::any;
};

/// The row of the table that has this name.
const SharedOption& shared_option(std::string_view name);

}  // namespace alembert
