// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Chooses the fastest program among the forms that the equations can take.
///
///     const Choice choice = choose(mechanism, {lagrange(mechanism), recursive(mechanism)});
///
/// The textbook form (Fourier normal form, grouped and factored) is short for a few bodies but has 2^k terms for k
/// angles. The form with intermediate symbols grows polynomially. The recursive equations have forms with
/// composite bodies and with articulated bodies, each along axes that turn with the links or along parallel axes.
/// All existing forms are lowered (except those along turning axes of a longer chain, which never win if there are
/// parallel axes), and those that may still win are rewritten. The number of operations and the longest chain of
/// dependent ones decide. Another form must be a tenth faster than the textbook form, because that one can be
/// read.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "program/cost.hpp"
#include "program/lower/lower.hpp"

namespace alembert {

struct RunnerUp {
    std::string formulation;
    Cost cost;
};

struct Choice {
    Program program;  ///< its `formulation` names the form
    Cost cost = {};
    std::optional<RunnerUp> runner_up;           ///< the second best
    std::shared_ptr<const JointTree> tree = {};  ///< the one from which the program is made; null if from none
};

Choice choose(const Mechanism& mechanism, const std::vector<Equations>& equations,
              const LowerOptions& options = {});
Choice choose(const Mechanism& mechanism, const Equations& equations, const LowerOptions& options = {});

/// `e` in readable form, without intermediate symbols; nothing if that would have more than `budget` terms.
std::optional<GiNaC::ex> readable_form(const GiNaC::ex& e, const Mechanism& mechanism, std::size_t budget = 400);

}  // namespace alembert
