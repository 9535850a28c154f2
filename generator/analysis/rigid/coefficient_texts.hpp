// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The coefficients of base parameters as text: polynomials in the scene's parameters, or numbers.

#include "analysis/rigid/column_dependence.hpp"

namespace alembert {

/// p ≡ numerator/denominator with both below the bound, by Euclid's algorithm (Wang 1981).
std::optional<Rational> short_fraction(Prime p);

/// A coefficient without symbols: decimals where they end, as those of the scene do; 1/3 stays a fraction.
std::string coefficient_text(const Rational& r);

/// The entries as polynomials of degree two in the parameters of which Y is made; an empty text where an entry is
/// none, and for all if these parameters are more than six. `values` are those at which `nominal` was found.
std::vector<std::string> polynomials(const RegressorColumns& columns, const ColumnDependence& nominal,
                                     const std::vector<DependentEntry>& entries, const std::vector<Prime>& values,
                                     const std::vector<Quantity>& parameters);

}  // namespace alembert
