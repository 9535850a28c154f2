// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// How much a reader has to read: counted before a formula is composed, and for those that are not shown.
///
///     operations_in(readable(*f));      // m*l^2*theta''/2: 4
///     if (letters_in(*f) > 2000) …

#include <cstddef>

#include "algebra/notation/phrase.hpp"
#include "algebra/symbolic/fourier.hpp"

namespace alembert {

/// Sums, products, quotients, powers and calls in a formula; a sum of three terms has two.
std::size_t operations_in(const Phrase& phrase);

/// Factors in all terms of a normal form, those in arguments and denominators included: the length of 150 terms is
/// anything between 300 letters and 50,000.
std::size_t letters_in(const Fourier& f);

}  // namespace alembert
