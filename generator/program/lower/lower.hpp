// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Converts equations to straight-line code. This is the last place that uses GiNaC.
///
///     const Program program = lower(mechanism, equations, energy_of(mechanism));
///     program.nodes_of(Group::acceleration);
///
/// The groups of roots are those of program.hpp: mass and forcing, unless the equations have no M; accelerations,
/// energies, outputs and events; for constraints rows, positions, velocities, gamma, multipliers, and a step of
/// the projection (project.hpp); for a scene with speeds these and their rates. Where the speeds are not the
/// rates, `Program::speeds` names them, variables of kind `rate` and `acceleration` are u and u', and there are
/// roots for q', q'' and A in speeds. So it is in a scene with first-order states, which stand behind the speeds
/// (model/formalism/with_states.hpp).

#include <functional>

#include "model/energy.hpp"
#include "model/formalism/equations.hpp"
#include "program/lower/recursion_form.hpp"
#include "program/lower/start.hpp"
#include "program/program.hpp"

namespace alembert {

struct LowerOptions {
    bool fold = false;  ///< whether parameters become constants with the scene's values
    /// Whether the equations are in their readable form, whose order of terms is to be kept.
    bool is_textbook = false;
    /// Whether the reactions that press where friction acts stay letters in f, as a reader wants to see them:
    /// variables of kind `unknown`, each numbered by the first friction in Mechanism::frictions that has it. If
    /// there are any, the program has no accelerations.
    bool reactions_are_letters = false;
    /// Whether the first-order states of the scene are given numbers, as for a reader or for a comparison of
    /// equations of motion: variables of kind `rate` behind those of q'. Else they are part of the state.
    bool states_are_given = false;
    std::optional<RecursionForm> recursion =
        {};  ///< for equations with a tree: M, f and q'' by this recursion instead of by their expressions
    /// Gives a state that obeys the constraints (analysis/state/assemble.hpp). It is asked for where coordinates
    /// have no mass, so that the constraints give their pivots: none that vanishes there is taken. Without it
    /// pivots are judged by their structure alone, and accelerations may divide by zero.
    std::function<Start()> admissible = {};
};

/// Throws ModelError if something cannot be lowered (a name that has no value).
Program lower(const Mechanism& mechanism, const Equations& equations, const Energy& energy,
              const LowerOptions& options = {});

/// Lowers only the constraints and the scene's speeds, in q and q': groups row, position, velocity, form_row and
/// speed; and alignment, for joints all of whose rows are among the mechanism's constraints.
Program lower_constraints(const Mechanism& mechanism);

/// Lowers single expressions in parameters and t into `program`, for initial values and the like.
int lower_expression(Program& program, const Mechanism& mechanism, const GiNaC::ex& e);

/// The same for several expressions, which may also contain the state. `given` are symbols that are no part of the
/// scene's state, each with its node.
std::vector<int> lower_expressions(Program& program, const Mechanism& mechanism,
                                   const std::vector<GiNaC::ex>& list,
                                   const std::vector<std::pair<GiNaC::symbol, int>>& given = {});

/// A function that does the same one expression at a time, with all intermediate symbols that define it. The
/// arguments must outlive it.
std::function<int(const GiNaC::ex&)> lowering_into(Program& program, const Mechanism& mechanism,
                                                   const std::vector<std::pair<GiNaC::symbol, int>>& given = {},
                                                   bool fold = false);

/// A program with names and parameters, but without nodes.
Program begun(const Mechanism& mechanism, bool fold = false);

}  // namespace alembert
