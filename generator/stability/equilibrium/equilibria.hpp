// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The verb `equilibrium`: the states at which a mechanism can stay at rest or move steadily.
///
///     const Equilibria found = equilibria(read_scene("scenes/textbook/rotating_hoop.toml"));
///     found.list[0].start.q, found.list[0].judgement.stable;

#include <functional>
#include <optional>
#include <string>

#include "analysis/derive/derived.hpp"
#include "stability/equilibrium/closed_form.hpp"
#include "stability/equilibrium/judge.hpp"
#include "stability/equilibrium/search.hpp"
#include "stability/interval/disc.hpp"

namespace alembert {

struct EquilibriumOptions {
    std::string by = {};  ///< a formalism; if empty, the program chooses
    Overrides at = {};
    int starts = 0;  ///< of Newton's method; if 0, by the number of coordinates and the length of the equations
    std::function<void(std::string_view, double)> progress = {};
};

/// Within which, relative to numbers above 1, a state is sought to be proved (disc.hpp).
constexpr double proved_radius = 1e-13;

/// One equilibrium or steady motion.
struct Equilibrium {
    Start start;                      ///< coordinates, angles in (−π, π]; rates
    std::vector<std::string> moving;  ///< coordinates that move: cyclic ones, and those that constraints drive
    double residual = 0;  ///< the unbalanced forces, relative to the effect of a change of all unknowns by 1
    std::optional<SteadyFamily> family = {};    ///< if it represents a continuum
    std::vector<double> multipliers;            ///< of the constraints, in the order of Equations::lambda
    StateKnown known = StateKnown::in_numbers;  ///< `exactly` where `exact` is given
    StabilityHint judgement;
    std::optional<ClosedRoot> exact = {};  ///< in the parameters
};

struct Equilibria : Derived {
    std::vector<Equilibrium> list = {};
    SteadySearch search = {};
    /// Coordinates on which nothing depends, so that they may have any value.
    std::vector<std::string> cyclic = {};
    bool closed = false;  ///< whether the equations were solved in the parameters, so that the list is complete
    std::vector<ClosedRoot> not_real = {};  ///< solutions that are not real at these parameters
    std::string nothing = {};               ///< the reason why the list is empty, and what was searched
};

/// Throws ModelError if there can be no equilibrium (an input changes with time, or a force has no counterpart) or
/// if contacts are closed at the state, and what the stages throw.
Equilibria equilibria(Scene scene, const EquilibriumOptions& options = {});

}  // namespace alembert
