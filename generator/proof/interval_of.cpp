// SPDX-License-Identifier: GPL-2.0-or-later
#include "proof/interval_of.hpp"

#include <cln/float.h>

#include <cmath>
#include <numbers>

namespace alembert {

Bounds bounds_of(Op op, const Bounds& a, const Bounds& b) {
    const auto known = [](const Bounds& f) { return f.nowhere ? whole_bounds() : f; };
    switch (op) {
        case Op::pi:
            return {widened(std::numbers::pi, std::numbers::pi), {}, {}};
        case Op::sin:
            return sin(a);
        case Op::cos:
            return cos(a);
        case Op::tan:
            return tan(a);
        case Op::asin:
            return a.value.low < -1 || a.value.high > 1 ? whole_bounds() : asin(a);
        case Op::acos:
            return a.value.low < -1 || a.value.high > 1 ? whole_bounds() : acos(a);
        case Op::atan:
            return atan(a);
        case Op::sinh:
            return sinh(a);
        case Op::cosh:
            return cosh(a);
        case Op::tanh:
            return tanh(a);
        case Op::exp:
            return exp(a);
        case Op::log:
            return known(log(a));
        case Op::sqrt:
            return a.value.low < 0 ? whole_bounds() : sqrt(a);
        case Op::abs:
            return abs(a);
        case Op::sign:
            return sign(a);
        case Op::pow:
            return known(pow(a, b));
        case Op::atan2:
            return a.value.has(0) && b.value.low <= 0 ? whole_bounds() : known(atan2(a, b));
        case Op::min:
            return least_of(a, b);
        case Op::max:
            return -1.0 * least_of(-1.0 * a, -1.0 * b);
        default:
            return whole_bounds();
    }
}

Interval interval_of(const Rational& number) {
    const double near = cln::double_approx(number);
    if (!std::isfinite(near)) return Interval::whole();
    const Rational rest = number - cln::rational(cln::cl_DF(near));
    if (cln::zerop(rest)) return {near, near};
    return {std::nextafter(near, -HUGE_VAL), std::nextafter(near, HUGE_VAL)};
}

std::vector<Interval> intervals_of(const Program& program, const IntervalState& state) {
    std::vector<Interval> value(static_cast<std::size_t>(program.size()), Interval::whole());
    const auto given = [&](const Variable& variable) {
        const auto i = static_cast<std::size_t>(variable.index);
        const auto at = [&](const std::vector<Interval>& list) {
            return i < list.size() ? list[i] : Interval::whole();
        };
        switch (variable.kind) {
            case Variable::Kind::parameter:
                return at(state.parameters);
            case Variable::Kind::time:
                return state.t;
            case Variable::Kind::coordinate:
                return at(state.q);
            case Variable::Kind::rate:
                return at(state.qdot);
            default:
                return Interval::whole();
        }
    };
    for (int id = 0; id < program.size(); ++id) {
        const Node& node = program[id];
        switch (node.op) {
            case Op::number:
                value[id] = interval_of(node.number);
                break;
            case Op::variable:
                value[id] = given(node.variable);
                break;
            case Op::sum: {
                Interval sum = interval_of(node.number);
                for (std::size_t k = 0; k < node.args.size(); ++k)
                    sum = sum + interval_of(node.coefficients[k]) * value[node.args[k]];
                value[id] = sum;
                break;
            }
            case Op::product: {
                Interval product{1, 1};
                for (std::size_t k = 0; k < node.args.size(); ++k) {
                    const Interval factor = power(value[node.args[k]], std::abs(node.exponents[k]));
                    product = product * (node.exponents[k] > 0 ? factor : inverse(factor));
                }
                value[id] = product;
                break;
            }
            case Op::unspecified:
                break;
            default: {
                const auto arg = [&](std::size_t k) {
                    return k < node.args.size() ? Bounds{value[node.args[k]], {}, {}} : Bounds{};
                };
                value[id] = bounds_of(node.op, arg(0), arg(1)).value;
            }
        }
    }
    return value;
}

}  // namespace alembert
