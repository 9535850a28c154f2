// SPDX-License-Identifier: GPL-2.0-or-later
#include "program/event_code.hpp"

#include <cln/float.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <set>

namespace alembert {

namespace {

using Step = EventInstruction::Op;
constexpr std::size_t most_event_instructions = 100, most_place_instructions = 1000;

const std::map<Op, Step> event_functions = {
    {Op::sin, Step::sin},   {Op::cos, Step::cos},   {Op::tan, Step::tan},   {Op::asin, Step::asin},
    {Op::acos, Step::acos}, {Op::atan, Step::atan}, {Op::sinh, Step::sinh}, {Op::cosh, Step::cosh},
    {Op::tanh, Step::tanh}, {Op::exp, Step::exp},   {Op::log, Step::log},   {Op::sqrt, Step::sqrt},
    {Op::abs, Step::abs},   {Op::sign, Step::sign}, {Op::pow, Step::pow},   {Op::atan2, Step::atan2},
    {Op::min, Step::min},   {Op::max, Step::max},
};

/// Nothing (false) if the runtime has no such operation.
bool translate_event(const Program& program, const Node& node, EventInstruction& step) {
    const int n = static_cast<int>(program.coordinates.size());
    switch (node.op) {
        case Op::number:
            step.op = Step::number;
            step.number = cln::double_approx(node.number);
            return true;
        case Op::pi:
            step.op = Step::number;
            step.number = std::numbers::pi;
            return true;
        case Op::variable:
            step.index = node.variable.index;
            switch (node.variable.kind) {
                case Variable::Kind::parameter:
                    step.op = Step::parameter;
                    return true;
                case Variable::Kind::time:
                    step.op = Step::time;
                    return true;
                case Variable::Kind::coordinate:
                    step.op = Step::state;
                    return true;
                case Variable::Kind::rate:
                    step.op = Step::state;
                    step.index += n;
                    return true;
                case Variable::Kind::acceleration:
                    step.op = Step::rate;
                    step.index += n;
                    return true;
                default:
                    return false;
            }
        case Op::sum:
            step.op = Step::sum;
            step.number = cln::double_approx(node.number);
            return true;
        case Op::product:
            step.op = node.is_reciprocal() ? Step::inverse : Step::product;
            return true;
        case Op::unspecified:
            if (program.table_of(node) == nullptr) return false;
            step.op = Step::side;
            step.index = program.table_call(node).orders[0];
            step.table = program.shared_table_of(node);
            return step.index >= TabulatedFunction::side_function;
        default: {
            const auto known = event_functions.find(node.op);
            if (known == event_functions.end()) return false;
            step.op = known->second;
            return true;
        }
    }
}

std::vector<EventInstruction> event_instructions(const Program& program, int root, std::size_t most) {
    const int roots[] = {root};
    const std::vector<int> needed = program.needed(roots);
    if (needed.size() > most) return {};
    std::map<int, int> place;
    std::vector<EventInstruction> result;
    for (const int id : needed) {
        const Node& node = program[id];
        EventInstruction step{.op = Step::number};
        if (!translate_event(program, node, step)) return {};
        for (std::size_t k = step.op == Step::side ? 2 : 0; k < node.args.size(); ++k)
            step.terms.push_back({.arg = place.at(node.args[k]),
                                  .factor = node.op == Op::sum ? cln::double_approx(node.coefficients[k]) : 1,
                                  .exponent = node.op == Op::product ? node.exponents[k] : 1});
        place.emplace(id, static_cast<int>(result.size()));
        result.push_back(std::move(step));
    }
    return result;
}

/// Functions that can be flat but for a small region.
bool may_be_flat(Op op) {
    return op == Op::exp || op == Op::cosh || op == Op::sinh || op == Op::tanh || op == Op::atan || op == Op::pow;
}

/// The functions of the state in the right-hand side that may change fast in a small region alone, and the
/// reciprocals, roots and logarithms of what contains some, as 1/cosh x and 1/(1 + exp(−x)).
std::vector<int> quick_functions(const Program& program) {
    constexpr unsigned state = bit(Variable::Kind::coordinate) | bit(Variable::Kind::rate);
    std::vector<int> result;
    std::set<int> above;  // nodes that contain such a function
    const std::vector<int> roots = program.right_hand_side();
    for (const int id : program.needed(roots)) {
        const Node& node = program[id];
        if ((node.depends & state) == 0) continue;
        const bool contains =
            std::any_of(node.args.begin(), node.args.end(), [&](int a) { return above.contains(a); });
        const bool is_quick = may_be_flat(node.op);
        if (is_quick || contains) above.insert(id);
        if (is_quick || (contains && (node.is_reciprocal() || node.op == Op::sqrt || node.op == Op::log)))
            result.push_back(id);
    }
    return result;
}

}  // namespace

std::shared_ptr<const EventCode> quick_places_code(const Program& program) {
    EventCode code;
    for (const int root : quick_functions(program))
        code.events.push_back(event_instructions(program, root, most_place_instructions));
    if (code.events.empty()) return nullptr;
    return std::make_shared<const EventCode>(std::move(code));
}

std::shared_ptr<const EventCode> event_code(const Program& program) {
    EventCode code;
    for (const int root : program.nodes_of(Group::event))
        code.events.push_back(event_instructions(program, root, most_event_instructions));
    if (code.events.empty()) return nullptr;
    return std::make_shared<const EventCode>(std::move(code));
}

}  // namespace alembert
