// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What the numbers of a table leave of a claim that holds: they are doubles, so that 0.1 + 0.15 x through points
/// has a rounding that the claim has not.
///
///     if (TableRounding(told).explains(program, root, state, residual)) …     // this state refutes nothing

#include "check/counterexample.hpp"

namespace alembert {

class TableRounding {
public:
    explicit TableRounding(const Told& told);

    /// Whether the rounding of tables may be all that is left at the node, which is zero where the claim holds.
    bool explains(const Program& program, int root, const RealState& state, const GiNaC::numeric& residual) const;

private:
    bool in_equations_ = false;  ///< states have accelerations by tables
};

}  // namespace alembert
