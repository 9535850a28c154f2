// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What a result rests on besides the equations of the scene: claims, equilibria, verdicts on stability.
///
///     {Assumption::Kind::side, "r > 0"}

#include <string>

namespace alembert {

struct Assumption {
    enum class Kind {
        side,       ///< of a root: a length is positive
        branch,     ///< of the constraints, or of a root with coordinates that depend on each other
        parameter,  ///< the sign of what consists of parameters
        pose,       ///< the one in which the scene's impulses act
        closed,     ///< these contacts are
        small,      ///< inputs, beside the deviations from a state
        stated,     ///< by the claim itself
        // Numbers about which nothing was proved:
        state,    ///< that there is an equilibrium or a steady motion at the state
        numbers,  ///< eigenvalues or energies in floating point
        family,   ///< steady motions beside this one
    };
    Kind kind;
    std::string text;
    bool is_condition = true;  ///< whether it is an inequality
};
const char* name_of(Assumption::Kind kind);

}  // namespace alembert
