// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/exact/cells.hpp"

#include <algorithm>

namespace alembert {

namespace {

bool is_never_negative(const Node& node) {
    return node.op == Op::abs || node.op == Op::sqrt || node.op == Op::exp || node.op == Op::cosh ||
           node.op == Op::pi || node.is_number();
}

}  // namespace

Cells::Cells(Program& program, std::span<const int> roots) : program_(program) {
    for (const int id : program.needed(roots)) {
        const Op op = program[id].op;
        const std::vector<int> args(program[id].args.begin(), program[id].args.end());
        if (op == Op::abs || op == Op::sign) add(args[0]);
        if (op == Op::min || op == Op::max) add(program.sum(0, {{1, args[0]}, {-1, args[1]}}));
    }
    std::sort(sides_.begin(), sides_.end(), [&](int a, int b) { return program.before(a, b); });
}

void Cells::add(int node) {
    while (program_[node].is_scaled()) node = program_[node].args[0];
    if (program_[node].op == Op::product) {
        const std::vector<int> factors(program_[node].args.begin(), program_[node].args.end()),
            exponents(program_[node].exponents.begin(), program_[node].exponents.end());
        for (std::size_t k = 0; k < factors.size(); ++k)
            if (exponents[k] % 2 != 0) add(factors[k]);
        return;
    }
    if (is_never_negative(program_[node]) || std::find(sides_.begin(), sides_.end(), node) != sides_.end()) return;
    sides_.push_back(node);
}

std::optional<Cell> Cells::of(const ModularValues& values) const {
    Cell cell = 0;
    for (std::size_t k = 0; k < sides_.size(); ++k) {
        const Prime value = values.value[static_cast<std::size_t>(sides_[k])];
        if (value.is_zero() || !value.is_plain()) return std::nullopt;
        if (value.is_square()) cell |= Cell{1} << k;
    }
    return cell;
}

std::optional<Cell> Cells::of(const RealState& state) const {
    const auto values = evaluate(program_, state, sides_);
    if (!values) return std::nullopt;
    Cell cell = 0;
    for (std::size_t k = 0; k < sides_.size(); ++k) {
        if ((*values)[k].is_zero()) return std::nullopt;
        if ((*values)[k].is_positive()) cell |= Cell{1} << k;
    }
    return cell;
}

}  // namespace alembert
