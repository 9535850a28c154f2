// SPDX-License-Identifier: GPL-2.0-or-later
// Powers and functions of series, by the differential equation that each satisfies.
#include "program/series_building.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>

namespace alembert {

using Kind = SeriesNode::Kind;

int SeriesBuilding::power_of(int base, const Rational& exponent) {
    const auto [place, is_new] = powers_.try_emplace({base, exponent}, -1);
    if (is_new) {
        SeriesNode made{.kind = Kind::power, .a = node_of(form(base))};
        made.exponent = {exponent, -1};
        place->second = add(std::move(made));
    }
    return place->second;
}

int SeriesBuilding::area(int a, int sign, Op op) {
    const int z = with(Kind::area, a, -1, op);
    nodes()[z].w = one_and_square(z, sign);
    return z;
}

int SeriesBuilding::pair(int a, bool hyperbolic, bool second) {
    const auto [place, is_new] = pairs_.try_emplace({a, hyperbolic}, -1);
    if (is_new) {
        place->second = with(hyperbolic ? Kind::hyperbolic_sine : Kind::sine, a);
        nodes().back().w = place->second + 1;
        with(hyperbolic ? Kind::hyperbolic_cosine : Kind::cosine, a, place->second);
    }
    return place->second + (second ? 1 : 0);
}

SeriesForm SeriesBuilding::function(const Node& node) {
    const auto arg = [&](std::size_t k) { return node_of(form(node.args[k])); };
    switch (node.op) {
        case Op::sin:
        case Op::cos:
            return of(pair(arg(0), false, node.op == Op::cos));
        case Op::sinh:
        case Op::cosh:
            return of(pair(arg(0), true, node.op == Op::cosh));
        case Op::tan:
            return of(area(arg(0), 1, Op::tan));
        case Op::tanh:
            return of(area(arg(0), -1, Op::tanh));
        case Op::exp:
            return of(with(Kind::exponential, arg(0)));
        case Op::log: {
            const int a = arg(0);
            return of(with(Kind::ratio, a, a, Op::log));
        }
        case Op::atan: {
            const int a = arg(0);
            return of(with(Kind::ratio, a, one_and_square(a, 1), Op::atan));
        }
        case Op::asin:
            return of(arc(arg(0)));
        case Op::acos: {
            SeriesForm f = of(arc(arg(0)), {-1, -1});
            f.constants = {{Rational(1) / 2, p().pi()}};
            return f;
        }
        case Op::sqrt:
            return of(with(Kind::root, arg(0)));
        case Op::pow:
            return power(node);
        case Op::atan2: {
            const int y = arg(0), x = arg(1);
            const int w = add({.kind = Kind::sum, .bilinear = {{{}, x, x}, {{}, y, y}}});
            return of(add({.kind = Kind::turn, .a = y, .b = x, .w = w}));
        }
        default:
            throw std::logic_error("recurrences: a function without a power series is an obstacle");
    }
}

SeriesForm SeriesBuilding::power(const Node& node) {
    if (p()[node.args[1]].is_constant()) {
        SeriesNode made{.kind = Kind::power, .a = node_of(form(node.args[0]))};
        made.exponent = tidy(1, node.args[1]);
        return of(add(std::move(made)));
    }
    SeriesForm exponent;  // a^b = exp(b log a)
    if (p()[node.args[0]].is_constant()) {
        add_to(exponent, tidy(1, p().call(Op::log, {node.args[0]})), form(node.args[1]));
    } else {
        const int a = node_of(form(node.args[0]));
        exponent.bilinear = {{{}, with(Kind::ratio, a, a, Op::log), node_of(form(node.args[1]))}};
    }
    return of(with(Kind::exponential, node_of(exponent)));
}

}  // namespace alembert
