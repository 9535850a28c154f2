// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The equations of rest as products: each factor that can vanish is a branch of equilibria, sin α = 0 or
/// cos α = (m+M)g/(m l ω²) (Zhang & Qin, equation (20) of example 1-1).

#include <optional>
#include <string>

#include "algebra/notation/phrase.hpp"
#include "algebra/symbolic/fourier.hpp"
#include "model/formalism/equations.hpp"

namespace alembert {

/// An expression as a product in which sines and cosines count as variables. Factors that are numbers or single
/// parameters are left out, because they never vanish.
struct TrigonometricProduct {
    std::vector<GiNaC::ex> bases;  ///< the factors, in letters
    GiNaC::exmap functions;        ///< letter → sine, cosine …
    bool is_repeated = false;      ///< whether one of them is there more than once
    bool vanishes = false;         ///< whether the expression is zero
    bool has_poles = false;        ///< whether it is divided by anything that changes
};
TrigonometricProduct product_of(const GiNaC::ex& e, const Mechanism& mechanism);

struct RestFactor {
    GiNaC::ex value;
    std::string text;
};
/// The factors of all equations of rest that can be factored.
std::vector<RestFactor> rest_factors(const Mechanism& mechanism, const Equations& equations);

/// The factor with the sign that puts a plus before its first sine or cosine, or before its first term if it has
/// none.
Phrase leading_positive(const Fourier& factor);

}  // namespace alembert
