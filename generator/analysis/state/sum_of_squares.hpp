// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Writes a combination of holonomic constraints as a sum of squares, Σ λ_i f_i = Σ_j d_j g_j² with constant λ_i
/// and d_j > 0. At real positions all f_i are 0 only where all g_j are, too (the g_j are in the real radical of
/// the f_i).
///
///     sum_of_squares(mechanism, {0, 1, 2}, lambda)
///         // |AB| = a, |BC| = b, |AC| = a + b: x_A − ((a + b) x_B − a x_C)/b, and the same of y
///
/// f_i must be polynomials of second degree in coordinates and in functions of these, or roots of such, as
/// √(…) − a. The λ_i are guessed from numbers, as ±1/a of distances a or as rational numbers, and then proved
/// exactly: the symmetric matrix of the combination, whose rows belong to the coordinates, the functions and 1, is
/// eliminated in symbols, and no pivot is negative. What counts as zero is zero at the exact values of the
/// parameters, and what is zero in numbers alone proves nothing. Neither do more than 128 coordinates and
/// functions, or entries of more than 1000 nodes.
///
/// Source: D. Cox, J. Little & D. O'Shea, Using Algebraic Geometry (2005), §2.5 (real radicals); for distances the
/// matrix is Connelly's stress matrix (irregular_constraints.hpp).

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "model/mechanism.hpp"

namespace alembert {

/// The g_j, in the symbols of the scene. `which` are positions in Mechanism::constraints of holonomic constraints,
/// `lambda` the λ_i in numbers, to about 1e-4. Nothing if no λ_i could be proved.
std::optional<std::vector<GiNaC::ex>> sum_of_squares(const Mechanism& mechanism, const std::vector<int>& which,
                                                     const Eigen::VectorXd& lambda);

}  // namespace alembert
