// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A constraint, or the gap of a unilateral one, as a row of the equations of motion:
/// f(q,t) = 0 gives ∂f/∂q·q' + ∂f/∂t = 0, a(q,t)·q' + b(q,t) = 0 is one already; differentiated once more,
/// row·q'' = acceleration (Zhang & Qin, §1.6).

#include "model/mechanism.hpp"

namespace alembert {

/// What is zero, by the name of the one who asks for it.
struct Rule {
    std::string name;
    bool holonomic = true;
    GiNaC::ex value;
    GiNaC::symbol multiplier;
    Place place;         ///< of the name
    Place at;            ///< of the expression, for messages
    bool drifts = true;  ///< false: a nonholonomic value is known to vanish with the rates
};

/// Throws SceneMistake for a value that is not linear in the rates, or in which no coordinate (holonomic) or rate
/// (nonholonomic) is left.
Mechanism::Constraint constraint_of(const Rule& rule, const Mechanism& mechanism);

/// Coefficients of the rates, and what stands beside them: value = row·q' + drift. Throws SceneMistake, beginning
/// with `what` ("speed 'v'") and ending with `advice`, where it is not linear.
std::pair<std::vector<GiNaC::ex>, GiNaC::ex> linear_form(const GiNaC::ex& value, const std::string& what, Place at,
                                                         const Mechanism& mechanism,
                                                         const std::string& advice = "");

bool all_zero(const std::vector<GiNaC::ex>& row);

}  // namespace alembert
