// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The program with the fewest operations out of the forms that the equations can take.
///
/// Two forms: the textbook's (Fourier normal form, grouped and factored), which is short for a few bodies and has
/// 2^k terms for k angles, and the one with intermediate symbols, which grows like a polynomial. Both are lowered
/// where the first exists, and counted.

#include <optional>

#include "lower/lower.hpp"

namespace alembert {

struct Choice {
    Program program;                   ///< `formulation` says which form it is
    std::optional<int> runner_up;      ///< operations a right-hand side of the other form
};

Choice choose(const Mechanism& mechanism, const Equations& equations, const LowerOptions& options = {});

/// `e` in readable form, without intermediate symbols; nothing where that would be larger than `budget` terms.
std::optional<GiNaC::ex> readable_form(const GiNaC::ex& e, const Mechanism& mechanism, std::size_t budget = 400);

}  // namespace alembert
