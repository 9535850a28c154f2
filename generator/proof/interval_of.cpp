// SPDX-License-Identifier: GPL-2.0-or-later
#include "proof/interval_of.hpp"

#include <cln/float.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace alembert {

namespace {

Bounds fixed(const Interval& x) {
    return {x, {}, {}};
}

Interval value_of(const Bounds& b) {
    return b.nowhere ? Interval::whole() : b.value;
}

Interval function_of(Op op, const std::vector<Interval>& args) {
    const Bounds a = args.empty() ? Bounds{} : fixed(args[0]), b = args.size() > 1 ? fixed(args[1]) : Bounds{};
    switch (op) {
        case Op::pi:
            return widened(std::numbers::pi, std::numbers::pi);
        case Op::sin:
            return value_of(sin(a));
        case Op::cos:
            return value_of(cos(a));
        case Op::tan:
            return value_of(tan(a));
        case Op::asin:
            return value_of(asin(a));
        case Op::acos:
            return value_of(acos(a));
        case Op::atan:
            return value_of(atan(a));
        case Op::sinh:
            return value_of(sinh(a));
        case Op::cosh:
            return value_of(cosh(a));
        case Op::tanh:
            return value_of(tanh(a));
        case Op::exp:
            return value_of(exp(a));
        case Op::log:
            return value_of(log(a));
        case Op::sqrt:
            return value_of(sqrt(a));
        case Op::abs:
            return value_of(abs(a));
        case Op::sign:
            return value_of(sign(a));
        case Op::pow:
            return value_of(pow(a, b));
        case Op::atan2:
            return value_of(atan2(a, b));
        case Op::min:
            return {std::min(args[0].low, args[1].low), std::min(args[0].high, args[1].high)};
        case Op::max:
            return {std::max(args[0].low, args[1].low), std::max(args[0].high, args[1].high)};
        default:
            return Interval::whole();
    }
}

}  // namespace

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
                std::vector<Interval> args;
                for (const int arg : node.args) args.push_back(value[arg]);
                value[id] = function_of(node.op, args);
            }
        }
    }
    return value;
}

}  // namespace alembert
