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

constexpr unsigned of_state = bit(Variable::Kind::coordinate) | bit(Variable::Kind::rate);

/// Functions that can be flat but for a small region.
bool may_be_flat(Op op) {
    return op == Op::exp || op == Op::cosh || op == Op::sinh || op == Op::tanh || op == Op::atan || op == Op::pow;
}

/// The exponents of what depends on the state in a product, whose factors may be products themselves.
void collect_powers(const Program& program, int id, int exponent, std::map<int, int>& powers) {
    const Node& node = program[id];
    if ((node.depends & of_state) == 0) return;
    if (node.is_scaled()) return collect_powers(program, node.args[0], exponent, powers);
    if (node.op != Op::product) {
        powers[id] += exponent;
        return;
    }
    for (std::size_t k = 0; k < node.args.size(); ++k)
        collect_powers(program, node.args[k], exponent * node.exponents[k], powers);
}

/// Whether a function of the state is a constant and constant multiples of the variables.
bool is_affine(const Program& program, int id) {
    const Node& node = program[id];
    if ((node.depends & of_state) == 0 || node.op == Op::variable) return true;
    if (node.op == Op::sum)
        return std::all_of(node.args.begin(), node.args.end(), [&](int arg) { return is_affine(program, arg); });
    if (node.op != Op::product) return false;
    int moving = 0;
    for (std::size_t k = 0; k < node.args.size(); ++k)
        if ((program[node.args[k]].depends & of_state) != 0)
            moving += node.exponents[k] == 1 && is_affine(program, node.args[k]) ? 1 : 2;
    return moving == 1;
}

/// Whether a sum is one of a constant and even powers of what is affine in the state. Inertias, which have those
/// of sines and cosines, change with the state as a whole and not within a narrow region.
bool is_bounded_below(const Program& program, int id) {
    const Node& sum = program[id];
    if (sum.op != Op::sum) return false;
    bool has_constant = !cln::zerop(sum.number);
    for (const int term : sum.args) {
        std::map<int, int> powers;
        collect_powers(program, term, 1, powers);
        has_constant = has_constant || powers.empty();
        if (std::any_of(powers.begin(), powers.end(),
                        [&](const auto& one) { return one.second % 2 != 0 || !is_affine(program, one.first); }))
            return false;
    }
    return has_constant;
}

/// 1/(1 + x²): of a constant and even powers of coordinates, which has no singularity but perhaps a narrow peak.
/// Of rates, a constant beside them may be that of sliding directions, and zero.
bool is_peak(const Program& program, const Node& node) {
    if (!node.is_reciprocal() || (node.depends & bit(Variable::Kind::rate)) != 0) return false;
    std::map<int, int> below;
    collect_powers(program, node.args[0], 1, below);
    if (below.size() != 1) return false;
    const int base = below.begin()->first;
    return is_bounded_below(program, program[base].op == Op::sqrt ? program[base].args[0] : base);
}

bool is_kink(const Node& node) {
    return (node.op == Op::abs || node.op == Op::min || node.op == Op::max) && (node.depends & of_state) != 0;
}

/// The kinks that may bound a narrow region: those of which a motion may pass two within a short way. One side of
/// a plane, as in |x'| x' or max(0, x − c), is none.
std::vector<int> bounding_kinks(const Program& program) {
    std::vector<int> kinks;
    std::map<int, int> kinks_of_variable;
    std::map<int, std::vector<int>> variables;
    for (const int id : program.needed(program.right_hand_side())) {
        if (!is_kink(program[id])) continue;
        kinks.push_back(id);
        const int roots[] = {id};
        for (const int part : program.needed(roots))
            if (program[part].op == Op::variable && (program[part].depends & of_state) != 0) {
                variables[id].push_back(part);
                ++kinks_of_variable[part];
            }
    }
    std::erase_if(kinks, [&](int id) {
        const Node& node = program[id];
        const bool is_side =
            std::all_of(node.args.begin(), node.args.end(), [&](int arg) { return is_affine(program, arg); });
        const bool is_alone = std::all_of(variables[id].begin(), variables[id].end(),
                                          [&](int variable) { return kinks_of_variable[variable] == 1; });
        return is_side && is_alone;
    });
    return kinks;
}

/// The functions of the state in the right-hand side that may change fast in a small region alone, and the
/// reciprocals, roots and logarithms of what contains some, as 1/cosh x and 1/(1 + exp(−x)).
std::vector<int> quick_functions(const Program& program) {
    std::set<int> result;
    std::set<int> above;  // nodes that contain such a function
    for (const int id : program.needed(program.right_hand_side())) {
        const Node& node = program[id];
        if ((node.depends & of_state) == 0) continue;
        const bool contains =
            std::any_of(node.args.begin(), node.args.end(), [&](int a) { return above.contains(a); });
        const bool is_quick = may_be_flat(node.op) || is_peak(program, node);
        if (is_quick || contains) above.insert(id);
        if (is_quick || (contains && (node.is_reciprocal() || node.op == Op::sqrt || node.op == Op::log)))
            result.insert(id);
    }
    return {result.begin(), result.end()};
}

/// The sign on which |a|, min(a, b) or max(a, b) depends. It changes within an interval until that is as short as
/// can be, so that what lies beside the kink is seen.
std::vector<EventInstruction> side_of_kink(const Program& program, int kink) {
    std::vector<EventInstruction> result = event_instructions(program, kink, most_place_instructions);
    if (result.empty()) return result;
    EventInstruction& last = result.back();
    if (last.op == Step::abs) {
        last.op = Step::sign;
        return result;
    }
    last.op = Step::sum;
    last.number = 0;
    last.terms[1].factor = -1;
    EventInstruction side{.op = Step::sign};
    side.terms.push_back({.arg = static_cast<int>(result.size()) - 1, .factor = 1, .exponent = 1});
    result.push_back(std::move(side));
    return result;
}

}  // namespace

std::shared_ptr<const EventCode> quick_places_code(const Program& program, Kinks kinks) {
    EventCode code;
    for (const int root : quick_functions(program))
        code.events.push_back(event_instructions(program, root, most_place_instructions));
    if (kinks == Kinks::watched)
        for (const int kink : bounding_kinks(program)) code.events.push_back(side_of_kink(program, kink));
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
