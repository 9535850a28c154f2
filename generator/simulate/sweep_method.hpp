// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Chooses the method of a sweep whose motions are smooth.
///
///     const MethodChoice choice = method_for_sweep(wishes, derived, program, start, false);
///
/// The rules are those of one motion (method.hpp), with two differences: a step is that of rk4, and where eight
/// motions go side by side, power series are taken if they are predicted to be faster there.

#include "simulate/method.hpp"

namespace alembert {

/// `along`: whether extremes and means along motions are asked for. They are found between the ends of steps by
/// polynomials of low degree, so that long steps do not suit them. Throws what method_for throws, and ModelError
/// for a method that does not run in sweeps.
MethodChoice method_for_sweep(const RunOptions& wishes, const Derived& derived, const Program& program,
                              const Start& start, bool along);

}  // namespace alembert
