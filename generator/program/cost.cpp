// SPDX-License-Identifier: GPL-2.0-or-later
#include "program/cost.hpp"

#include <algorithm>

#include "program/readiness.hpp"

namespace alembert {

Cost cost_of(const Program& program) {
    const std::vector<int> wanted = program.right_hand_side();
    const Operations operations = program.count(wanted);
    Cost cost{.operations = operations.total(), .functions = operations.functions};
    const Readiness ready(program, wanted);
    for (const int root : wanted) cost.chain = std::max(cost.chain, ready[root]);
    return cost;
}

}  // namespace alembert
