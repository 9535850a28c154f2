// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Is an expression zero for all values of its symbols?
///
///     const ZeroTest test = zero_test(l*theta0*(w^2 - g/l), mechanism);
///     test.zero      // false, with values of the symbols at which it is not
///
/// The test is for expressions whose symbols are all independent: solutions in closed form and first
/// approximations. Claims about the state are decided at exact states (vanishing.hpp).

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/mechanism.hpp"

namespace alembert {

/// The largest number of nodes that an expression, written out, may have to be tested.
constexpr double longest_tested = 30000;

struct ZeroTest {
    std::optional<bool> zero;  ///< true: proved by normal form; false: not zero at `values`; nothing: not decided
    std::vector<std::pair<std::string, std::string>> values = {};  ///< name → value
    double value = 0;                                              ///< of the expression at `values`
};

/// `e` must be written out, without intermediate symbols. The values that are tried, also for the time, lie
/// between 1/3 and 3 and have fifty digits.
ZeroTest zero_test(const GiNaC::ex& e, const Mechanism& mechanism);

/// Proves or refutes a claim, or leaves it undecided, from several such tests of parts of the claim. The first
/// part that is not zero is shown.
struct CheckedClaim;
void settle_by(const std::vector<ZeroTest>& tests, CheckedClaim& claim);

}  // namespace alembert
