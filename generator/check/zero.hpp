// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Is an expression zero for all values of its symbols?
///
///     const ZeroTest test = zero_test(l*theta0*(w^2 - g/l), mechanism);
///     test.zero      // false, with values of the symbols at which it is not
///
/// For expressions in independent symbols alone: solutions in closed form, first approximations. Claims about the
/// state go by exact states (vanishing.hpp).

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/mechanism.hpp"

namespace alembert {

/// Nodes that an expression may have, written out, to be tested.
constexpr double longest_tested = 30000;

struct ZeroTest {
    std::optional<bool> zero;  ///< true: proved by normal form; false: it is not at `values`; nothing: not decided
    std::vector<std::pair<std::string, std::string>> values = {};  ///< name → value
    double value = 0;                                              ///< of the expression there
};

/// `e` is written out, without intermediate symbols. Values are tried in 40 digits between 1/3 and 3, the time as
/// well.
ZeroTest zero_test(const GiNaC::ex& e, const Mechanism& mechanism);

/// Proved, refuted or undecided by several such tests of parts of one claim; the first that is not zero is shown.
struct CheckedClaim;
void settle_by(const std::vector<ZeroTest>& tests, CheckedClaim& claim);

}  // namespace alembert
