// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Converts a node of a program back to an expression, for people to read.
///
///     const auto e = expression_of(program, node, mechanism, {"lambda_rod"});
///
/// The expression is in the symbols of the program's mechanism; variables of kind `unknown` become the symbols
/// with the given names.

#include <optional>

#include "model/mechanism.hpp"
#include "program/program.hpp"

namespace alembert {

/// Nothing if the node takes more than `largest` operations when written out, or contains a function for which the
/// scene language has no name.
std::optional<GiNaC::ex> expression_of(const Program& program, int node, const Mechanism& mechanism,
                                       const std::vector<GiNaC::symbol>& unknown = {}, double largest = 500);

}  // namespace alembert
