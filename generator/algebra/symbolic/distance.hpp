// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Sums of a number and a variable, as x - 5: distances from a place that is given in numbers.
///
///     is_distance_from_number(x - 5, z);               // true
///     holds_distance_from_number(k*pow(z1, 2), z);     // true where z1 stands for x - 5
///
/// Such a sum keeps its digits where it is small, and what it becomes when it is multiplied out, 25 - 10x + x^2,
/// does not. (With a parameter in place of the number, the readable form finds the sum again.)

#include "algebra/symbolic/intermediates.hpp"

namespace alembert {

/// A sum of a number that is not zero and something that is linear in coordinates, rates and time. 1 - cos(x) is
/// none, as its digits are lost in the cosine, nor is 1 - v^2, in which nothing can be multiplied out.
bool is_distance_from_number(const GiNaC::ex& e, const Intermediates& z);

/// Whether there is such a sum in `e` or in what its intermediate symbols stand for.
bool holds_distance_from_number(const GiNaC::ex& e, const Intermediates& z);

}  // namespace alembert
