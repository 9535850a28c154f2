// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/assumption.hpp"

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
        case Assumption::Kind::state:
            return "state";
        case Assumption::Kind::numbers:
            return "numbers";
        case Assumption::Kind::family:
            return "family";
    }
    return "";
}

}  // namespace alembert
