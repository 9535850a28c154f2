// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The reason why the equations cannot be linearized about a state, in terms of the scene: which function of which
/// energy or load, and where.
///
///     throw ModelError(no_derivative({residuals, at, value, mechanism, equations}, {node}, "f has an infinite
///     slope"));

#include <string>
#include <vector>

#include "stability/linear/paths.hpp"

namespace alembert {

struct KinkPlace {
    const Residuals& residuals;
    const Instant<long double>& at;
    const std::vector<PuiseuxSeries>& value;  ///< of all nodes at the state
    const Mechanism& mechanism;
    const Equations& equations;
};

/// `nodes` are the functions responsible, at critical points (paths.hpp). `fault` is a sentence without its full
/// stop.
std::string no_derivative(const KinkPlace& place, const std::vector<int>& nodes, const std::string& fault);

}  // namespace alembert
