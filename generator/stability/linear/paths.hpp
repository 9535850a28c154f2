// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// All values of the equations of motion on a path that starts at a state, as series (program/puiseux_series.hpp).
///
///     const std::vector<PuiseuxSeries> value = on_path(residuals, instant, d, c);  // x₀ + ε d + ε² c
///     value[residuals.forcing[0]].at(1).value                             // one-sided derivative of f₀ along d
///
/// Columns of d and c: q, u, t, inputs. The state is taken to be known to 1e-13 of max(1, |x|), parameters to
/// rounding: an argument that is 6e-17 because π is not exact is zero.

#include <optional>
#include <span>

#include "program/puiseux_series.hpp"
#include "stability/linear/tangent.hpp"

namespace alembert {

/// c may be empty, which means zeros.
std::vector<PuiseuxSeries> on_path(const Residuals& residuals, const Instant<long double>& at,
                                   const VectorOf<long double>& d, const VectorOf<long double>& c = {});

/// Nodes at a critical point: functions whose argument is where they are not analytic (abs, sign and roots at 0,
/// min and max of equal arguments, atan2 on its cut, asin and acos at ±1), and nodes that have no value. `value`
/// are the values on a path that stays at the point.
std::vector<int> critical_nodes(const Program& program, std::span<const int> nodes,
                                const std::vector<PuiseuxSeries>& value);

/// Do the equations need a function at a critical point at this state?
bool is_at_kink(const Residuals& residuals, const Instant<long double>& at);

/// The derivative of a value along the path `there`, provided that the opposite path `back` gives the opposite
/// derivative and both start from the same value. Nothing if the function has a kink, a jump, an infinite slope or
/// no value there.
std::optional<long double> slope(const PuiseuxSeries& there, const PuiseuxSeries& back);

}  // namespace alembert
