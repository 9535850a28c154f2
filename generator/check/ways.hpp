// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The ways in which a question is decided and explained (decide.hpp), by the files in which they stand.

#include "check/decide.hpp"

namespace alembert {

/// first_order.cpp: the sides differ by terms of second order only near an equilibrium or a steady motion, with
/// q = q0 + ε ξ, q' = u0 + ε η and the accelerations of the equations, q'' = −ε M⁻¹(D η + P ξ). Coordinates that
/// the claim does not name may have any value; rates that it does not name, and inputs, are small.
std::optional<CheckedClaim> to_first_order(Question& q);
/// solution.cpp: a motion in closed form, x = x0*cosh(sqrt(g/l)*t), is put into the equations of motion and the
/// constraints, which must then hold at all times and for all values of the constants.
std::optional<CheckedClaim> along_a_solution(Question& q);

/// quantities.cpp: T, V, L, Q_q … mean what they do in a textbook, and leave a constant or a derivative open.
std::optional<CheckedClaim> by_its_letters(Question& q);

/// open_claims.cpp: whether some choice of the names that claims leave open satisfies them at every state.
std::optional<CheckedClaim> with_open_names(Question& q);
/// Doubts what is constant wherever it has a derivative: it may jump.
std::optional<CheckedClaim> at_jumps(Question& q);

/// in_cells.cpp: a claim in which signs decide, or in whose equations they do, is judged in every cell of its
/// sides (analysis/exact/cells.hpp): it is proved if it holds in all of them that have states, and refuted by a
/// state in one of them.
std::optional<CheckedClaim> in_cells(Question& q);
/// Whether a state was found in one of the cells at which the claim fails.
bool fails_in_a_cell(Question& q, ExactStates& states);

/// on_branches.cpp: a claim that fails on some branch of the constraints, or of its roots, may hold on that of the
/// initial state, which decides.
std::optional<CheckedClaim> by_whole_turns(Question& q);
std::optional<CheckedClaim> at_states_of_own_branch(Question& q);
std::optional<CheckedClaim> by_digits(Question& q);
/// What many digits say of what exact arithmetic has no states for; nothing if these do not tell. A smooth
/// function that is zero near a state of a branch is zero on all of it.
std::optional<bool> holds_by_digits(Question& q);
constexpr double failure_of_digits = -60;  // three states of 2³⁰ numbers each, for a claim of a degree below 2¹⁰
std::optional<CheckedClaim> on_own_sheet(Question& q);
/// Refutes it, and tells whether it holds on another branch.
std::optional<CheckedClaim> by_a_state(Question& q);
/// Doubts that it holds where the scene moves.
std::optional<CheckedClaim> along_own_motion(Question& q);
std::optional<CheckedClaim> in_numbers_on_own_branch(Question& q);

/// diagnosis.cpp: adds to what was refuted the nearest right equation, and the slip that was probably made.
void explain(Question& q);

}  // namespace alembert
