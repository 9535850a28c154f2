// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Identifiers of C++, C, JavaScript and the other languages for the names of a scene. The compiler never sees
/// text that a user typed, only identifiers made here.

#include <map>
#include <set>
#include <string>
#include <vector>

#include "codegen/emit/statement.hpp"

namespace alembert {

class Names {
public:
    /// At first the names that the emitted code itself uses are taken, and further reserved words of the language.
    explicit Names(CodeLanguage language = CodeLanguage::cpp);

    /// A new identifier like `wish`. Greek letters are spelled out, other letters beyond ASCII become u and their
    /// code point. A `_` is added to what is a keyword of C or C++ or may be a macro (reserved_words.hpp), and to
    /// a name that is not free.
    std::string fresh(const std::string& wish);

    /// prefix0, prefix1 …: the first that is free.
    std::string numbered(const std::string& prefix);

private:
    bool take(std::string& name);

    std::set<std::string> taken_;
    std::map<std::string, int> next_;
    std::size_t longest_;
};

/// `text` with everything that is no ASCII letter, digit or `_` spelled out as above.
std::string ascii_identifier(const std::string& text);

/// The identifier as tables and comments show it, which no macro can change: without the `_` of a possible macro.
std::string label_of(const std::string& identifier);
std::vector<std::string> labels_of(std::vector<std::string> identifiers);

}  // namespace alembert
