// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/canonical.hpp"

#include <fmt/format.h>

#include "base/language/say.hpp"
#include "program/lower/lower.hpp"

namespace alembert {

using GiNaC::ex;

std::optional<std::string> not_canonical(const Derived& d) {
    if (!d.equations.speeds_are_rates())
        return say("the equations are in generalized speeds (the formalism 'routh' has them in rates)");
    if (!d.mechanism.states.empty()) return say("the scene has first-order states ([states])");
    if (!d.mechanism.frictions.empty()) return say("there is dry friction ([[friction]])");
    for (const Mechanism::Constraint& c : d.mechanism.constraints)
        if (!c.position) return say("the constraint '{}' is one of rates", c.name);
    return std::nullopt;
}

void need_canonical(const Derived& d, std::string_view method) {
    if (const auto why = not_canonical(d))
        throw ModelError(
            say("method '{}' needs coordinates with their rates and holonomic constraints, but {}; take "
                "gauss or dop853",
                method, *why));
}

Program canonical_form(const Derived& d) {
    const Mechanism& m = d.mechanism;
    Intermediates& z = *m.z;
    const int n = m.size();
    ex L = m.lagrangian();
    for (const Mechanism::Constraint& c : m.constraints) {
        if (!c.norm) continue;
        GiNaC::exvector along;
        for (int i = 0; i < n; ++i) along.push_back(c.row[i] * m.qdot[i]);
        L += GiNaC::pow(z.name(GiNaC::add(std::move(along))), 2) / 2;
    }
    L = z.name(L);
    const std::vector<ex> p = z.pull_back({{L, 1}}, m.qdot), slope = z.pull_back({{L, 1}}, m.q);
    const std::vector<ex> applied = m.generalized_forces(false), damping = m.generalized_forces(true);
    std::vector<std::vector<ex>> columns;
    for (int j = 0; j < n; ++j) columns.push_back(z.push_forward(p, {{m.qdot[j], 1}}));

    std::vector<ex> wanted;
    std::vector<std::string> names;
    const auto want = [&](std::string name, const ex& value) {
        names.push_back(std::move(name));
        wanted.push_back(value);
    };
    for (int i = 0; i < n; ++i)
        for (int j = 0; j <= i; ++j) want(fmt::format("M_{}_{}", i, j), columns[j][i]);
    for (int i = 0; i < n; ++i) want(fmt::format("p_{}", i), p[i]);
    for (int i = 0; i < n; ++i) want(fmt::format("F_{}", i), z.name(slope[i] + applied[i] + damping[i]));

    Program program = begun(m);
    program.name += "_canonical";
    program.formulation = "momenta and forces as outputs; what else the file has is zero";
    const std::vector<int> nodes = lower_expressions(program, m, wanted);
    for (std::size_t k = 0; k < nodes.size(); ++k) program.roots.push_back({Group::output, names[k], nodes[k]});
    const int zero = program.number(0);
    for (const auto& [group, count] : {std::pair{Group::mass, n * (n + 1) / 2},
                                       {Group::forcing, n},
                                       {Group::acceleration, n},
                                       {Group::kinetic, 1},
                                       {Group::potential, 1},
                                       {Group::energy, 1},
                                       {Group::power, 1},
                                       {Group::jacobi, 1}})
        for (int k = 0; k < count; ++k) program.roots.push_back({group, "", zero});
    return program.canonical();
}

}  // namespace alembert
