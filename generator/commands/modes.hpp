// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Questions that a verb answers by an option, each of which was a verb of its own before: `eval SCENE --inverse`
/// was `inverse SCENE`. Both names lead to the same; the earlier ones are not listed.
///
///     std::vector<std::string> words = {"eval", "pendulum.toml", "--inverse"};
///     choose_mode(words);                                        // {"inverse", "pendulum.toml", "--inverse"}
///     title_of("inverse");                                       // "eval --inverse"

#include <string>
#include <string_view>
#include <vector>

namespace alembert {

struct VerbMode {
    const char* verb;  ///< empty for the program
    const char* option;
    const char* earlier;
    const char* kind;  ///< of the option's value (commands/values.hpp); null for a flag
};

/// Of one verb, or with an empty name those of the program.
std::vector<VerbMode> modes_of(std::string_view verb);

/// The mode that was a verb of this name; null if there is none.
const VerbMode* mode_that_was(std::string_view earlier);

/// What the verb of this name is called now: "eval --inverse" for "inverse", "derive" for "derive".
std::string title_of(const std::string& verb);

/// Puts the earlier verb in the place of the verb if the words name a mode.
void choose_mode(std::vector<std::string>& words);

}  // namespace alembert
