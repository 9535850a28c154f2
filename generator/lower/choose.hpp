// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The fastest program out of the forms that the equations can take.
///
///     const Choice choice = choose(mechanism, {lagrange(mechanism), recursive(mechanism)});
///
/// The textbook's form (Fourier normal form, grouped and factored) is short for a few bodies and has 2^k terms for
/// k angles; the one with intermediate symbols grows like a polynomial; recursive equations have composite bodies
/// and articulated bodies, each along axes that turn with the links or along parallel ones. All that exist are
/// lowered (turning axes of a longer chain excepted, which never win where there are parallel ones), those that
/// may still win are rewritten; operations and the longest chain of them decide. Another form must win a tenth
/// against the textbook's, which can be read.

#include <optional>
#include <string>
#include <vector>

#include "lower/lower.hpp"
#include "program/cost.hpp"

namespace alembert {

struct RunnerUp {
    std::string formulation;
    Cost cost;
};

struct Choice {
    Program program;  ///< `formulation` says which form it is
    Cost cost = {};
    std::optional<RunnerUp> runner_up;  ///< the second best
};

Choice choose(const Mechanism& mechanism, const std::vector<Equations>& equations,
              const LowerOptions& options = {});
Choice choose(const Mechanism& mechanism, const Equations& equations, const LowerOptions& options = {});

/// `e` in readable form, without intermediate symbols; nothing where that would be larger than `budget` terms.
std::optional<GiNaC::ex> readable_form(const GiNaC::ex& e, const Mechanism& mechanism, std::size_t budget = 400);

}  // namespace alembert
