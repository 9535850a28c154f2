// SPDX-License-Identifier: GPL-2.0-or-later
#include "program/known_knots.hpp"

#include <algorithm>

namespace alembert {

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

namespace {

/// Whether two of them may lie in one step, which then would see neither.
bool are_close(const TableAxis& axis, const std::vector<int>& kinks) {
    constexpr double of_whole = 1e-3;
    const auto at = [&](std::size_t k) { return axis.at[static_cast<std::size_t>(kinks[k])]; };
    for (std::size_t k = 1; k < kinks.size(); ++k)
        if (at(k) - at(k - 1) < of_whole * (axis.at.back() - axis.at.front())) return true;
    return false;
}

}  // namespace

bool has_known_knots(const Program& program, const TabulatedFunction& table, const Program::TableCall& call,
                     std::size_t argument) {
    const int smooth = table.interpolation() == TabulatedFunction::Interpolation::linear  ? 0
                       : table.interpolation() == TabulatedFunction::Interpolation::pchip ? 1
                                                                                          : 2;
    const bool holds = table.outside() == TabulatedFunction::Outside::hold;
    const int order = call.orders[0] + call.orders[1];
    constexpr std::size_t few = 64;  // these are switches of a run, which methods with fixed steps heed too
    const std::vector<int>& kinks = kinks_of(table, argument, call.orders);
    return (kinks.size() > few || are_close(table.axes()[argument], kinks)) &&
           call.orders[0] < TabulatedFunction::side_function && order <= (holds ? 0 : smooth) &&
           is_affine_in_time(program, call.argument[argument]);
}

}  // namespace alembert
