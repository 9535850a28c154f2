// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A constraint f(x, y, z) = c of a function that the scene leaves open is no condition on the coordinates: the
/// function may be any, and its value c says nothing of its derivatives.

#include "model/mechanism.hpp"

namespace alembert {

/// The intermediate symbols of such calls, each with the value that its constraint gives it, in parameters.
std::vector<std::pair<GiNaC::symbol, GiNaC::ex>> held_functions(const Mechanism& mechanism);

}  // namespace alembert
