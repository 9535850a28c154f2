// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Equations beyond the readable size: a list of definitions z1, z2 …, then short equations in them.
///
///     z1 = sin(q1)
///     z2 = l*z1 …
///     z75*q1'' + z81*q2'' - z90 = 0
///
/// Every definition uses earlier ones only. Made from a Program, whose order is the same in every run.

#include <utility>
#include <vector>

#include "formalism/equations.hpp"
#include "notation/readable.hpp"
#include "program/program.hpp"

namespace alembert {

struct IntermediateForm {
    std::vector<std::pair<Phrase, Phrase>> definitions;  ///< the symbol, and what it stands for
    std::vector<ReadableEquation> equations;
    std::vector<std::pair<Phrase, Phrase>> kinematics;  ///< q' = h, where the speeds are not the rates
    Phrase kinetic, potential;
};

/// From the groups "mass", "forcing", "kinetic" and "potential" of `program`.
IntermediateForm intermediate_form(Program program, const Mechanism& mechanism, const Equations& equations);

}  // namespace alembert
