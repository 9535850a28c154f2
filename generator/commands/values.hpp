// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What options take, by the word that stands for it in `--help`: completion in shells and the lists in the manual
/// go by this table.
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
                            *names = "NAMES", *range = "RANGE", *interval = "NAME=FROM:TO", *shell = "SHELL",
                            *verb = "VERB", *language = "LANGUAGE", *point = "POINT", *formula = "EXPRESSION";
}

struct ValueKind {
    enum class Files { none, any, folders, ending };
    std::string name;
    std::string plural = {};              ///< what a list of all words is called; empty where there is none
    std::vector<std::string> words = {};  ///< all that may be given
    Files files = Files::none;
    std::string ending = {};  ///< of Files::ending, without the dot
};

/// Null for a word that stands for something free.
const ValueKind* value_kind(const std::string& name);

}  // namespace alembert
