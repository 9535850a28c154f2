// SPDX-License-Identifier: GPL-2.0-or-later
#include "program/event_places.hpp"

#include <algorithm>

namespace alembert {

std::vector<int> event_places(Program& program, const std::vector<int>& events) {
    constexpr std::size_t most = 32;  // of more, a program of its own would look at each in every step
    std::vector<int> places;
    const auto add = [&](int node) {
        while (program[node].is_scaled()) node = program[node].args[0];
        if (program[node].op == Op::number || places.size() == most) return;
        if (std::find(places.begin(), places.end(), node) == places.end()) places.push_back(node);
    };
    for (const int id : program.needed(events)) {
        const Node node = program[id];
        switch (node.op) {
            case Op::abs:
            case Op::sign:
            case Op::tanh:
            case Op::atan:
                add(node.args[0]);
                break;
            case Op::min:
            case Op::max:
                for (std::size_t k = 1; k < node.args.size(); ++k)
                    add(program.sum(0, {{1, node.args[0]}, {-1, node.args[k]}}));
                break;
            case Op::pow:
                add(node.args[0]);
                break;
            case Op::product:
                for (std::size_t k = 0; k < node.args.size(); ++k)
                    if (node.exponents[k] % 2 == 0) add(node.args[k]);
                break;
            default:
                break;
        }
    }
    return places;
}

}  // namespace alembert
