// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// sign, min and max that return NaN if any argument is NaN: max(0, √(−1)) is not zero. The emitted code has the
/// same functions (templates/elementary.cpp.mustache). They work for every type with <, > and !=; of equal
/// arguments the first is taken.

namespace alembert {

/// The sign: −1, 0 or 1.
template <typename Real>
Real sign_of(const Real& x) {
    return x != x ? x : Real(x > 0) - Real(x < 0);
}

template <typename Real>
Real lesser(const Real& x, const Real& y) {
    return y < x || y != y ? y : x;
}

template <typename Real>
Real greater(const Real& x, const Real& y) {
    return x < y || y != y ? y : x;
}

}  // namespace alembert
