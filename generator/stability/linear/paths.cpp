// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/linear/paths.hpp"

#include <cmath>

namespace alembert {

namespace {

constexpr long double known_to = 1e-13L;  // accuracy of the state, relative to max(1, |x|)
constexpr long double parameter_known_to = 1e-15L;
constexpr long double equal_to = 1e-10L;  // slopes that differ by less are equal

/// At a knot of a table at which a derivative jumps.
bool is_at_knot(const Program& program, const Node& node, const std::vector<PuiseuxSeries>& value) {
    const Program::TableCall call = program.table_call(node);
    const TabulatedFunction& table = *program.table_of(node);
    if (call.orders[0] >= TabulatedFunction::side_function) return false;
    for (std::size_t k = 0; k < call.arguments; ++k) {
        const PuiseuxSeries& x = value[call.argument[k]];
        const TableAxis& axis = table.axes()[k];
        const long double place = x.at(0).value, allowed = known_to * std::max(1.0L, std::abs(place));
        for (const int kink : axis.kinks) {
            long double distance = place - axis.at[static_cast<std::size_t>(kink)];
            if (axis.period > 0) distance = std::remainder(distance, static_cast<long double>(axis.period));
            if (std::abs(distance) <= allowed) return true;
        }
    }
    return false;
}

/// Is the argument of this node's function at a point where the function is not analytic, or has it no value?
/// `value` are the values at a single point.
bool is_critical(const Program& program, int id, const std::vector<PuiseuxSeries>& value) {
    const Node& node = program[id];
    if (node.is_constant() || node.args.empty()) return false;
    for (const int arg : node.args)
        if (!value[arg].defined()) return false;
    if (!value[id].defined()) return true;
    const PuiseuxSeries& x = value[node.args[0]];
    switch (node.op) {
        case Op::abs:
        case Op::sign:
        case Op::sqrt:
            return x.side() == 0;
        case Op::pow: {
            const long double exponent = value[node.args[1]].at(0).value;
            return x.side() == 0 &&
                   (exponent < 0 || exponent != std::floor(exponent) || !program[node.args[1]].is_constant());
        }
        case Op::min:
        case Op::max:
            return (x - value[node.args[1]]).side() == 0;
        case Op::atan2:
            return x.side() == 0 && value[node.args[1]].side() <= 0;
        case Op::asin:
        case Op::acos:
            return ((1 - x) * (1 + x)).side() == 0;
        case Op::unspecified:
            return is_at_knot(program, node, value);
        default:
            return false;
    }
}

}  // namespace

std::vector<PuiseuxSeries> on_path(const Residuals& r, const Instant<long double>& at,
                                   const VectorOf<long double>& d, const VectorOf<long double>& c) {
    Eigen::Index next = 0;
    const auto variable = [&](long double x) {
        const long double first = d[next], second = c.size() > 0 ? c[next] : 0;
        ++next;
        return PuiseuxSeries::path(x, known_to * std::max(1.0L, std::abs(x)), {first, second});
    };
    State<PuiseuxSeries> state;
    for (const long double x : at.parameters)
        state.parameters.push_back(PuiseuxSeries(x, parameter_known_to * std::abs(x)));
    for (const long double x : at.q) state.q.push_back(variable(x));
    for (const long double x : at.u) state.qdot.push_back(variable(x));
    state.t = variable(at.t);
    state.unknown.resize(r.input_places());
    for (std::size_t k = 0; k < r.inputs.size(); ++k)
        state.unknown[static_cast<std::size_t>(r.inputs[k])] = variable(at.inputs[k]);
    return interpret(r.program, state);
}

std::vector<int> critical_nodes(const Program& program, std::span<const int> nodes,
                                const std::vector<PuiseuxSeries>& value) {
    std::vector<int> result;
    for (const int id : program.needed(nodes))
        if (is_critical(program, id, value)) result.push_back(id);
    return result;
}

bool is_at_kink(const Residuals& r, const Instant<long double>& at) {
    std::vector<int> roots;
    for (const Root& root : r.program.roots)
        if (root.group != Group::input) roots.push_back(root.node);
    const auto columns = static_cast<Eigen::Index>(at.q.size() + at.u.size() + 1 + at.inputs.size());
    return !critical_nodes(r.program, roots, on_path(r, at, VectorOf<long double>::Zero(columns))).empty();
}

std::optional<long double> slope(const PuiseuxSeries& there, const PuiseuxSeries& back) {
    for (const PuiseuxSeries* side : {&there, &back}) {
        if (!side->defined() || side->order() <= 1) return {};
        for (const PuiseuxSeries::Term& term : side->terms())
            if (term.value != 0 && term.exponent < 1 - 1e-9 && std::abs(term.exponent) > 1e-9) return {};
    }
    const auto agree = [](const PuiseuxSeries::Term& a, const PuiseuxSeries::Term& b, int sign) {
        return std::abs(a.value - sign * b.value) <=
               a.error + b.error + equal_to * (std::abs(a.value) + std::abs(b.value));
    };
    if (!agree(there.at(0), back.at(0), 1) || !agree(there.at(1), back.at(1), -1)) return {};
    return there.at(1).value;
}

}  // namespace alembert
