// SPDX-License-Identifier: GPL-2.0-or-later
// The coefficient of order k of each node. The sums of products cover the orders in between; the ends are added
// here, because 2 a_0 b_k needs no other order.
#include <fmt/format.h>

#include <algorithm>

#include "codegen/emit/series_writer.hpp"

namespace alembert {

using Kind = SeriesNode::Kind;

/// The coefficient of order k. The sums of products are complete except for their ends.
CodeExpression SeriesWriter::value(int id, const View& v) {
    const SeriesNode& x = node(id);
    const auto now = [&](int arg) { return v.now(arg); };
    const auto first = [&](int arg) { return v.first(arg); };
    const auto boundary = [&](int a, int b) {
        if (a == b) return CodeExpression("Real(2)") * first(a) * now(a);
        return bracketed(first(a) * now(b) + now(a) * first(b));
    };
    const CodeExpression& sums = v.sums;
    std::vector<Piece> pieces;
    std::size_t term = 0;
    if (!sums.is_one() && x.kind != Kind::quotient) pieces.push_back({false, sums});
    for (const auto& [weight, a] : x.linear) pieces.push_back(v.piece(term++, weight, now(a)));
    for (const auto& [weight, a, b] : x.bilinear) pieces.push_back(v.piece(term++, weight, boundary(a, b)));
    for (const auto& [weight, m, a] : x.implied) pieces.push_back(piece(weight, now(m) * first(a)));
    const CodeExpression shared = sums.is_one() ? CodeExpression() : CodeExpression("per_k") * sums;
    switch (x.kind) {
        case Kind::time:
            return "Real(k == 1)";
        case Kind::quotient:
            pieces.push_back({true, now(x.w) * first(id)});
            pieces.push_back({false, sums});
            return joined(pieces) * v.inverse(x.w);
        case Kind::root:
            return CodeExpression("Real(0.5)") * (sums + now(x.a)) * v.inverse(id);
        case Kind::power:
            return (shared + bracketed(joined({piece(x.exponent, now(x.a) * first(id))}))) * v.inverse(x.a);
        case Kind::sine:
        case Kind::hyperbolic_sine:
        case Kind::hyperbolic_cosine:
        case Kind::area:
            return shared + now(x.a) * first(x.w);
        case Kind::cosine:
            return shared - now(x.a) * first(x.w);
        case Kind::exponential:
            return shared + now(x.a) * first(id);
        case Kind::ratio:
            return (shared + now(x.a)) * v.inverse(x.w);
        case Kind::turn:
            return (shared + first(x.b) * now(x.a) - first(x.a) * now(x.b)) * v.inverse(x.w);
        default:
            return joined(pieces);
    }
}

/// The coefficient of order k of a node outside packs, if the ends of its sums of products are added one by one.
SumParts SeriesWriter::sum_parts(int id) {
    const SeriesNode& x = node(id);
    SumParts sum;
    const auto add_now = [&](const Weight& weight, const CodeExpression& factor, int arg) {
        const Piece outside = term(weight, {});
        sum.terms.push_back({.weight = outside.value,
                             .factor = factor,
                             .late = now(arg),
                             .ready = {.node = arg},
                             .negative = outside.negative});
    };
    const bool by_order =
        x.kind != Kind::sum && x.kind != Kind::residual && x.kind != Kind::quotient && x.kind != Kind::root;
    if (by_order) sum.inner = "per_k";
    if (const int of = divisor_of(r_, id); of >= 0)
        sum.outer =
            (x.kind == Kind::root ? CodeExpression("Real(0.5)") : CodeExpression()) * names_of_[of].inverse;

    for (const SeriesProduct& product : lanes_.products(id)) {
        const SeriesLane lane = SeriesLanes::lane_of(product);
        const auto add_part = [&](const CodeExpression& times, const CodeExpression& late, Moment ready) {
            const Piece weight = term(product.weight, times);
            sum.terms.push_back({.weight = weight.value,
                                 .late = late,
                                 .ready = ready,
                                 .is_inner = true,
                                 .negative = weight.negative});
        };
        const auto add_edge = [&](int one, int before, bool before_rate, const CodeExpression& twice) {
            const CodeExpression less{"(number - Real(1))", 1};
            add_part(before_rate ? less : twice, edges_.at(before).before, {.node = before, .before = 1});
            sum.terms.back().factor = edges_.at(one).one;
        };
        add_part({}, inner_sum(product), {.node = size(), .before = 2, .delay = processor::gathered});
        if (lane.a == lane.b && lane.a_rate == lane.b_rate) {
            add_edge(lane.a, lane.a, lane.a_rate, "Real(2)");
        } else {
            add_edge(lane.a, lane.b, lane.b_rate, {});
            add_edge(lane.b, lane.a, lane.a_rate, {});
        }
    }
    for (const auto& [weight, a] : x.linear) add_now(weight, {}, a);
    for (const auto& [weight, a, b] : x.bilinear) {
        add_now(weight, a == b ? CodeExpression("Real(2)") * first(a) : first(a), b);
        if (a != b) add_now(weight, first(b), a);
    }
    for (const auto& [weight, m, a] : x.implied) add_now(weight, first(a), m);
    const Weight plus{1, -1}, minus{-1, -1};
    switch (x.kind) {
        case Kind::quotient:
            add_now(minus, first(id), x.w);
            break;
        case Kind::root:
        case Kind::ratio:
            add_now(plus, {}, x.a);
            break;
        case Kind::power:
            add_now(x.exponent, first(id), x.a);
            break;
        case Kind::cosine:
            add_now(minus, first(x.w), x.a);
            break;
        case Kind::sine:
        case Kind::hyperbolic_sine:
        case Kind::hyperbolic_cosine:
        case Kind::area:
            add_now(plus, first(x.w), x.a);
            break;
        case Kind::exponential:
            add_now(plus, first(id), x.a);
            break;
        case Kind::turn:
            add_now(plus, first(x.b), x.a);
            add_now(minus, first(x.a), x.b);
            break;
        default:
            break;
    }
    return sum;
}

}  // namespace alembert
