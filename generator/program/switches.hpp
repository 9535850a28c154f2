// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A program in which sign, |·|, min and max have become smooth: the sign of what they look at is a parameter of
/// its own, +1 or −1, that a run holds until that function is zero (alembert/switching.hpp).
///
///     if (const auto s = switched(program)) …        // nothing where the program has none of them
///     s->program.parameters.back().name;             // "side_1", after the scene's parameters
///
/// With σ for the sign of g:   sign g → σ,   |g| → σ g,   max(a, b) → (a + b)/2 + σ (a − b)/2 with g = a − b, and
/// min with −σ. A function of parameters alone stays as it is. The events of the program are followed by g_1 … g_K
/// and then by ġ_1 … ġ_K, for the rates that events are given: ġ = ∂g/∂t + Σ ∂g/∂q q' + Σ ∂g/∂u u'. With dry
/// friction two numbers more follow for each σ, 1 where it has none: the bounds of |σ| while it sticks, and what
/// must not become negative, the normal force, or its determinant (Group::determinant).

#include <optional>
#include <vector>

#include "program/program.hpp"

namespace alembert {

struct Switched {
    Program program;
    std::vector<int> functions;  ///< nodes of the original program with sign, |·|, min or max, one for each σ
    /// A dry friction (Group::slip) whose sliding velocity has the sign σ, or −σ.
    struct Rubbing {
        int friction;
        int direction;
    };
    std::vector<std::vector<Rubbing>> frictions = {};  ///< of each σ
    bool has_frictions() const;
};

/// Nothing too where some g contains accelerations, or a derivative of it would be longer than the program.
std::optional<Switched> switched(const Program& program);

}  // namespace alembert
