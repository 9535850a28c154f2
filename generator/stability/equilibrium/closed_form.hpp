// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Equilibria and steady motions in terms of the parameters, if the equations of rest can be solved one after the
/// other.
///
///     const auto roots = closed_form(mechanism, equations, problem.essential());
///     (*roots)[2].text[0]        // "acos(g/(R*Omega^2))"
///     (*roots)[2].where[0]       // "abs(g/(R*Omega^2)) <= 1"
///
/// Each equation f = 0 (at q' = 0 except for cyclic rates, which stay symbols) is a product. A factor can be
/// solved if it is a polynomial of first or second degree in one coordinate or in one sine or cosine, a single
/// sine or cosine of a sum, or a sin x + b cos x + c. Its roots are substituted into the other equations, and so
/// on.

#include <functional>
#include <optional>

#include "model/formalism/equations.hpp"

namespace alembert {

struct ClosedRoot {
    std::vector<GiNaC::ex> value;   ///< by coordinate; 0 for cyclic ones
    std::vector<std::string> text;  ///< likewise; "" for cyclic ones
    std::vector<std::string>
        where;  ///< the conditions on the parameters under which it is real; empty if it always is
};

/// All of them, or nothing if some factor cannot be solved. Only for independent coordinates whose rates are the
/// speeds. `vanishes` tells whether an expression in parameters is zero at their values; such a factor does not
/// determine anything.
std::optional<std::vector<ClosedRoot>> closed_form(const Mechanism& mechanism, const Equations& equations,
                                                   const std::vector<bool>& essential,
                                                   const std::function<bool(const GiNaC::ex&)>& vanishes);

}  // namespace alembert
