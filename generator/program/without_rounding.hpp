// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Finds values that are only rounding: those that change by as much as their own size when they are computed with
/// eleven more bits from the same state.
///
///     without_rounding(interpret(program, state), interpret(program, in_long_double(state)))

#include <cmath>

#include "program/interpret.hpp"

namespace alembert {

inline State<long double> in_long_double(const State<double>& state) {
    const auto wide = [](const std::vector<double>& list) {
        return std::vector<long double>(list.begin(), list.end());
    };
    return {.parameters = wide(state.parameters),
            .t = state.t,
            .q = wide(state.q),
            .qdot = wide(state.qdot),
            .qddot = wide(state.qddot),
            .unknown = wide(state.unknown)};
}

/// `values`, with 0 for those that are only rounding.
inline std::vector<double> without_rounding(std::vector<double> values, const std::vector<long double>& wider) {
    for (std::size_t k = 0; k < values.size(); ++k)
        if (std::abs(wider[k]) <= std::abs(values[k] - wider[k])) values[k] = 0;
    return values;
}

}  // namespace alembert
