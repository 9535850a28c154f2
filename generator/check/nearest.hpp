// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Finds the equation of motion that a wrong claim was probably meant to be, after matching the scale of its row.
///
///     if (const auto nearest = nearest_equation(residual, mechanism, equations))
///         nearest->difference;            // claim − scale·row, "2*m*g*sin(theta)"
///
/// Candidates are the rows of the equations and the differentiated constraints. The scale is a number times powers
/// of parameters, such that as many terms of the normal forms as possible agree.

#include <optional>
#include <string>

#include "algebra/symbolic/fourier.hpp"
#include "model/formalism/equations.hpp"

namespace alembert {

struct Nearest {
    int row = 0;  ///< a row of the equations; larger numbers are rows of the constraints
    Fourier scale;
    Fourier wrong;         ///< the difference
    std::string equation;  ///< scale·row = 0
    std::string difference;
};

/// Nothing if no row has a term in common with the claim, or if the claim is too large.
std::optional<Nearest> nearest_equation(const GiNaC::ex& residual, const Mechanism& mechanism,
                                        const Equations& equations);

/// The rows' normal forms, M u' − f − Aᵀλ and A u' − γ; nothing in place of rows that are too large.
std::vector<std::optional<Fourier>> rows_of(const Mechanism& mechanism, const Equations& equations);

/// The sums of terms that differ by powers of parameters only; a textbook writes such a sum as one term.
std::vector<Fourier> parts_of(const Fourier& f);

/// c·m with b = c·m·a, where m is a product of powers of parameters; nothing if there is none.
std::optional<Fourier> steady_ratio(const Term& a, const Term& b);

}  // namespace alembert
