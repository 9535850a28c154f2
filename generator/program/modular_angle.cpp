// SPDX-License-Identifier: GPL-2.0-or-later
#include "program/modular_angle.hpp"

#include <utility>

namespace alembert {

namespace {

constexpr std::size_t most_angle_terms = 400;

void add_term(ModularAngle& angle, Prime monomial, const Rational& c) {
    Rational& to = angle.emplace(monomial, 0).first->second;
    to = to + c;
}

}  // namespace

ModularAngle angle_of_value(Prime value) {
    return value.is_zero() ? ModularAngle{} : ModularAngle{{value, 1}};
}

std::optional<ModularAngle> angle_at(const Program& program, const std::vector<Prime>& values, Prime pi, int id,
                                     std::map<int, ModularAngle>& sums) {
    const Node& node = program[id];
    if (node.is_number()) return ModularAngle{{1, node.number}};
    if (node.op == Op::pi) return ModularAngle{{0, 1}};
    ModularAngle result;
    if (node.op == Op::sum) {
        if (const auto known = sums.find(id); known != sums.end()) return known->second;
        add_term(result, 1, node.number);
        for (std::size_t k = 0; k < node.args.size(); ++k) {
            const auto part = angle_at(program, values, pi, node.args[k], sums);
            if (!part) return std::nullopt;
            for (const auto& [monomial, c] : *part) add_term(result, monomial, c * node.coefficients[k]);
        }
    } else if (node.op == Op::product && !node.is_reciprocal()) {
        const auto leaf = [&](Prime monomial) { return monomial.is_zero() ? pi : monomial; };
        result = {{1, 1}};
        for (std::size_t k = 0; k < node.args.size(); ++k) {
            const auto part = angle_at(program, values, pi, node.args[k], sums);
            if (!part) return std::nullopt;
            for (int e = 0; e < node.exponents[k]; ++e) {
                const ModularAngle before = std::exchange(result, {});
                if (before.size() * part->size() > most_angle_terms) return std::nullopt;
                for (const auto& [m1, c1] : before)
                    for (const auto& [m2, c2] : *part) add_term(result, leaf(m1) * leaf(m2), c1 * c2);
            }
        }
        return result;
    } else {
        return angle_of_value(values[static_cast<std::size_t>(id)]);
    }
    if (result.size() > most_angle_terms) return std::nullopt;
    return sums.emplace(id, std::move(result)).first->second;
}

}  // namespace alembert
