// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

#include "model/formalism/link_axes.hpp"

namespace alembert {

/// The recursion from which a program is made.
struct RecursionForm {
    LinkAxes axes = LinkAxes::own;
    enum class Solve { matrix, articulated, both_ends };
    Solve solve =
        Solve::matrix;  ///< composite bodies and LDLᵀ; articulated bodies; a planar chain from both of its ends
    std::string text() const;  ///< "articulated bodies, parallel axes"
};

}  // namespace alembert
