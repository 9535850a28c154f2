// SPDX-License-Identifier: GPL-2.0-or-later
// Sums, products and quotients of series.
#include "program/series_building.hpp"

#include <algorithm>
#include <set>

namespace alembert {

using Kind = SeriesNode::Kind;

int SeriesBuilding::add(SeriesNode node) {
    nodes().push_back(std::move(node));
    return static_cast<int>(nodes().size()) - 1;
}

void SeriesBuilding::remember(int id, int node, const Rational& factor) {
    if (!p()[id].is_constant()) forms_[id] = {.constants = {}, .linear = {{{factor, -1}, node}}, .bilinear = {}};
}

int SeriesBuilding::constant_product(int a, int b, int exponent_of_b) {
    std::vector<Program::Factor> factors{{b, exponent_of_b}};
    if (a >= 0) factors.emplace_back(a, 1);
    return p().product(1, factors);
}

Weight SeriesBuilding::tidy(Rational number, int constant) {
    if (constant >= 0 && p()[constant].is_scaled()) {
        number = number * p()[constant].coefficients[0];
        constant = p()[constant].args[0];
    }
    if (constant >= 0 && p()[constant].is_number()) return {number * p()[constant].number, -1};
    return {number, constant};
}

Weight SeriesBuilding::times(const Weight& a, const Weight& b) {
    const int constant = a.constant < 0   ? b.constant
                         : b.constant < 0 ? a.constant
                                          : constant_product(a.constant, b.constant, 1);
    return tidy(a.number * b.number, constant);
}

Weight SeriesBuilding::over(const Weight& a, const Weight& b) {
    return tidy(a.number / b.number, b.constant < 0 ? a.constant : constant_product(a.constant, b.constant, -1));
}

void SeriesBuilding::add_to(SeriesForm& sum, const Weight& weight, const SeriesForm& f) {
    for (const Weight& c : f.constants) sum.constants.push_back(times(weight, c));
    for (const auto& term : f.linear) {
        const Weight factor = times(weight, term.weight);
        const auto same = std::find_if(sum.linear.begin(), sum.linear.end(), [&](const auto& l) {
            return l.node == term.node && l.weight.constant == factor.constant;
        });
        if (same == sum.linear.end())
            sum.linear.push_back({factor, term.node});
        else if (same->weight.number = same->weight.number + factor.number; cln::zerop(same->weight.number))
            sum.linear.erase(same);
    }
    for (const auto& [w, a, b] : f.bilinear) sum.bilinear.push_back({times(weight, w), a, b});
}

ScaledNode SeriesBuilding::scaled(const SeriesForm& f) {
    if (f.is_node()) return {f.linear[0].weight, f.linear[0].node};
    if (f.constants.empty() && f.linear.empty() && f.bilinear.size() == 1) {
        const auto [a, b] = std::minmax(f.bilinear[0].a, f.bilinear[0].b);
        const auto [place, is_new] = products_.try_emplace({a, b}, -1);
        if (is_new) place->second = add({.kind = Kind::sum, .bilinear = {{{}, a, b}}});
        return {f.bilinear[0].weight, place->second};
    }
    return {{}, add({.kind = Kind::sum, .constants = f.constants, .linear = f.linear, .bilinear = f.bilinear})};
}

int SeriesBuilding::node_of(const SeriesForm& f) {
    const ScaledNode s = scaled(f);
    if (s.weight.constant < 0 && cln::equal(s.weight.number, 1)) return s.node;
    return add({.kind = Kind::sum, .linear = {{s.weight, s.node}}});
}

SeriesForm SeriesBuilding::form(int id) {
    if (const auto known = forms_.find(id); known != forms_.end()) return known->second;
    SeriesForm f = made(id);
    if (uses_[id] > 1 && !f.is_node() && !f.is_constant()) {
        const ScaledNode s = scaled(f);
        f = of(s.node, s.weight);
    }
    return forms_[id] = f;
}

SeriesForm SeriesBuilding::made(int id) {
    const Node node = p()[id];  // a copy, because constants may be added
    if (node.is_constant()) {
        if (p().is_zero(id)) return {};
        return {.constants = {tidy(1, id)}, .linear = {}, .bilinear = {}};
    }
    switch (node.op) {
        case Op::variable:
            return of(variable(node.variable));
        case Op::sum: {
            SeriesForm f;
            if (!cln::zerop(node.number)) f.constants.push_back({node.number, -1});
            for (std::size_t k = 0; k < node.args.size(); ++k)
                add_to(f, {node.coefficients[k], -1}, form(node.args[k]));
            return f;
        }
        case Op::product:
            if (auto with_roots = product_with_roots(id)) return *std::move(with_roots);
            return product(node);
        default:
            return function(node);
    }
}

int SeriesBuilding::variable(const Variable& v) {
    if (v.kind == Variable::Kind::time) {
        if (time_ < 0) time_ = add({.kind = Kind::time});
        return time_;
    }
    return given_.at({v.kind, v.index});
}

SeriesForm SeriesBuilding::product(const Node& node) {
    Weight weight;
    std::vector<int> factors;
    std::vector<ScaledNode> divisors;
    for (std::size_t k = 0; k < node.args.size(); ++k) {
        const int id = node.args[k];
        const Node arg = p()[id];
        const bool divides = node.exponents[k] < 0 || (arg.is_reciprocal() && !arg.is_constant());
        const int below = node.exponents[k] < 0 ? id : divides ? arg.args[0] : id;
        for (int e = 0; e < std::abs(node.exponents[k]); ++e) {
            if (arg.is_constant())
                weight = node.exponents[k] < 0 ? over(weight, tidy(1, id)) : times(weight, tidy(1, id));
            else if (divides)
                divisors.push_back(divisor(below));
            else {
                const ScaledNode factor = scaled(form(id));
                weight = times(weight, factor.weight);
                factors.push_back(factor.node);
            }
        }
    }
    return assembled(weight, factors, divisors);
}

SeriesForm SeriesBuilding::assembled(Weight weight, const std::vector<int>& factors,
                                     const std::vector<ScaledNode>& divisors) {
    SeriesForm f;
    if (factors.empty())
        f.constants = {{}};
    else if (factors.size() == 1)
        f = of(factors[0]);
    else {
        int left = factors[0];
        for (std::size_t k = 1; k + 1 < factors.size(); ++k)
            left = scaled({.constants = {}, .linear = {}, .bilinear = {{{}, left, factors[k]}}}).node;
        f.bilinear = {{{}, left, factors.back()}};
    }
    for (const ScaledNode& divisor : divisors) {
        weight = over(weight, divisor.weight);
        f = of(quotient(f, divisor.node));
    }
    SeriesForm result;
    add_to(result, weight, f);
    return result;
}

void SeriesBuilding::flatten(int id, const Rational& exponent, std::map<int, Rational>& exponents) const {
    const Node& x = result_.program[id];
    if (x.is_constant() || (x.op != Op::sqrt && x.op != Op::product)) {
        exponents.try_emplace(id, 0).first->second = exponents[id] + exponent;
    } else if (x.op == Op::sqrt) {
        flatten(x.args[0], exponent / 2, exponents);
    } else {
        for (std::size_t k = 0; k < x.args.size(); ++k) flatten(x.args[k], exponent * x.exponents[k], exponents);
    }
}

std::optional<SeriesForm> SeriesBuilding::product_with_roots(int id) {
    std::map<int, Rational> exponents;
    flatten(id, 1, exponents);
    const auto is_whole = [](const Rational& e) { return cln::equal(cln::denominator(e), 1); };
    const auto is_root = [&](const auto& one) {
        return !p()[one.first].is_constant() && cln::equal(cln::denominator(one.second), 2) &&
               cln::abs(one.second) > 1;
    };
    const auto is_plain = [&](const auto& one) {
        return is_root(one) || (is_whole(one.second) && cln::abs(one.second) <= 16);
    };
    if (std::none_of(exponents.begin(), exponents.end(), is_root) ||
        !std::all_of(exponents.begin(), exponents.end(), is_plain))
        return std::nullopt;
    Weight weight;
    std::vector<int> factors, powers;
    std::vector<ScaledNode> divisors;
    for (const auto& [base, exponent] : exponents) {
        if (is_root(std::pair(base, exponent))) {
            powers.push_back(power_of(base, exponent));
            continue;
        }
        for (Rational rest = cln::abs(exponent); rest > 0; rest = rest - 1) {
            if (p()[base].is_constant()) {
                weight = cln::minusp(exponent) ? over(weight, tidy(1, base)) : times(weight, tidy(1, base));
            } else if (cln::minusp(exponent)) {
                divisors.push_back(divisor(base));
            } else {
                const ScaledNode factor = scaled(form(base));
                weight = times(weight, factor.weight);
                factors.push_back(factor.node);
            }
        }
    }
    factors.insert(factors.begin(), powers.begin(), powers.end());
    return assembled(weight, factors, divisors);
}

ScaledNode SeriesBuilding::divisor(int id) {
    const auto known = divisors_.find(id);
    return known != divisors_.end() ? known->second : divisors_.emplace(id, scaled(form(id))).first->second;
}

int SeriesBuilding::quotient(const SeriesForm& numerator, int divisor) {
    SeriesNode node{.kind = Kind::quotient,
                    .constants = numerator.constants,
                    .linear = numerator.linear,
                    .bilinear = numerator.bilinear,
                    .w = divisor};
    if (!numerator.bilinear.empty()) return add(std::move(node));
    const int above = numerator.linear.empty() ? -1 : numerator.linear[0].node;
    const auto [place, is_new] = quotients_.try_emplace({above, divisor}, -1);
    if (is_new) place->second = add(std::move(node));
    return place->second;
}

}  // namespace alembert
