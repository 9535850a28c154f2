// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Finds out why a computation fails: which combination of rates has no inertia, or which term of which body is
/// not finite.

#include <optional>
#include <string>
#include <vector>

#include "program/interpret.hpp"

namespace alembert {

/// The combination of rates without kinetic energy, as "theta1' - theta2'", that the constraints allow at this
/// state, if there is one to working precision: the smallest eigenvalue of the mass matrix along the rates
/// allowed, scaled to a unit diagonal, is below 1e-13 of the largest entry (Higham, Accuracy and Stability of
/// Numerical Algorithms (2002), §7.3 on such scaling). Rates without kinetic energy do not matter if the
/// constraints determine them from the others, because the matrix of the equations with their constraints is then
/// regular (a massless pulley on two ropes).
std::optional<std::string> massless_combination(const Program& program, const State<double>& state);

/// Constraints whose rows are dependent at this state, although the constraints `kept` (by index) are independent
/// elsewhere, as for a linkage that lies flat. "constraint 'x' has no row left …" or "the rows of constraints 'x',
/// 'y' become dependent …". Rows are measured relative to the largest; a singular value of A below 1e-7 counts as
/// zero. Rows that are tied to these (program/tie.hpp) count with them.
std::optional<std::string> lost_rank(const Program& program, const State<double>& state,
                                     const std::vector<int>& kept);

/// Whether A has lost rank but for rounding (a singular value below 1e-12, as of sin π): accelerations may then be
/// finite, and say nothing.
bool is_rank_rounding(const Program& program, const State<double>& state, const std::vector<int>& kept);

/// Which table a computation of `group` has left, or is about to leave, whose points say no more.
std::optional<std::string> ended_table(const Program& program, const State<double>& state, Group group);

struct NotFinite {
    std::string text;          ///< what it is, and the part from which it comes: "a division by zero in spring 1"
    bool is_division = false;  ///< by zero
    std::vector<std::string> parts = {};  ///< labels of the parts of the mechanism in `text` (origin.hpp)
};

/// The first value that is not finite in the computation of `group`.
std::optional<NotFinite> not_finite(const Program& program, const State<double>& state, Group group);

}  // namespace alembert
