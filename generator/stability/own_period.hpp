// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The period of equations whose coefficients are sines and cosines of t: cos(w*t) has 2π/w, cos(w*t) +
/// sin(3*w*t/2) has 4π/w.
///
///     own_period(derived, start)      // π for x'' + (a − 2 q cos 2t) x = 0
///
/// It is a guess by how the equations are written; `floquet` holds them against it.

#include <optional>

#include "analysis/derive/derived.hpp"
#include "program/lower/start.hpp"

namespace alembert {

/// In s, at the start's parameters. Nothing if t stands outside of sines and cosines, if their frequencies have no
/// common multiple among the first ones, or if there is no t at all.
std::optional<double> own_period(const Derived& derived, const Start& start);

}  // namespace alembert
