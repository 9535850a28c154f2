// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The form of equations that exceed the readable size: a list of definitions z1, z2 …, then short equations in
/// them.
///
///     z1 = sin(q1)
///     z2 = l*z1 …
///     z75*q1'' + z81*q2'' - z90 = 0
///
/// Every definition uses earlier ones only. The form is made from a Program, whose order is the same in every run.

#include <utility>
#include <vector>

#include "algebra/notation/readable.hpp"
#include "model/formalism/equations.hpp"
#include "program/program.hpp"

namespace alembert {

struct IntermediateForm {
    std::vector<std::pair<Phrase, Phrase>> definitions;  ///< the symbol and its definition
    std::vector<ReadableEquation> equations;
    std::vector<std::pair<Phrase, Phrase>> kinematics;  ///< q' = h, if the speeds are not the rates
    Phrase kinetic, potential;
    std::vector<Phrase> others;
};

/// Makes the form from the groups "mass", "forcing", "kinetic" and "potential" of `program`, in which reactions
/// are letters (LowerOptions::reactions_are_letters), and of other expressions in q, q' and t.
IntermediateForm intermediate_form(Program program, const Mechanism& mechanism, const Equations& equations,
                                   const std::vector<GiNaC::ex>& others);

}  // namespace alembert
