// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A claim that something is constant, such as sign(x) = C, is not proved by a derivative that is zero wherever
/// there is one: on the border of two cells it may jump.
///
///     if (const FoundJump jump = find_jump(told, motions, program, node); jump.shown) …   // where it jumps

#include <functional>

#include "analysis/exact/exact_states.hpp"
#include "check/comparison.hpp"

namespace alembert {

struct FoundJump {
    /// A state on a border, with the height of the jump as its residual.
    std::optional<Counterexample> shown = {};
    std::string border = {};  ///< "x - 1", which is zero there; empty if it is long
    bool is_unknown = false;  ///< whether a border was not reached, at which there may be a jump
};

/// Whether an expression keeps its value on every motion, so that none crosses the border where it is zero.
using IsKept = std::function<bool(const GiNaC::ex&)>;
IsKept is_kept(Comparison& now, ExactStates& states);

/// Of a node that holds coordinates, rates and the time.
FoundJump find_jump(const Told& told, const Motions& motions, const Program& program, int node,
                    const IsKept& is_kept);

}  // namespace alembert
