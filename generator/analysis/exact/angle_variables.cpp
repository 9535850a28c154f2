// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/exact/angle_variables.hpp"

namespace alembert {

using Key = RealState::Key;

void find_variables(const Program& p, const std::vector<int>& roots, std::set<Key>& angles, std::set<Key>& plain) {
    enum class Where { outside, in_angle, in_unspecified };
    std::set<Key> unspecified;
    std::set<std::pair<int, Where>> seen;
    std::vector<std::pair<int, Where>> stack;
    for (const int root : roots) stack.emplace_back(root, Where::outside);
    while (!stack.empty()) {
        const auto [id, where] = stack.back();
        stack.pop_back();
        if (!seen.emplace(id, where).second) continue;
        const Node& node = p[id];
        if (node.op == Op::variable)
            (where == Where::in_angle  ? angles
             : where == Where::outside ? plain
                                       : unspecified)
                .insert({node.variable.kind, node.variable.index});
        const bool turns = node.op == Op::sin || node.op == Op::cos || node.op == Op::tan;
        const Where inside = turns                                                   ? Where::in_angle
                             : node.op == Op::unspecified && where == Where::outside ? Where::in_unspecified
                                                                                     : where;
        for (const int arg : node.args) stack.emplace_back(arg, inside);
    }
    for (const Key& key : unspecified)
        if (!angles.contains(key)) plain.insert(key);
}

}  // namespace alembert
