// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Claims that leave names open: whether some choice of these names satisfies them at every state (open_rows.hpp).
///
///     settle_open_claims(now, {0, 3}, states);     // writes now.verdicts[0], now.verdicts[3]

#include "check/comparison.hpp"

namespace alembert {

/// `states`: states that obey the law and the constraints of `now`.
void settle_open_claims(Comparison& now, const std::vector<std::size_t>& open, ExactStates& states);

}  // namespace alembert
