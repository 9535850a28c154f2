// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What an emitted function is made of, from the writer to the template: nobody has to read C++ to know what a
/// statement does.
///
///     CodeStatement{.names = {"z1"}, .uses = {"m1", "sin_theta"}, .cost = 1, .text = "const Real z1 = m1 *
///     sin_theta;"}

#include <set>
#include <string>
#include <vector>

namespace alembert {

/// What a file is written in. C is C99 with `Real` for double, so that one text of an expression serves both.
enum class CodeLanguage { cpp, c };

struct CodeStatement {
    std::vector<std::string> names = {};  ///< that it declares, each a Real
    std::set<std::string> uses = {};      ///< names that its values are made of
    int cost = 0;                         ///< operations
    std::string text;                     ///< may have several lines
};

/// Statements under a title, in the order in which a lecturer would write them.
struct Passage {
    std::string title;
    std::vector<CodeStatement> statements = {};
    std::vector<std::string> notes = {};  ///< what the title promises and no statement computes: "M11 = A"
};

/// One thing that a function computes: a node, and what its variable is to be called if it gets one.
struct Goal {
    std::string section, name;
    int node;
    bool own_name = false;     ///< `name` is taken by the caller, for this
    bool is_negative = false;  ///< it is the node times −1: `name` is that of the negative
    bool is_noted = false;     ///< where no variable gets its name, a note says what it is
    bool is_computed = true;   ///< else it is there for its note alone
};

}  // namespace alembert
