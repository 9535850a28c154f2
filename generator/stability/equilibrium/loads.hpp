// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The loads that are not in V, written out, and whether they have a potential too.
///
///     if (const auto Q = written_out_loads(mechanism)) have_potential(*Q, mechanism);

#include <optional>

#include "model/mechanism.hpp"

namespace alembert {

/// Of dampers too, one for each coordinate; nothing if they are too long.
std::optional<std::vector<GiNaC::ex>> written_out_loads(const Mechanism& mechanism);

/// ∂Q_i/∂q_j = ∂Q_j/∂q_i.
bool have_potential(const std::vector<GiNaC::ex>& Q, const Mechanism& mechanism);

}  // namespace alembert
