// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// T and V of a mechanism, without what model/energy.hpp finds out about them.

#include "model/mechanism.hpp"

namespace alembert {

/// If only a Lagrangian is given, its part of second degree in the rates, and −L at rest.
struct Energies {
    GiNaC::ex kinetic, potential;
};
Energies energies_of(const Mechanism& mechanism);

}  // namespace alembert
