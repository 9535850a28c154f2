// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The solution of linear equations as a textbook prints it: one quotient, or a sum of quotients where that is
/// shorter.
///
///     (e−3·cos²α)·v/(1+3·cos²α),   3·S·h/(2·l) − S
///
/// Numerator and denominator are in lowest terms and factored; angles are written as in `readable`.

#include <functional>
#include <optional>

#include "algebra/notation/phrase.hpp"

namespace alembert {

/// `number` gives the value of an expression at the scene's numbers; the denominator is written so that it is
/// positive there. The result is empty if a part has more than `most_terms` terms.
std::optional<Phrase> readable_quotient(const GiNaC::ex& e, const Symbols& symbols, std::size_t most_terms,
                                        const std::function<double(const GiNaC::ex&)>& number);

}  // namespace alembert
