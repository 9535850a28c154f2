// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A node of a program as an expression again, for people to read.
///
///     const auto e = expression_of(program, node, mechanism, {"lambda_rod"});
///
/// In the symbols of the mechanism whose program it is; variables of kind `unknown` are the symbols given for
/// them.

#include <optional>

#include "model/mechanism.hpp"
#include "program/program.hpp"

namespace alembert {

/// Nothing for a node that takes more than `largest` operations when written out, or a function that the scene
/// language has no name for.
std::optional<GiNaC::ex> expression_of(const Program& program, int node, const Mechanism& mechanism,
                                       const std::vector<GiNaC::symbol>& unknown = {}, double largest = 500);

}  // namespace alembert
