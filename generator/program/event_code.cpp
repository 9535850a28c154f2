// SPDX-License-Identifier: GPL-2.0-or-later
#include "program/event_code.hpp"

#include <cln/float.h>

#include <map>
#include <numbers>

namespace alembert {

namespace {

using Step = EventInstruction::Op;
constexpr std::size_t most_event_instructions = 100;

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
        default: {
            const auto known = event_functions.find(node.op);
            if (known == event_functions.end()) return false;
            step.op = known->second;
            return true;
        }
    }
}

std::vector<EventInstruction> event_instructions(const Program& program, int root) {
    const int roots[] = {root};
    const std::vector<int> needed = program.needed(roots);
    if (needed.size() > most_event_instructions) return {};
    std::map<int, int> place;
    std::vector<EventInstruction> result;
    for (const int id : needed) {
        const Node& node = program[id];
        EventInstruction step{.op = Step::number};
        if (!translate_event(program, node, step)) return {};
        for (std::size_t k = 0; k < node.args.size(); ++k)
            step.terms.push_back({.arg = place.at(node.args[k]),
                                  .factor = node.op == Op::sum ? cln::double_approx(node.coefficients[k]) : 1,
                                  .exponent = node.op == Op::product ? node.exponents[k] : 1});
        place.emplace(id, static_cast<int>(result.size()));
        result.push_back(std::move(step));
    }
    return result;
}

}  // namespace

std::shared_ptr<const EventCode> event_code(const Program& program) {
    EventCode code;
    for (const int root : program.nodes_of(Group::event)) code.events.push_back(event_instructions(program, root));
    if (code.events.empty()) return nullptr;
    return std::make_shared<const EventCode>(std::move(code));
}

}  // namespace alembert
