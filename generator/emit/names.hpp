// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// C++ identifiers for the names of a scene. The compiler never sees text that a user typed, only identifiers made
/// here.

#include <map>
#include <set>
#include <string>

namespace alembert {

class Names {
public:
    /// At first the names that the emitted code itself uses, and the keywords of C++, are taken.
    Names();

    /// A new identifier like `wish`. Greek letters are spelled out, other letters beyond ASCII become u and their
    /// code point, and a `_` is added until the name is free.
    std::string fresh(const std::string& wish);

    /// prefix0, prefix1 …: the first that is free.
    std::string numbered(const std::string& prefix);

private:
    std::set<std::string> taken_;
    std::map<std::string, int> next_;
};

/// `text` with everything that is no ASCII letter, digit or `_` spelled out as above.
std::string ascii_identifier(const std::string& text);

}  // namespace alembert
