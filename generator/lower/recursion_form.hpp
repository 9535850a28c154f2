// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

#include "formalism/link_axes.hpp"

namespace alembert {

/// Which of the recursions a program is made by.
struct RecursionForm {
    LinkAxes axes = LinkAxes::own;
    bool articulated = false;  ///< else composite bodies and LDLᵀ
    std::string text() const;  ///< "articulated bodies, parallel axes"
};

}  // namespace alembert
