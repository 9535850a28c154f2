// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

#include "formalism/axes.hpp"

namespace alembert {

/// Which of the recursions a program is made by.
struct RecursionForm {
    Axes axes = Axes::own;
    bool articulated = false;  ///< else composite bodies and LDLᵀ
    std::string text() const;  ///< "articulated bodies, parallel axes"
};

}  // namespace alembert
