// SPDX-License-Identifier: GPL-2.0-or-later
#include "lower/cost.hpp"

#include <algorithm>

namespace alembert {

Cost cost_of(const Program& program) {
    const std::vector<int> wanted = program.right_hand_side();
    std::vector<int> ready(static_cast<std::size_t>(program.size()), 0);
    const Operations operations = program.count(wanted);
    Cost cost{.operations = operations.total(), .functions = operations.functions};
    for (const int id : program.needed(wanted)) {
        const Node& node = program[id];
        if (node.is_constant() || node.args.empty()) continue;
        int& at = ready[id];
        // As they are written: from left to right, one after the other.
        for (std::size_t k = 0; k < node.args.size(); ++k) {
            const int steps = node.op == Op::product && !node.is_reciprocal() ? node.exponents[k] : k == 0 && node.args.size() > 1 ? 0 : 1;
            at = std::max(at, ready[node.args[k]]) + 4 * (k == 0 && node.op == Op::product ? steps - 1 : steps);
        }
        if (node.is_reciprocal()) at = ready[node.args[0]] + 14;
        if (node.op != Op::sum && node.op != Op::product) at += 36;
        cost.chain = std::max(cost.chain, at);
    }
    return cost;
}

}  // namespace alembert
