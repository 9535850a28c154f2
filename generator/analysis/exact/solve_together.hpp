// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Newton's method with fifty digits.
///
///     const auto x = solve_together(conditions, {numeric(1), numeric(2)});   // FiftyDigits must be in force

#include <functional>
#include <optional>
#include <vector>

#include <ginac/ginac.h>

namespace alembert {

/// The values that are to vanish; nothing where one of them has no value.
using NumericConditions =
    std::function<std::optional<std::vector<GiNaC::numeric>>(const std::vector<GiNaC::numeric>&)>;

/// A solution near `x`, right to some forty digits; nothing if the steps do not become small. Derivatives are
/// differences over 10⁻²⁵. If there are more unknowns than conditions, each step has the least length; `reach` is
/// the largest allowed length of a step (sum of the absolute values).
std::optional<std::vector<GiNaC::numeric>> solve_together(const NumericConditions& conditions,
                                                          std::vector<GiNaC::numeric> x, double reach = 1000);

}  // namespace alembert
