// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/table_watch.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/language/say.hpp"
#include "program/known_knots.hpp"

namespace alembert {

namespace {

double range_of(const TabulatedFunction& table) {
    const std::vector<double>& c = table.coefficients();
    const auto columns = static_cast<std::size_t>(table.degree()) + 1,
               block = table.arguments() == 1 ? columns : columns * columns;
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (std::size_t k = 0; k < c.size(); k += block) low = std::min(low, c[k]), high = std::max(high, c[k]);
    return high - low;
}

/// Where between 0 and 1 an argument that goes from `x` to `end` passes knots.
void add_knots(const TableAxis& axis, double x, double end, std::vector<double>& places) {
    constexpr double most_turns = 1000;
    const double low = std::min(x, end), high = std::max(x, end);
    const auto turn_of = [&](double at) { return std::floor((at - axis.at.front()) / axis.period); };
    const double first = axis.period > 0 ? turn_of(low) : 0, last = axis.period > 0 ? turn_of(high) : 0;
    if (!(high > low) || !(last - first < most_turns)) return;
    for (double turn = first; turn <= last; ++turn) {
        const double from = turn * axis.period;
        auto knot = std::upper_bound(axis.kinks.begin(), axis.kinks.end(), low - from,
                                     [&](double at, int k) { return at < axis.at[static_cast<std::size_t>(k)]; });
        for (; knot != axis.kinks.end(); ++knot) {
            const double at = axis.at[static_cast<std::size_t>(*knot)] + from;
            if (at >= high) break;
            places.push_back((at - x) / (end - x));
        }
    }
}

/// A knot at or between the ends of a step, beside which the next one is closer than the step is long.
template <typename Matters>
std::optional<double> close_knot(const TableAxis& axis, double x, double end, double close,
                                 const Matters& matters) {
    const double length = std::abs(end - x), limit = std::min(close, length), rounded = 1e-6 * length;
    const double low = std::min(x, end) - rounded, high = std::max(x, end) + rounded;
    const double turn = axis.period > 0 ? std::floor((high - axis.at.front()) / axis.period) * axis.period : 0;
    const auto at = [&](std::size_t k) { return axis.at[static_cast<std::size_t>(axis.kinks[k])] + turn; };
    for (std::size_t k = 1; k < axis.kinks.size(); ++k)
        if (at(k) - at(k - 1) < limit && at(k) >= low && at(k - 1) <= high && matters(at(k - 1), at(k)))
            return at(k);
    return std::nullopt;
}

}  // namespace

bool TableWatch::has_work(const Program& program) {
    const std::vector<int> needed = program.needed(program.right_hand_side());
    return std::any_of(needed.begin(), needed.end(), [&](int id) {
        const Node& node = program[id];
        if (node.op != Op::unspecified || program.table_of(node) == nullptr || node.is_constant()) return false;
        const Program::TableCall call = program.table_call(node);
        for (std::size_t k = 0; k < call.arguments; ++k)
            if (!program.table_of(node)->tells_knots(k, call.orders) &&
                !has_known_knots(program, *program.table_of(node), call, k))
                return true;
        return false;
    });
}

TableWatch::TableWatch(const Program& program, const std::vector<double>& parameters)
    : coordinates_(program.coordinates.size()) {
    std::vector<int> arguments;
    for (const int id : program.needed(program.right_hand_side())) {
        const Node& node = program[id];
        if (node.op != Op::unspecified || program.table_of(node) == nullptr || node.is_constant()) continue;
        const Program::TableCall call = program.table_call(node);
        const TabulatedFunction& table = *program.table_of(node);
        bool all_told = true;
        for (std::size_t k = 0; k < call.arguments; ++k) all_told = all_told && table.tells_knots(k, call.orders);
        if (all_told) continue;  // of a force V' the value V is watched
        std::array<double, 2> close{};
        for (std::size_t k = 0; k < call.arguments; ++k)
            if (!table.tells_knots(k, call.orders) && !has_known_knots(program, table, call, k))
                close[k] = close_knots(table.axes()[k]);
        calls_.push_back({program.functions.at(program.function_of(node)), program.shared_table_of(node),
                          arguments.size(), call.arguments, range_of(table), close});
        for (std::size_t k = 0; k < call.arguments; ++k) arguments.push_back(call.argument[k]);
    }
    if (!calls_.empty()) tape_.emplace(program, std::move(arguments), parameters);
}

void TableWatch::operator()(double t, std::span<const double> state) {
    if (calls_.empty() || passed_) return;
    now_.resize(tape_->size());
    (*tape_)(t, state.data(), state.data() + coordinates_, now_.data());
    for (const Call& call : calls_)
        if (before_.size() == now_.size() && !passed_) look(call, t);
    before_ = now_;
}

std::string TableWatch::text_of(const Passed& passed) {
    return say(
        "a step that ends at t = {:.6g} passes a feature of the table '{}' near {:.6g} at once; a max_step in "
        "[simulation] makes steps shorter",
        passed.time, passed.table, passed.near);
}

void TableWatch::look(const Call& call, double t) {
    constexpr double fit_tolerance = 0.02;  // relative to the range, as of inputs over the time
    std::vector<double> knots;
    for (std::size_t k = 0; k < call.count; ++k)
        add_knots(call.table->axes()[k], before_[call.first + k], now_[call.first + k], knots);
    for (std::size_t k = 0; k < call.count; ++k) {
        const auto matters = [&](double left, double right) {
            std::array<double, 2> x{now_[call.first], now_[call.first + call.count - 1]}, y = x;
            x[k] = left, y[k] = right;
            const double a = call.table->value<double>({0, 0}, {x.data(), &x[1]}),
                         b = call.table->value<double>({0, 0}, {y.data(), &y[1]});
            return std::abs(a - b) > fit_tolerance * call.range;
        };
        const std::size_t at = call.first + k;
        if (const auto knot = close_knot(call.table->axes()[k], before_[at], now_[at], call.close[k], matters)) {
            passed_ = Passed{call.name, *knot, t};
            return;
        }
    }
    if (knots.empty()) return;
    const auto argument = [&](std::size_t k, double place) {
        const std::size_t at = call.first + std::min(k, call.count - 1);
        return before_[at] + place * (now_[at] - before_[at]);
    };
    const auto value = [&](double place) {
        const double x = argument(0, place), y = argument(1, place);
        return call.table->value<double>({0, 0}, {&x, &y});
    };
    std::array<double, 4> fixed{};
    for (std::size_t i = 0; i < 4; ++i) fixed[i] = value(static_cast<double>(i) / 3);
    for (const double place : knots) {
        const double s = 3 * place;
        const double cubic = -(s - 1) * (s - 2) * (s - 3) / 6 * fixed[0] + s * (s - 2) * (s - 3) / 2 * fixed[1] -
                             s * (s - 1) * (s - 3) / 2 * fixed[2] + s * (s - 1) * (s - 2) / 6 * fixed[3];
        if (std::abs(cubic - value(place)) <= fit_tolerance * call.range) continue;
        passed_ = Passed{call.name, argument(0, place), t};
        return;
    }
}

}  // namespace alembert
