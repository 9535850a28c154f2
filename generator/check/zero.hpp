// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Is an expression zero for all values of its symbols?
///
///     const CheckedClaim test = zero_test(l*theta0*(w^2 - g/l), mechanism);
///     test.verdict      // refuted, with values of the symbols at which it is not
///
/// The test is for expressions whose symbols are all independent: solutions in closed form and first
/// approximations. Claims about the state are decided at exact states (decide.hpp).

#include <vector>

#include "check/verdict.hpp"
#include "model/mechanism.hpp"

namespace alembert {

/// The largest number of nodes that an expression, written out, may have to be tested.
constexpr double longest_tested = 30000;

/// `e` must be written out, without intermediate symbols. It is proved by normal form. The values that are tried,
/// also for the time, lie between 1/3 and 3 and have fifty digits.
CheckedClaim zero_test(const GiNaC::ex& e, const Mechanism& mechanism);
inline bool is_zero(const GiNaC::ex& e, const Mechanism& mechanism) {
    return zero_test(e, mechanism).verdict == Verdict::proved;
}

/// Several such parts of a claim that are to vanish together. The first that does not is shown.
CheckedClaim all_of(const std::vector<CheckedClaim>& tests);

}  // namespace alembert
