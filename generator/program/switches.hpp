// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Makes a program in which sign, |·|, min and max are smooth. The sign of the function on which each depends
/// becomes a parameter, +1 or −1, which a run keeps constant until that function is zero
/// (alembert/hybrid/filippov_system.hpp).
///
///     if (const auto s = switched(program)) …        // nothing where the program has none of them
///     s->program.parameters.back().name;             // "side_1", after the scene's parameters
///
/// With σ for the sign of g: sign g → σ, |g| → σ g, max(a, b) → (a + b)/2 + σ (a − b)/2 with g = a − b, and min
/// with −σ. A function of parameters only is not changed. The events of the program are followed by g_1 … g_K and
/// then by ġ_1 … ġ_K, for the rates that events are given: ġ = ∂g/∂t + Σ ∂g/∂q q' + Σ ∂g/∂u u'. Where they are
/// wanted and some g depend on positions alone, g̈_1 … g̈_K follow, in the same way. With dry friction two further
/// numbers follow for each σ: the bound of |σ| while the contact sticks, and a number that must not become
/// negative, the normal force or its determinant (Group::determinant). Both are 1 for a σ without friction.

#include <optional>
#include <vector>

#include "program/program.hpp"

namespace alembert {

struct Switched {
    Program program;
    /// Nodes of the original program with sign, |·|, min or max, one for each σ; before them the components of
    /// sliding velocities in planes, whose σ are parameters of that program already, after a mode and δ for each
    /// pair (model/friction.hpp).
    std::vector<int> functions;
    int pairs = 0;  ///< of sliding velocities in planes
    /// A dry friction (Group::sliding_velocity) whose sliding velocity has the sign σ, or −σ.
    struct Rubbing {
        int friction;
        int direction;
    };
    std::vector<std::vector<Rubbing>> frictions = {};  ///< for each σ
    bool has_frictions() const;
    /// Which g depend on positions and time alone, so that σ changes g̈ and not ġ. If it is empty, there are no g̈;
    /// otherwise g̈ is 0 for the other g.
    std::vector<bool> positional = {};
    /// The number of events that follow those of the scene.
    std::size_t events() const;
    /// How many of them are bounds and normal forces, which come last.
    std::size_t bounds() const { return has_frictions() ? 2 * functions.size() : 0; }
    /// The number of parameters at the end of the program's that a run holds.
    int held() const { return 2 * pairs + static_cast<int>(functions.size()); }
};

enum class SecondRates { left_out, wanted };

/// Nothing if there is no such function, if some g contains accelerations, or if a derivative of a g would be
/// longer than the program. There are second rates only if they are wanted, some g depend on positions alone, and
/// their g̈ are not too long.
std::optional<Switched> switched(const Program& program, SecondRates second = SecondRates::left_out);

/// Whether rates jump where the motion comes to a place, by a sign, a quotient such as x/|x|, or a derivative of a
/// table at its knots: there derivatives by where the motion began jump too. A jump at a time that is fixed does
/// not count, and it is fixed if none of these parameters moves it.
bool jumps_along_motion(const Program& program, const std::vector<int>& parameters = {});

}  // namespace alembert
