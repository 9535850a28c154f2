// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A first pass over a TOML file, for mistakes that its parser reports badly or not at all: keys that are given
/// twice in a table (the parser stops at the first one and does not say where the other stands), and keys so
/// deeply nested that trees built from them would overflow the stack.

#include <map>
#include <string>
#include <vector>

#include "scene/source.hpp"

namespace alembert {

struct Layout {
    struct Statement {
        std::size_t begin, end;  ///< `key = value`, in bytes
    };
    std::string text;  ///< the file with doubled keys and their values blanked out
    std::vector<Statement> statements;
    std::map<std::string, Place> headers;  ///< where each `[name]` stands first
    std::vector<Diagnostic> mistakes;
    bool is_too_deep = false;  ///< if true, the file must not be parsed
};

/// Blanks the statement at `offset`, so that what follows can be parsed. False if there is none.
bool drop_statement(Layout& layout, std::size_t offset);

Layout survey(const SourceText& source);

}  // namespace alembert
