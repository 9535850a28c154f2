// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The formalism that the program takes for what it needs, where nobody has named one.
///
///     const Equations equations = formalism_for(Need::multipliers).derive(mechanism);
///     derived_again(d, mechanism, formalism_for(Need::minimal_speeds).name);
///     formalism_in_rates(mechanism).name;      // "lagrange", or with constraints "routh"

#include "model/formalism/formalisms.hpp"

namespace alembert {

enum class Need {
    independent,     ///< the equations of a textbook for independent coordinates
    multipliers,     ///< coordinates and their rates, with a multiplier for each constraint
    minimal_speeds,  ///< as few speeds as nonholonomic constraints leave, and multipliers for the others alone
    fastest          ///< the fewest operations, where bodies form a tree of joints
};

const Formalism& formalism_for(Need need);

/// Whether these are the equations that `formalism_for(need)` gives for the mechanism, perhaps by another name.
bool serves(const Equations& equations, Need need, const Mechanism& mechanism);

/// The unknowns are rates of the coordinates: independent coordinates, or multipliers if there are constraints.
const Formalism& formalism_in_rates(const Mechanism& mechanism);

}  // namespace alembert
