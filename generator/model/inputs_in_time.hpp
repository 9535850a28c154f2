// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The values that a scene gives its inputs, with their derivatives.

#include "model/mechanism.hpp"

namespace alembert {

/// Each input and its derivatives, as functions of t and the parameters.
GiNaC::exmap inputs_in_time(const Mechanism& mechanism);

}  // namespace alembert
