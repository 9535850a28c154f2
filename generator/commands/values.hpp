// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The values that options take, by the word for them in `--help`. Completion in shells and the lists in the
/// manual use this table.
///
///     verb.add_option("--by", options.by, "…")->type_name(values::formalism);
///     value_kind("FORMALISM")->words;                      // lagrange, kane …

#include <string>
#include <vector>

namespace alembert {

namespace values {
inline constexpr const char *scene = "SCENE", *claims = "CLAIMS", *robot = "ROBOT", *file = "FILE",
                            *folder = "DIR", *formalism = "FORMALISM", *method = "METHOD", *format = "FORMAT",
                            *seconds = "S", *number = "X", *count = "N", *assignment = "NAME=VALUE",
                            *names = "NAMES", *interval = "NAME=FROM:TO", *shell = "SHELL", *verb = "VERB",
                            *language = "LANGUAGE", *point = "POINT", *formula = "EXPRESSION", *reading = "en|zh",
                            *interface_version = "2|3", *sampling = "SAMPLING", *code = "CODE",
                            *statistics = "LIST", *name = "NAME";
}

struct ValueKind {
    enum class Files { none, any, folders, ending };
    std::string name;
    std::string plural = {};              ///< the heading of a list of all words; empty if there is none
    std::vector<std::string> words = {};  ///< all words that may be given; with a plural, others than these decide
    Files files = Files::none;
    std::string ending = {};  ///< the ending for Files::ending, without the dot
};

/// Null for a word whose values are free.
const ValueKind* value_kind(const std::string& name);

}  // namespace alembert
