// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

/// What counts as zero, equal or closed in floating point, and why. All are relative: each is multiplied by the
/// size that its comment names. Bounds on the work of a search are not tolerances and stand beside the search.
/// Proofs use exact arithmetic and need no tolerance.

namespace alembert::tolerance {

/// The distance from 1 to the next number.
inline constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// Initial values break a constraint, or a rate its velocity constraint, if they are off by more than this times
/// the sum of the sizes of its terms. People type about nine digits, and a guess that has been solved easily
/// reaches that (docs/scene-language.md).
inline constexpr double initial_values = 1e-9;

/// A gap is closed at a state if it is smaller than this times the sizes of its terms, or times max(1, |q|). The
/// number is that of initial values, because a closed gap is a constraint.
inline constexpr double closed_gap = 1e-9;

/// A row depends on other rows if the part of it that they do not explain is below this times the row's size. A
/// rank that is decided from values that obey the constraints to `initial_values` cannot be known better.
inline constexpr double dependent_row = 1e-9;

/// A row of a joint that closes a loop counts as one that follows from others, and is left out and told, if what
/// they do not explain is below this times the size of such rows. Exports of CAD turn frames by 1e-16 to 1e-7 rad.
inline constexpr double nearly_dependent_row = 1e-6;

/// A row has vanished at a pose if its size is below this times that of the whole matrix: this allows for a few
/// hundred rounding errors of terms that cancel.
inline constexpr double vanished_row = 1e-13;

/// Forces and loads balance if their sum is below this times the largest of them; solutions of linear systems with
/// condition numbers up to 10⁶ are that accurate.
inline constexpr double balanced_load = 1e-9;

/// A rate has jumped in a kick if it changed by more than this times its size; smaller changes are rounding in the
/// solution.
inline constexpr double jump = 1e-9;

/// A zero that has just been passed is followed again once it exceeds this times its size, which is a few hundred
/// rounding errors.
inline constexpr double passed_zero = 1e-12;

/// The least tolerance at which contacts are followed: with a tenth of it, rounding would decide where a gap is
/// zero.
inline constexpr double finest_contacts = 1e-13;

/// Near gimbal lock, where two of three angles turn about nearly the same line, the smallest part of a rotation
/// that they can make is below this. The rates then grow a thousandfold, which costs three digits.
inline constexpr double gimbal_lock = 1e-3;

/// Exponents of a power series in one variable that differ by less are equal; they are sums of a few terms.
inline constexpr double same_exponent = 1e-9;

/// A value computed once in floating point is not zero if it exceeds this times the sum of the sizes of its terms;
/// used only where that saves an exact proof.
inline constexpr double surely_not_zero = 1e-8;

}  // namespace alembert::tolerance
