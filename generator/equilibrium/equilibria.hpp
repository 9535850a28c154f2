// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The verb `equilibrium`: where a mechanism can stay at rest, or move steadily.
///
///     const Equilibria found = equilibria(read_scene("scenes/textbook/rotating_hoop.toml"));
///     found.list[0].start.q, found.list[0].judgement.stable;

#include <functional>
#include <optional>
#include <string>

#include "derive/derived.hpp"
#include "equilibrium/closed_form.hpp"
#include "equilibrium/judge.hpp"
#include "equilibrium/search.hpp"

namespace alembert {

struct EquilibriumOptions {
    std::string by = {};  ///< a formalism; empty: the program chooses
    Overrides at = {};
    std::function<void(std::string_view, double)> progress = {};
};

/// One equilibrium or steady motion.
struct Equilibrium {
    Start start;                      ///< coordinates, angles in (−π, π]; rates
    std::vector<std::string> moving;  ///< cyclic coordinates that move
    double residual = 0;              ///< what is left of the forces, of what a change of all unknowns by 1 does
    bool isolated = true;             ///< false: it stands for a continuum
    std::vector<double> multipliers;  ///< of the constraints, in the order of Equations::lambda
    StabilityHint judgement;
    std::optional<ClosedRoot> exact = {};  ///< in the parameters
};

struct Equilibria : Derived {
    std::vector<Equilibrium> list = {};
    SteadySearch search = {};
    std::vector<std::string> cyclic = {};  ///< nothing depends on these: any value will do
    bool closed = false;                   ///< solved in the parameters: the list is complete
    std::vector<ClosedRoot> absent = {};   ///< solutions that are not real at these parameters
    std::string nothing = {};              ///< why the list is empty, and what was searched
};

/// Throws ModelError where there can be none: an input that changes with time, a force that nothing balances;
/// where contacts are closed at the state; and as the stages do.
Equilibria equilibria(Scene scene, const EquilibriumOptions& options = {});

}  // namespace alembert
