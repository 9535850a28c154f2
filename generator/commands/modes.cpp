// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/modes.hpp"

#include <algorithm>
#include <iterator>

#include "commands/values.hpp"

namespace alembert {

namespace {

constexpr VerbMode all_modes[] = {{"check", "--formalisms", "agree", nullptr},
                                  {"eval", "--kinematics", "kinematics", nullptr},
                                  {"eval", "--inertia", "inertia", nullptr},
                                  {"eval", "--identify", "identify", nullptr},
                                  {"eval", "--inverse", "inverse", nullptr},
                                  {"eval", "--impact", "impact", nullptr},
                                  {"stability", "--matrices", "linearize", nullptr},
                                  {"emit", "--fmu", "fmu", values::file},
                                  {"report", "--watch", "watch", nullptr},
                                  {"", "--completion", "completion", values::shell},
                                  {"", "--man", "man", values::verb}};

/// "--fmu" for "--fmu=FILE".
std::string_view name_in(std::string_view word) {
    return word.substr(0, word.find('='));
}

}  // namespace

std::vector<VerbMode> modes_of(std::string_view verb) {
    std::vector<VerbMode> modes;
    std::copy_if(std::begin(all_modes), std::end(all_modes), std::back_inserter(modes),
                 [&](const VerbMode& mode) { return mode.verb == verb; });
    return modes;
}

const VerbMode* mode_that_was(std::string_view earlier) {
    const auto found = std::find_if(std::begin(all_modes), std::end(all_modes),
                                    [&](const VerbMode& mode) { return mode.earlier == earlier; });
    return found == std::end(all_modes) ? nullptr : &*found;
}

std::string title_of(const std::string& verb) {
    const VerbMode* const mode = mode_that_was(verb);
    if (mode == nullptr) return verb;
    return std::string(mode->verb) + (*mode->verb == '\0' ? "" : " ") + mode->option;
}

void choose_mode(std::vector<std::string>& words) {
    if (words.empty()) return;
    for (const VerbMode& mode : modes_of(""))
        if (name_in(words[0]) == mode.option) {
            const std::size_t equals = words[0].find('=');
            if (equals != std::string::npos) words.insert(words.begin() + 1, words[0].substr(equals + 1));
            words[0] = mode.earlier;
            return;
        }
    const auto end = std::find(words.begin(), words.end(), "--");
    for (const VerbMode& mode : modes_of(words[0]))
        if (const auto named = std::find_if(words.begin(), end,
                                            [&](const std::string& word) { return name_in(word) == mode.option; });
            named != end) {
            words[0] = mode.earlier;
            const bool asks_for_help = named + 1 != end && (named[1] == "--help" || named[1] == "-h");
            if (mode.kind != nullptr && asks_for_help) words.erase(named);  // of which it is no value
            return;
        }
}

}  // namespace alembert
