// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Lines that hold for small deviations only: sin θ ≈ θ, V ≈ m g l θ²/2, linearized equations.

#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "check/derivation/system.hpp"

namespace alembert {

/// A state about which a derivation may linearize: coordinates with their values, at rest.
struct BaseState {
    std::vector<std::pair<std::string, std::string>> values;
    std::string text;  ///< "theta = 0"
};

/// Whether these are parameters of the scene.
bool holds_letters_only(const std::set<std::string>& names, const Scene& scene);
/// Empty for a text that is none.
Expression parsed(const std::string& text);
std::vector<std::pair<std::string, Expression>> parsed(const BaseState& base);

/// All coordinates zero, and those of the scene's start if these are others.
std::vector<BaseState> base_states(const Scene& scene);

/// Whether the system may rest there: the forces vanish, as far as that shows without multipliers and inputs.
bool may_rest(const BaseState& base, const DerivedSystem& system);

/// Whether `residual`, as a function of the state alone, vanishes up to this order in the deviations from the base
/// state. `up_to_constant`: its value there does not matter.
bool is_small(const GiNaC::ex& residual, const BaseState& base, int order, bool up_to_constant,
              const DerivedSystem& system);

/// The order to which the right side of ≈ is written, and whether the left one agrees up to it.
struct WrittenOrder {
    int order = 0;
    bool agrees = true;
    GiNaC::ex left = 0;  ///< the left side to this order
};

/// Whether both sides of 1 − cos θ ≈ θ²/2 agree up to the order to which the right one is written, where the
/// coordinates `small` and their rates deviate little from the base state, and the others do as they do. Nothing
/// where the right side is no polynomial in the deviations.
std::optional<WrittenOrder> agree_to_written_order(const GiNaC::ex& left, const GiNaC::ex& right,
                                                   const BaseState& base, const std::vector<GiNaC::symbol>& small,
                                                   const DerivedSystem& system, bool up_to_constant = false);

/// The part of first order in the deviations; nothing for what is too long.
std::optional<GiNaC::ex> linear_part(const GiNaC::ex& residual, const BaseState& base,
                                     const DerivedSystem& system);

/// The same with its value at the base state.
std::optional<GiNaC::ex> part_of_first_order(const GiNaC::ex& residual, const BaseState& base,
                                             const DerivedSystem& system);

/// Whether the line holds on every motion near the state, to first order; nothing if that cannot be told (the
/// state is no equilibrium).
std::optional<CheckedClaim> checked_near(const LineClaim& line, const BaseState& base, const DerivedSystem& system,
                                         const std::map<std::string, GiNaC::ex>& known);

/// The smallest change of a line that makes it right near the state; nothing if none was found.
std::optional<Slip> slip_near(const LineClaim& line, const BaseState& base, const DerivedSystem& system,
                              const std::map<std::string, GiNaC::ex>& known);

}  // namespace alembert
