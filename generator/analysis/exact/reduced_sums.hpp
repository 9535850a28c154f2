// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Sums that vanish together, combined so that each of the first terms stands in one of them alone: the equations
/// of rest of bodies that are tied by springs, k (θ − φ) + 2 m g l sin θ and −k (θ − φ) + m g l sin φ, become
/// k (θ − φ) − m g l sin φ and 2 m g l sin θ + m g l sin φ.

#include <ginac/ginac.h>

#include <vector>

namespace alembert {

/// Which terms are to stand in one sum alone where possible.
enum class Singled { plain_terms, turned_terms };  ///< those without, or with, sines and cosines

/// Combinations with rational coefficients that vanish exactly where `sums` do. Sums that are combinations of the
/// others are left out.
std::vector<GiNaC::ex> reduced_sums(const std::vector<GiNaC::ex>& sums, Singled first);

}  // namespace alembert
