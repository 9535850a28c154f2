// SPDX-License-Identifier: GPL-2.0-or-later
#include "program/constants.hpp"

#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "program/rewriting.hpp"

namespace alembert {

namespace {

bool is_constant_sum(const Node& node) {
    return node.op == Op::sum && node.is_constant();
}

struct Flat {
    Rational number = 0;
    std::map<int, Rational> terms = {};  ///< node → coefficient
};

void add(Flat& flat, const Program& p, int id, const Rational& factor) {
    const Node& node = p[id];
    if (!is_constant_sum(node)) {
        flat.terms[id] = flat.terms[id] + factor;
        return;
    }
    flat.number = flat.number + factor * node.number;
    for (std::size_t k = 0; k < node.args.size(); ++k) add(flat, p, node.args[k], factor * node.coefficients[k]);
}

/// The value of a node that depends on parameters alone; NaN if it contains functions.
double value_of(const Program& p, int id) {
    const Node& node = p[id];
    double value = cln::double_approx(node.number);
    switch (node.op) {
        case Op::number:
            return value;
        case Op::pi:
            return std::numbers::pi;
        case Op::variable:
            return p.parameters[static_cast<std::size_t>(node.variable.index)].value;
        case Op::sum:
            for (std::size_t k = 0; k < node.args.size(); ++k)
                value += cln::double_approx(node.coefficients[k]) * value_of(p, node.args[k]);
            return value;
        case Op::product:
            value = 1;
            for (std::size_t k = 0; k < node.args.size(); ++k)
                value *= std::pow(value_of(p, node.args[k]), node.exponents[k]);
            return value;
        default:
            return std::nan("");
    }
}

/// A node as a number times a node that is not scaled.
Program::Term unscaled(const Program& p, int id) {
    return p[id].is_scaled() ? Program::Term{p[id].coefficients[0], p[id].args[0]} : Program::Term{1, id};
}

/// The position of the largest term of a sum of parameters if it is so much larger than another one that this one
/// loses at least three digits.
std::optional<std::size_t> swallowing_term(const Program& p, const Node& sum) {
    constexpr double many_times = 1e3;
    double least = HUGE_VAL, most = 0;
    std::size_t largest = 0;
    for (std::size_t k = 0; k < sum.args.size(); ++k) {
        const double size = std::abs(cln::double_approx(sum.coefficients[k]) * value_of(p, sum.args[k]));
        if (!std::isfinite(size)) return std::nullopt;
        if (size > most) largest = k;
        most = std::max(most, size);
        if (size > 0) least = std::min(least, size);
    }
    return most > many_times * least ? std::optional(largest) : std::nullopt;
}

/// A term σ a P X of a sum, where P depends on parameters alone and X does not.
struct StateTerm {
    std::size_t place;     ///< in the sum
    std::size_t factor;    ///< the position of a P in the product
    Rational coefficient;  ///< σ a
};

std::optional<StateTerm> term_with(const Program& p, const Node& sum, int parameters) {
    for (std::size_t k = 0; k < sum.args.size(); ++k) {
        const Node& product = p[sum.args[k]];
        if (product.op != Op::product || product.is_constant() || product.is_reciprocal()) continue;
        for (std::size_t j = 0; j < product.args.size(); ++j) {
            const auto [a, node] = unscaled(p, product.args[j]);
            if (node == parameters && product.exponents[j] == 1)
                return StateTerm{.place = k, .factor = j, .coefficient = sum.coefficients[k] * a};
        }
    }
    return std::nullopt;
}

}  // namespace

Program without_swallowed_constants(const Program& program) {
    Rewriting rewriting(program);
    return rewriting.finish([&](int id) {
        const Node& node = program[id];
        if (node.op != Op::sum || node.is_constant()) return rewriting.plain(id);
        for (std::size_t c = 0; c < node.args.size(); ++c) {
            const Node& gathered = program[node.args[c]];
            if (!is_constant_sum(gathered) || gathered.args.size() < 2) continue;
            const auto largest = swallowing_term(program, gathered);
            if (!largest) continue;
            const auto with_state = term_with(program, node, gathered.args[*largest]);
            if (!with_state) continue;
            Program& made = rewriting.made();
            std::vector<Program::Term> rest;
            for (std::size_t k = 0; k < gathered.args.size(); ++k)
                if (k != *largest)
                    rest.emplace_back(node.coefficients[c] * gathered.coefficients[k],
                                      rewriting.image(gathered.args[k]));
            std::vector<Program::Term> terms;
            for (std::size_t k = 0; k < node.args.size(); ++k)
                if (k != c && k != with_state->place)
                    terms.emplace_back(node.coefficients[k], rewriting.image(node.args[k]));
            const Node& product = program[node.args[with_state->place]];
            std::vector<Program::Factor> state;
            for (std::size_t k = 0; k < product.args.size(); ++k)
                if (k != with_state->factor)
                    state.emplace_back(rewriting.image(product.args[k]), product.exponents[k]);
            const Rational constant =
                node.coefficients[c] * gathered.coefficients[*largest] / with_state->coefficient;
            const int near_zero = made.sum(constant, {{1, made.product(1, state)}});
            const int parameters = rewriting.image(gathered.args[*largest]);
            terms.emplace_back(1, made.product(with_state->coefficient, {{parameters, 1}, {near_zero, 1}}));
            const Rational number = node.number + node.coefficients[c] * gathered.number;
            rest.insert(rest.end(), terms.begin(), terms.end());
            return made.sum(number, rest);
        }
        return rewriting.plain(id);
    });
}

Program with_simple_constants(const Program& program) {
    Rewriting rewriting(program);
    return rewriting.finish([&](int id) {
        const Node& node = program[id];
        if (!is_constant_sum(node) || node.args.size() < 2) return rewriting.plain(id);
        Flat flat;
        add(flat, program, id, 1);
        std::erase_if(flat.terms, [](const auto& term) { return cln::zerop(term.second); });
        if (flat.terms.size() > node.args.size()) return rewriting.plain(id);
        std::vector<Program::Term> terms;
        for (const auto& [arg, coefficient] : flat.terms) terms.emplace_back(coefficient, rewriting.image(arg));
        return rewriting.made().sum(flat.number, terms);
    });
}

}  // namespace alembert
