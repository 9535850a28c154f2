// SPDX-License-Identifier: GPL-2.0-or-later
#include "program/lower/energy_roots.hpp"

#include <array>

#include "program/modular.hpp"

namespace alembert {

namespace {

constexpr std::uint64_t most_seeds = 64;  // some of which give unusable points
constexpr int enough = 2;  // points; each misses a difference with a probability of the degree times 2⁻⁶¹

/// Whether two nodes are equal at random points; false also if no point was found at which both exist.
bool agree(const Program& program, int a, int b) {
    int met = 0;
    for (std::uint64_t seed = 1; seed <= most_seeds && met < enough; ++seed) {
        const ModularPoint point{.seed = seed};
        const auto at = evaluate_mod(program, point, std::array{a, b});
        if (!at) continue;
        if (!at->exact || at->value[a] != at->value[b]) return false;
        ++met;
    }
    return met == enough;
}

/// ½ uᵀM u
int in_speeds(Program& program, const std::vector<int>& mass, int s) {
    std::vector<Program::Term> terms;
    for (int i = 0, k = 0; i < s; ++i)
        for (int j = 0; j <= i; ++j, ++k) {
            const int ui = program.variable({Variable::Kind::rate, i}),
                      uj = program.variable({Variable::Kind::rate, j});
            terms.emplace_back(i == j ? Rational(1) / 2 : Rational(1),
                               program.product(1, {{mass[static_cast<std::size_t>(k)], 1}, {ui, 1}, {uj, 1}}));
        }
    return program.sum(0, terms);
}

}  // namespace

void add_energy_roots(Lowering& lowering, Program& program, const Mechanism& m, const Equations& equations,
                      const Energy& energy, const std::vector<int>& mass) {
    int T = lowering(energy.kinetic);
    const int V = lowering(energy.potential);
    const bool own_speeds = !equations.h.empty() && !m.given_lagrangian;
    if (own_speeds && !mass.empty()) {
        const int by_speeds = in_speeds(program, mass, equations.size() - program.states);
        const bool is_shorter =
            program.count(std::array{by_speeds}).total() < program.count(std::array{T}).total();
        if (is_shorter && agree(program, T, by_speeds)) T = by_speeds;
    }
    const int E = m.given_lagrangian ? lowering(energy.energy) : program.sum(0, {{1, T}, {1, V}});
    int h = energy.jacobi.is_equal(energy.energy) ? E : lowering(energy.jacobi);
    if (own_speeds && h != E && agree(program, h, E)) h = E;
    program.roots.push_back({Group::kinetic, "T", T});
    program.roots.push_back({Group::potential, "V", V});
    program.roots.push_back({Group::energy, "E", E});
    program.roots.push_back({Group::power, "P", lowering(energy.power)});
    program.roots.push_back({Group::jacobi, "h", h});
}

}  // namespace alembert
