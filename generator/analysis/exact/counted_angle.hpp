// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Angles v as x = tan((v − v0)/2^(halves + 1)), with a v0 of no particular value, so that x is finite also where
/// v is half a turn.

#include "analysis/exact/real_values.hpp"
#include "program/turn.hpp"

namespace alembert {

namespace counted_angle {

constexpr int above = 1237, below = 4099;  ///< tan(v0/2^(halves + 1)) is their quotient

/// The turn by v/2^halves.
inline PrimeTurn turn_at(Prime x) {
    return PrimeTurn::rational(x) * PrimeTurn::rational(Prime(above) * Prime(below).inverse());
}

inline RealState::Angle angle_at(const GiNaC::numeric& x, int halves) {
    const GiNaC::numeric from(above, below);
    bool is_half_turn = x * from == 1;
    GiNaC::numeric tangent = is_half_turn ? GiNaC::numeric(0) : (x + from) / (1 - x * from);
    for (; halves > 0; --halves) {
        is_half_turn = tangent * tangent == 1;
        tangent = is_half_turn ? GiNaC::numeric(0) : 2 * tangent / (1 - tangent * tangent);
    }
    return {.tangent = tangent, .half_turn = is_half_turn};
}

/// x from v, in the digits that are in force.
inline GiNaC::numeric of(const GiNaC::numeric& v, int halves) {
    const GiNaC::numeric from(above, below);
    const GiNaC::numeric tangent = GiNaC::tan(v / GiNaC::pow(GiNaC::numeric(2), GiNaC::numeric(halves + 1)));
    return (tangent - from) / (1 + tangent * from);
}

}  // namespace counted_angle

}  // namespace alembert
