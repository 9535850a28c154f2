// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The statements of an emitted function, from the writer to the template. Their properties are stored, so that no
/// code has to parse C++.
///
///     CodeStatement{.names = {"z1"}, .uses = {"m1", "sin_theta"}, .cost = 1, .text = "const Real z1 = m1 *
///     sin_theta;"}

#include <set>
#include <string>
#include <vector>

namespace alembert {

/// The language of a file. C is C99 with `Real` for double, so that the same text of an expression serves both;
/// how the others write it is in dialect.hpp.
enum class CodeLanguage { cpp, c, javascript, python, julia, matlab, rust, modelica };

struct CodeStatement {
    std::vector<std::string> names = {};  ///< names that it declares, each a Real
    std::set<std::string> uses = {};      ///< names that its values use
    int cost = 0;                         ///< operations
    std::string text;                     ///< the text, which may have several lines
};

/// Statements under a title, in the order in which a lecturer would write them.
struct Passage {
    std::string title;
    std::vector<CodeStatement> statements = {};
    std::vector<std::string> notes = {};  ///< values that belong to the title but need no statement: "M11 = A"
};

/// One value that a function computes: a node, and the name of its variable if it gets one.
struct Goal {
    std::string section, name;
    int node;
    bool own_name = false;     ///< whether the caller has reserved `name` for it
    bool is_negative = false;  ///< whether the value is the node times −1, and `name` the name of that
    bool is_noted = false;     ///< whether a note gives its value if no variable gets its name
    bool is_computed = true;   ///< if false, only its note is needed
};

}  // namespace alembert
