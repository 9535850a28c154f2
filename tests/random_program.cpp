// SPDX-License-Identifier: MIT
#include "random_program.hpp"

#include <fmt/format.h>

#include <random>

namespace alembert::test {

Program random_program(const RandomProgram& wish) {
    const int inputs = wish.inputs;
    std::mt19937_64 random(wish.seed);
    const auto pick = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    Program p;
    std::vector<int> pool;
    for (int i = 0; i < inputs; ++i) {
        p.coordinates.push_back({.name = fmt::format("q{}", i), .unit = ""});
        pool.push_back(p.variable({Variable::Kind::coordinate, i}));
        pool.push_back(p.variable({Variable::Kind::rate, i}));
    }
    for (int i = 0; i < 3; ++i) {
        p.parameters.push_back({.name = fmt::format("c{}", i), .unit = "", .value = 0.7 + 0.3 * i});
        pool.push_back(p.variable({Variable::Kind::parameter, i}));
    }
    pool.push_back(p.variable({Variable::Kind::time}));
    const auto any = [&] { return pool[random() % pool.size()]; };
    const auto bounded = [&](int node) {  // |x / (1 + x²)| ≤ 1/2: values do not grow from step to step
        return p.product(1, {{node, 1}, {p.sum(1, {{1, p.product(1, {{node, 2}})}}), -1}});
    };
    const Rational weights[] = {1, -1, Rational(2) / 3, -3};
    for (int k = 0; k < wish.count; ++k) {
        const Rational weight = weights[pick(4)];
        const int a = any(), b = any(), c = any(), d = any(), e = any(), f = any();
        int node = a;
        switch (pick(wish.calls ? 11 : 6)) {
            case 0:
            case 1:
                node = p.sum(k % 2, {{weight, a}, {weights[pick(4)], b}, {-1, c}});
                break;
            case 2:
                node = p.sum(0, {{1, p.product(1, {{a, 1}, {b, 1}})},
                                 {-1, p.product(1, {{c, 1}, {d, 1}, {e, 1}})},
                                 {weight, f}});
                break;
            case 3:
                node = p.sum(0, {{-1, a}, {-1, p.product(1, {{b, 2}, {c, 1}})}});
                break;
            case 4:
                node = p.product(weight, {{a, 1 + pick(4)}, {b, 1}});
                break;
            case 5:
                node = p.sum(
                    0, {{weight, p.product(1, {{a, 1}, {a, 1}})}, {1, a}, {-1, p.product(1, {{a, 1}, {b, 1}})}});
                break;
            case 6:
            case 7:
                node =
                    p.sum(0, {{1, p.call(Op::sin, {a})}, {-1, p.product(1, {{p.call(Op::cos, {a}), 1}, {b, 1}})}});
                break;
            case 8: {
                const Op ops[] = {Op::atan, Op::tanh, Op::abs, Op::sqrt};
                const Op op = ops[pick(4)];
                node = p.call(op, {op == Op::sqrt ? p.sum(1, {{1, p.product(1, {{a, 2}})}}) : a});
                break;
            }
            case 9: {
                const Op ops[] = {Op::min, Op::max};
                node = p.call(ops[pick(2)], {a, b});
                break;
            }
            default:
                node = p.call(Op::pow, {p.sum(2, {{1, p.product(1, {{a, 2}})}}), p.call(Op::tanh, {b})});
        }
        pool.push_back(bounded(node));
    }
    const int results = 40;
    for (int i = 0; i < inputs; ++i)
        p.roots.push_back({Group::acceleration, "", pool[pool.size() - 1 - static_cast<std::size_t>(i)]});
    for (int k = 0; k < results; ++k) p.roots.push_back({Group::output, fmt::format("o{}", k), any()});
    return p.canonical();
}

State<double> some_state(const Program& p, unsigned seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(-2, 2);
    State<double> state{.parameters = {}, .t = uniform(random), .q = {}, .qdot = {}, .qddot = {}};
    for (const Quantity& parameter : p.parameters) state.parameters.push_back(parameter.value);
    for (std::size_t i = 0; i < p.coordinates.size(); ++i) {
        state.q.push_back(uniform(random));
        state.qdot.push_back(uniform(random));
        state.qddot.push_back(uniform(random));
    }
    return state;
}

}  // namespace alembert::test
