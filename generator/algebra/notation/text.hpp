// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A formula in the expression language of a scene, so that it can be copied into a claim.
///
///     (m1+m2)*l1*theta1'' + m2*l2*theta2''*cos(theta1-theta2)

#include <string>

#include "algebra/notation/phrase.hpp"

namespace alembert {

/// There are blanks around the signs of the outermost sum only.
std::string text(const Phrase& phrase);

/// The scene language's name of a function of GiNaC.
std::string language_name(const std::string& function);

}  // namespace alembert
