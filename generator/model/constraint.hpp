// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A constraint, or the gap of a unilateral contact, as a row of the equations of motion. f(q,t) = 0 gives the row
/// ∂f/∂q·q' + ∂f/∂t = 0, and a(q,t)·q' + b(q,t) = 0 is a row already; differentiated once more, row·q'' =
/// acceleration (Zhang & Qin, §1.6).

#include "model/mechanism.hpp"

namespace alembert {

/// An expression that is required to be zero, and the name of what requires it.
struct Rule {
    std::string name;
    bool holonomic = true;
    GiNaC::ex value;
    GiNaC::symbol multiplier;
    Place place;         ///< the place of the name
    Place at;            ///< the place of the expression, for messages
    bool drifts = true;  ///< if false, a nonholonomic value is known to vanish with the rates
};

/// Throws SceneMistake for a value that is not linear in the rates, or that contains no coordinate (holonomic) or
/// no rate (nonholonomic).
Mechanism::Constraint constraint_of(const Rule& rule, const Mechanism& mechanism);

/// The coefficients of the rates and the rest: value = row·q' + offset. Throws SceneMistake, whose message begins
/// with `what` ("speed 'v'") and ends with `advice`, if the value is not linear in the rates.
std::pair<std::vector<GiNaC::ex>, GiNaC::ex> linear_form(const GiNaC::ex& value, const std::string& what, Place at,
                                                         const Mechanism& mechanism,
                                                         const std::string& advice = "");

bool all_zero(const std::vector<GiNaC::ex>& row);

}  // namespace alembert
