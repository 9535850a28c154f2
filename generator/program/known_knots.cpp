// SPDX-License-Identifier: GPL-2.0-or-later
#include "program/known_knots.hpp"

#include <cln/float.h>
#include <cln/real.h>

#include <algorithm>
#include <set>

namespace alembert {

Rational exact(double x) {
    return cln::rational(cln::cl_DF(x));
}

namespace {

bool is_affine_in_time(const Program& program, int id) {
    const Node& node = program[id];
    if (node.op == Op::variable) return node.variable.kind == Variable::Kind::time;
    const auto holds = [&](int arg) { return program[arg].is_constant() || is_affine_in_time(program, arg); };
    if (node.op == Op::sum) return std::all_of(node.args.begin(), node.args.end(), holds);
    if (node.op != Op::product || node.is_constant()) return false;
    int factors = 0;
    for (std::size_t k = 0; k < node.args.size(); ++k) {
        if (program[node.args[k]].is_constant()) continue;
        ++factors;
        if (node.exponents[k] != 1 || !is_affine_in_time(program, node.args[k])) return false;
    }
    return factors == 1;
}

}  // namespace

bool has_known_knots(const Program& program, const TabulatedFunction& table, const Program::TableCall& call,
                     std::size_t argument) {
    return call.orders[0] < TabulatedFunction::side_function && !table.may_jump(call.orders) &&
           !table.axes()[argument].kinks.empty() && is_affine_in_time(program, call.argument[argument]);
}

double close_knots(const TableAxis& axis) {
    constexpr double of_mean = 0.1, of_whole = 1e-2;
    return (axis.at.back() - axis.at.front()) *
           std::min(of_whole, of_mean / static_cast<double>(axis.kinks.size() + 1));
}

namespace {

bool has_close_knots(const TableAxis& axis) {
    const auto at = [&](std::size_t k) { return axis.at[static_cast<std::size_t>(axis.kinks[k])]; };
    for (std::size_t k = 1; k < axis.kinks.size(); ++k)
        if (at(k) - at(k - 1) < close_knots(axis)) return true;
    return false;
}

}  // namespace

std::vector<std::string> tables_with_close_knots(const Program& program) {
    std::set<std::string> names;
    std::vector<int> roots = program.right_hand_side();
    const std::vector<int> events = program.nodes_of(Group::event);
    roots.insert(roots.end(), events.begin(), events.end());
    for (const int id : program.needed(roots)) {
        const Node& node = program[id];
        if (node.op != Op::unspecified || program.table_of(node) == nullptr || node.is_constant()) continue;
        const TabulatedFunction& table = *program.table_of(node);
        const Program::TableCall call = program.table_call(node);
        if (call.orders[0] >= TabulatedFunction::side_function) continue;
        for (std::size_t k = 0; k < call.arguments; ++k)
            if (!program[call.argument[k]].is_constant() && has_close_knots(table.axes()[k]) &&
                !has_known_knots(program, table, call, k))
                names.insert(program.functions.at(program.function_of(node)));
    }
    return {names.begin(), names.end()};
}

}  // namespace alembert
