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
};

/// Nothing if the phrase is no such call. It points into the phrase.
std::optional<UnspecifiedPhrase> unspecified_phrase(const Phrase& phrase);

}  // namespace alembert
