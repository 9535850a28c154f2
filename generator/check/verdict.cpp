// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/verdict.hpp"

namespace alembert {

const char* name_of(Assumption::Kind kind) {
    switch (kind) {
        case Assumption::Kind::side:
            return "side";
        case Assumption::Kind::branch:
            return "branch";
        case Assumption::Kind::parameter:
            return "parameter";
        case Assumption::Kind::pose:
            return "pose";
        case Assumption::Kind::closed:
            return "closed";
        case Assumption::Kind::small:
            return "small";
        case Assumption::Kind::stated:
            return "stated";
    }
    return "";
}

std::vector<std::string> conditions_of(const CheckedClaim& claim) {
    std::vector<std::string> result;
    for (const Assumption& assumption : claim.assumed)
        if (assumption.is_condition) result.push_back(assumption.text);
    return result;
}

}  // namespace alembert
