// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/verdict.hpp"

namespace alembert {

std::vector<std::string> conditions_of(const CheckedClaim& claim) {
    std::vector<std::string> result;
    for (const Assumption& assumption : claim.assumed)
        if (assumption.is_condition) result.push_back(assumption.text);
    return result;
}

}  // namespace alembert
