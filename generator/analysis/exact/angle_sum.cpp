// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/exact/angle_sum.hpp"

#include <map>

namespace alembert {

namespace {

/// The terms of number + half_turns·π + Σ c·v.
struct Terms {
    Rational number = 0, half_turns = 0;
    std::map<std::pair<Variable::Kind, int>, Rational> variables{};
};

bool collect(const Program& program, int id, const Rational& factor, Terms& terms) {
    const Node& node = program[id];
    switch (node.op) {
        case Op::number:
            terms.number = terms.number + factor * node.number;
            return true;
        case Op::pi:
            terms.half_turns = terms.half_turns + factor;
            return true;
        case Op::variable: {
            Rational& c = terms.variables[{node.variable.kind, node.variable.index}];
            c = c + factor;
            return true;
        }
        case Op::sum:
            terms.number = terms.number + factor * node.number;
            for (std::size_t k = 0; k < node.args.size(); ++k)
                if (!collect(program, node.args[k], factor * node.coefficients[k], terms)) return false;
            return true;
        default:
            return false;
    }
}

}  // namespace

bool is_sum_of_variables(const Program& program, int condition) {
    Terms terms;
    return collect(program, condition, 1, terms);
}

// Solves v + … = 0 for v = Σ c·x + number + half_turns·π.
std::optional<AngleSum> angle_sum(const Program& program, int condition, const Variable& unknown) {
    Terms terms;
    if (!collect(program, condition, 1, terms)) return std::nullopt;
    const auto found = terms.variables.find({unknown.kind, unknown.index});
    if (found == terms.variables.end() || cln::zerop(found->second)) return std::nullopt;
    const Rational per = -1 / found->second;
    terms.variables.erase(found);
    const auto number = PrimeTurn::exponent(terms.number * per);
    if (!number) return std::nullopt;
    AngleSum sum{.number = *number, .half_turns = terms.half_turns * per};
    for (const auto& [variable, c] : terms.variables) {
        const auto exponent = PrimeTurn::exponent(c * per);
        if (!exponent) return std::nullopt;
        sum.multiples.emplace_back(Variable{variable.first, variable.second}, *exponent);
    }
    return sum;
}

bool set_angle(ModularPoint& point, const AngleSum& sum, Prime value) {
    const auto by_pi = PrimeTurn::by_pi(sum.half_turns / cln::expt(cln::cl_I(2), point.halves));
    if (!by_pi) return false;
    PrimeTurn turn = *by_pi * point.angle(1).power(sum.number);
    for (const auto& [variable, exponent] : sum.multiples)
        turn = turn * point.angle(point.variable(variable)).power(exponent);
    point.given_angles[value] = turn;
    return true;
}

}  // namespace alembert
