// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

/// What counts as zero, equal or closed in floating point, and why. All are relative: each is multiplied with the
/// size that is named. Bounds on the work of a search are no tolerances and stand where the search is; what is
/// proved is proved in exact arithmetic and needs none.

namespace alembert::tolerance {

/// From 1 to the next number.
inline constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// Initial values break a constraint, or a rate its velocity constraint, if they are off by more than this times
/// the sum of the sizes of its terms. Nine digits are what people type, and what a solved guess reaches without
/// effort (docs/scene-language.md).
inline constexpr double initial_values = 1e-9;

/// A gap is closed at a state if it is smaller than this times the sizes of its terms, or times max(1, |q|). The
/// same number: a gap that is closed is a constraint.
inline constexpr double closed_gap = 1e-9;

/// What is left of a row, after what other rows explain of it, is rounding below this times the row's size: a rank
/// decided from values that obey the constraints to `initial_values` cannot be had more sharply.
inline constexpr double dependent_row = 1e-9;

/// A row has vanished at a pose if its size is below this times that of the whole matrix: a few hundred roundings
/// of terms that cancel.
inline constexpr double vanished_row = 1e-13;

/// Forces and loads that should balance, times the largest of them: solutions of linear systems with condition
/// numbers up to 10⁶ keep this.
inline constexpr double balanced_load = 1e-9;

/// A rate has jumped in a kick if it changed by more than this times its size; less is the rounding of the solve.
inline constexpr double jump = 1e-9;

/// A zero that has just been passed is followed again once it exceeds this times its size: a few hundred
/// roundings.
inline constexpr double passed_zero = 1e-12;

/// The least tolerance at which contacts are followed: a tenth of it, and rounding decides where a gap is zero.
inline constexpr double finest_contacts = 1e-13;

/// Two of three angles turn about nearly the same line (gimbal lock): how unevenly they turn the body is below
/// this. Rates then grow a thousandfold, which costs three digits.
inline constexpr double gimbal_lock = 1e-3;

/// Exponents of a power series in one variable that differ by less are equal; they come from sums of few terms.
inline constexpr double same_exponent = 1e-9;

/// A value computed once in floating point is not zero if it exceeds this times the sum of the sizes of its terms;
/// used only where that saves an exact proof.
inline constexpr double surely_not_zero = 1e-8;

}  // namespace alembert::tolerance
