// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/linear/borders.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/exact/cells.hpp"

namespace alembert {

namespace {

/// Whether this derivative of a table is anything but one number everywhere.
bool varies(const TabulatedFunction& table, const TabulatedFunction::Orders& orders) {
    const auto columns = static_cast<std::size_t>(table.degree()) + 1;
    const bool is_of_two = table.arguments() > 1;
    const auto first = static_cast<std::size_t>(orders[0]),
               second = is_of_two ? static_cast<std::size_t>(orders[1]) : 0;
    if (first >= columns || second >= columns) return false;
    const std::vector<double>& c = table.coefficients();
    const std::size_t block = is_of_two ? columns * columns : columns,
                      lead = is_of_two ? first * columns + second : first;
    for (std::size_t cell = 0; cell < c.size(); cell += block) {
        if (c[cell + lead] != c[lead]) return true;
        for (std::size_t k = 0; k < block; ++k) {
            const std::size_t j = is_of_two ? k / columns : k, l = is_of_two ? k % columns : 0;
            if (k != lead && j >= first && l >= second && c[cell + k] != 0) return true;
        }
    }
    const bool ends =
        table.outside() == TabulatedFunction::Outside::hold ? first + second > 0 : first > 1 || second > 1;
    return c[lead] != 0 && ends && table.outside() != TabulatedFunction::Outside::error;
}

/// How many knots lie before x, counted through all periods.
long knots_before(const TableAxis& axis, long double x) {
    long turns = 0;
    const auto most = static_cast<long double>(1L << 40);
    if (axis.period > 0) {
        const long double turn = std::floor((x - axis.at.front()) / static_cast<long double>(axis.period));
        if (!(std::abs(turn) < most)) return 0;
        turns = static_cast<long>(turn);
        x -= turn * axis.period;
    }
    const auto until = std::lower_bound(axis.kinks.begin(), axis.kinks.end(), x, [&](int knot, long double at) {
        return axis.at[static_cast<std::size_t>(knot)] < at;
    });
    return turns * static_cast<long>(axis.kinks.size()) + (until - axis.kinks.begin());
}

void find_middles(Borders::Argument& argument, bool goes_on) {
    constexpr double beyond = 0.1;  // of the width of the table
    const TableAxis& axis = *argument.axis;
    std::vector<double> knots{axis.at.front()};
    for (const int knot : axis.kinks) knots.push_back(axis.at[static_cast<std::size_t>(knot)]);
    knots.push_back(axis.at.back());
    const auto add = [&](double from, double to) {
        if (!(to > from)) return;
        argument.middles.push_back((from + to) / 2);
        argument.widths.push_back(to - from);
    };
    for (std::size_t k = 1; k < knots.size(); ++k) add(knots[k - 1], knots[k]);
    const double width = axis.at.back() - axis.at.front();
    argument.width = width / static_cast<double>(argument.middles.size());
    if (!goes_on || axis.period > 0) return;
    add(axis.at.front() - 2 * beyond * width, axis.at.front());
    add(axis.at.back(), axis.at.back() + 2 * beyond * width);
}

}  // namespace

Borders::Borders(const Program& program, std::span<const int> roots, std::vector<int> inputs)
    : program_(program), inputs_(std::move(inputs)) {
    const Cells cells(program_, roots);
    sides_ = cells.sides();
    for (const int id : program_.needed(roots))
        if (program_[id].op == Op::unspecified && program_.table_of(program_[id]) != nullptr) add_table(id);
    std::vector<int> all = sides_;
    for (const Argument& one : arguments_) all.push_back(one.node);
    needed_ = program_.needed(all);
}

template <typename Real>
State<Real> Borders::state_of(const Instant<long double>& at) const {
    const auto converted = [](const std::vector<long double>& list) {
        return std::vector<Real>(list.begin(), list.end());
    };
    State<Real> state{.parameters = converted(at.parameters),
                      .t = Real(at.t),
                      .q = converted(at.q),
                      .qdot = converted(at.u),
                      .qddot = {}};
    state.unknown.resize(input_places(inputs_));
    for (std::size_t k = 0; k < inputs_.size(); ++k)
        state.unknown[static_cast<std::size_t>(inputs_[k])] = Real(at.inputs[k]);
    return state;
}

void Borders::add_table(int id) {
    const Node& node = program_[id];
    const TabulatedFunction& table = *program_.table_of(node);
    const Program::TableCall call = program_.table_call(node);
    if (node.is_constant() || call.orders[0] >= TabulatedFunction::side_function || !varies(table, call.orders))
        return;
    for (std::size_t k = 0; k < call.arguments; ++k) {
        const TableAxis& axis = table.axes()[k];
        const bool is_known = std::any_of(arguments_.begin(), arguments_.end(), [&](const Argument& one) {
            return one.node == call.argument[k] && one.axis == &axis;
        });
        if (program_[call.argument[k]].is_constant() || is_known) continue;
        Argument argument{.node = call.argument[k], .axis = &axis, .middles = {}, .widths = {}, .width = 0};
        find_middles(argument, table.outside() != TabulatedFunction::Outside::error);
        arguments_.push_back(std::move(argument));
    }
}

std::vector<Variable> Borders::variables() const {
    std::vector<Variable> result;
    for (const int id : needed_)
        if (program_[id].op == Op::variable) result.push_back(program_[id].variable);
    return result;
}

std::vector<long double> Borders::values(const Instant<long double>& at) const {
    std::vector<long double> value(static_cast<std::size_t>(program_.size()));
    interpret_into(value, program_, state_of<long double>(at), needed_);
    return value;
}

long Borders::passed(const Instant<long double>& one, const Instant<long double>& other) const {
    if (empty()) return 0;
    const std::vector<long double> a = values(one), b = values(other);
    long result = 0;
    for (const int side : sides_) {
        const long double before = a[static_cast<std::size_t>(side)], after = b[static_cast<std::size_t>(side)];
        result += (before > 0 && after < 0) || (before < 0 && after > 0) ? 1 : 0;
    }
    for (const Argument& x : arguments_)
        result += std::abs(knots_before(*x.axis, b[static_cast<std::size_t>(x.node)]) -
                           knots_before(*x.axis, a[static_cast<std::size_t>(x.node)]));
    return result;
}

bool Borders::has_period(std::size_t coordinate, long double period, const Instant<long double>& at) const {
    constexpr long double same = 1e-12L;
    if (empty()) return true;
    Instant<long double> there = at;
    there.q[coordinate] += period;
    const std::vector<long double> a = values(at), b = values(there);
    const auto change = [&](int node) {
        return b[static_cast<std::size_t>(node)] - a[static_cast<std::size_t>(node)];
    };
    const auto is_small = [&](long double x, int node) {
        return std::abs(x) <= same * (1 + std::abs(a[static_cast<std::size_t>(node)]));
    };
    const bool sides_stay = std::all_of(sides_.begin(), sides_.end(), [&](int side) {
        const long double by = change(side);
        return is_small(by, side) || is_small(by + 2 * a[static_cast<std::size_t>(side)], side);  // |sin(q/2)|
    });
    return sides_stay && std::all_of(arguments_.begin(), arguments_.end(), [&](const Argument& x) {
               const long double turn = x.axis->period, by = change(x.node);
               return is_small(turn > 0 ? std::remainder(by, turn) : by, x.node);
           });
}

Borders::Slope Borders::slope(const Argument& argument, const Instant<long double>& at) const {
    State<Jet<long double>> state = state_of<Jet<long double>>(at);
    const std::size_t n = at.q.size(), count = n + at.u.size();
    for (std::size_t k = 0; k < count; ++k) {
        Jet<long double>& x = k < n ? state.q[k] : state.qdot[k - n];
        x.d.assign(count, 0);
        x.d[k] = 1;
    }
    std::vector<Jet<long double>> value(static_cast<std::size_t>(program_.size()));
    interpret_into(value, program_, state, program_.needed(std::vector<int>{argument.node}));
    const Jet<long double>& found = value[static_cast<std::size_t>(argument.node)];
    Slope result{.value = found.value, .by_q = {}, .by_u = {}};
    for (std::size_t k = 0; k < count; ++k) (k < n ? result.by_q : result.by_u).push_back(found.derivative(k));
    return result;
}

}  // namespace alembert
