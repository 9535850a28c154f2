// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// How a call of a function of [functions] is written (algebra/symbolic/unspecified.hpp): V(r), dV/dr, f''(x − c),
/// ∂²f/∂x∂y.

#include <optional>
#include <string>
#include <vector>

#include "algebra/notation/phrase.hpp"

namespace alembert {

struct UnspecifiedPhrase {
    const Phrase* function;
    std::vector<const Phrase*> arguments;
    std::vector<int> orders;  ///< how often is differentiated by each argument
    int order = 0;            ///< their sum
    /// Whether every argument by which is differentiated is a symbol that no other argument holds, so that dV/dr
    /// and ∂f/∂x can be meant in one way only.
    bool by_symbols = true;
    /// Whether no argument by which is differentiated stands twice.
    bool by_different = true;

    /// Whether the argument by which is differentiated is written as it is, and not as its number.
    bool is_by_itself(std::size_t argument) const {
        const Phrase& by = *arguments[argument];
        return by_symbols || (by_different && by.kind != Phrase::Kind::symbol && by.kind != Phrase::Kind::number);
    }
};

/// Nothing if the phrase is no such call. It points into the phrase.
std::optional<UnspecifiedPhrase> unspecified_phrase(const Phrase& phrase);

}  // namespace alembert
