// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Expressions on one side of each of their absolute values, signs, smaller and larger values.
///
///     sides_of(abs(x) + max(y, 1))                         // x, y - 1
///     where_positive(abs(x) + max(y, 1), {-x, y - 1})      // y - x

#include <ginac/ginac.h>

#include <vector>

namespace alembert {

/// On whose signs |·|, sign, min and max depend, each once, whatever its sign.
std::vector<GiNaC::ex> sides_of(const GiNaC::ex& e);

/// The value where these are positive. What depends on the sign of something else stays.
GiNaC::ex where_positive(const GiNaC::ex& e, const std::vector<GiNaC::ex>& positive);

}  // namespace alembert
