// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Equilibria and steady motions in the parameters, where the equations of rest can be solved one after the other.
///
///     const auto roots = closed_form(mechanism, equations, problem.essential());
///     (*roots)[2].text[0]        // "acos(g/(R*Omega^2))"
///     (*roots)[2].where[0]       // "abs(g/(R*Omega^2)) <= 1"
///
/// Each equation f = 0 (at q' = 0 but for cyclic rates, which stay symbols) is a product; a factor is solved where
/// it is a polynomial of first or second degree in one coordinate or in one sine or cosine, a sine or cosine of a
/// sum alone, or a sin x + b cos x + c. Its roots are put into the other equations, and so on.

#include <functional>
#include <optional>

#include "formalism/equations.hpp"

namespace alembert {

struct ClosedRoot {
    std::vector<GiNaC::ex> value;    ///< by coordinate; cyclic ones 0
    std::vector<std::string> text;   ///< likewise; "" of cyclic ones
    std::vector<std::string> where;  ///< under what conditions on the parameters it is real; none: always
};

/// All of them, or nothing where some factor is not solved. Only of independent coordinates in their rates.
/// `vanishes`: is this expression in parameters zero at their values? Then a factor may be none.
std::optional<std::vector<ClosedRoot>> closed_form(const Mechanism& mechanism, const Equations& equations,
                                                   const std::vector<bool>& essential,
                                                   const std::function<bool(const GiNaC::ex&)>& vanishes);

}  // namespace alembert
