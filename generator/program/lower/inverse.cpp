// SPDX-License-Identifier: GPL-2.0-or-later
#include "program/lower/inverse.hpp"

#include <fmt/format.h>

#include "model/formalism/joint_tree.hpp"
#include "model/formalism/needs.hpp"
#include "model/formalism/recursive.hpp"
#include "model/friction.hpp"
#include "program/lower/articulated_bodies.hpp"
#include "program/lower/lower.hpp"

namespace alembert {

using GiNaC::ex;

std::vector<int> inverse_loads(Program& program, const Mechanism& mechanism,
                               const std::vector<std::pair<GiNaC::symbol, int>>& given) {
    need_given_normal_forces(mechanism, "inverse");
    const Mechanism m = with_own_intermediates(mechanism);
    std::vector<std::pair<GiNaC::symbol, int>> known = given;
    for (const Mechanism::Unilateral& contact : m.unilateral)
        known.emplace_back(contact.gap.multiplier, program.number(0));
    if (const Possible<JointTree> tree = loaded_tree(m); tree.exists()) {
        const auto lowering = lowering_into(program, m, known);
        return inverse_recursion(program, tree.value(), *m.z, m.qddot, lowering);
    }
    const Equations e = formalism_in_rates(m).derive(m);
    const Mechanism own = in_terms_of(e, m);
    const auto lowering = lowering_into(program, own, known);
    std::vector<int> loads;
    for (int i = 0; i < m.size(); ++i) {
        std::vector<Program::Term> terms{{-1, lowering(e.forcing(i))}};
        for (int j = 0; j < m.size(); ++j)
            terms.emplace_back(1, program.product(1, {{lowering(e.M(i, j)), 1}, {lowering(m.qddot[j]), 1}}));
        loads.push_back(program.sum(0, terms));
    }
    return loads;
}

Program lower_inverse(const Mechanism& m) {
    Program program = begun(m);
    const std::vector<int> loads = inverse_loads(program, m);
    for (int i = 0; i < m.size(); ++i) program.roots.push_back({Group::load, m.q[i].get_name(), loads[i]});
    const auto lowering = lowering_into(program, m);
    for (const Mechanism::Constraint& c : m.constraints) {
        for (int i = 0; i < m.size(); ++i)
            program.roots.push_back({Group::row, fmt::format("{}_{}", c.name, i), lowering(c.row[i])});
        program.roots.push_back({Group::gamma, c.name, lowering(c.acceleration)});
    }
    return program.canonical();
}

}  // namespace alembert
