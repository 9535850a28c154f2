// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/fmu/event_bases.hpp"

#include <algorithm>
#include <map>

namespace alembert {

namespace {

/// A function with the same zeros: this one, of the same sign up to `sign`; or, if the function only touches zero
/// there, any that passes, and `sign` is that of the function beside its zeros.
struct Base {
    int node;
    int sign = 1;
    bool touches = false;
};

/// The factors of a product, and of those that are products; reciprocals are factors.
void add_factors(const Program& p, int node, int exponent, std::map<int, int>& exponents) {
    const Node& here = p[node];
    if (here.op != Op::product || here.is_reciprocal()) {
        exponents[node] += exponent;
        return;
    }
    for (std::size_t k = 0; k < here.args.size(); ++k)
        add_factors(p, here.args[k], exponent * here.exponents[k], exponents);
}

/// One step towards the base; false if there is none.
bool is_simplified(Program& p, Base& base) {
    const Node here = p[base.node];
    if (here.is_scaled()) {
        if (!base.touches && here.coefficients[0] < 0) base.sign = -base.sign;
        base.node = here.args[0];
        return true;
    }
    if (here.op == Op::abs) {
        base.touches = true;
        base.node = here.args[0];
        return true;
    }
    if (here.op != Op::product || here.is_reciprocal()) return false;
    std::map<int, int> exponents;
    add_factors(p, base.node, 1, exponents);
    const auto all = [&exponents](int rest) {
        return std::all_of(exponents.begin(), exponents.end(),
                           [rest](const auto& one) { return one.second % 2 == rest; });
    };
    const bool is_even = all(0);
    if (!is_even && !all(1)) return false;
    std::vector<Program::Factor> factors;
    for (const auto& [factor, exponent] : exponents)
        if (!is_even || !p[factor].is_reciprocal()) factors.emplace_back(factor, 1);  // poles would be passed
    if (factors.empty()) return false;
    const int node = p.product(1, factors);
    if (node == base.node) return false;
    base = {node, base.sign, base.touches || is_even};
    return true;
}

}  // namespace

void watch_bases(Program& program, std::vector<Mechanism::EventAction>& actions) {
    constexpr double largest = 1000;  // operations; a function is looked at as a tree
    std::size_t k = 0;
    for (std::size_t i = 0; i < program.roots.size() && k < actions.size(); ++i) {
        if (program.roots[i].group != Group::event) continue;
        Base base{program.roots[i].node};
        while (program[base.node].size <= largest && is_simplified(program, base)) {
        }
        Mechanism::EventAction& action = actions[k++];
        if (base.touches) {
            program.roots[i].node = base.node;
            action.direction = action.direction == 0 || action.direction == -base.sign ? 0 : never;
        } else {
            program.roots[i].node = base.sign > 0 ? base.node : program.sum(0, {{-1, base.node}});
        }
    }
}

}  // namespace alembert
