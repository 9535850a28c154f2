// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/canonical.hpp"

#include <fmt/format.h>

#include "lower/lower.hpp"

namespace alembert {

using GiNaC::ex;

std::optional<std::string> not_canonical(const Derived& d) {
    if (!d.equations.h.empty()) return "the equations are in generalized speeds (--by routh has them in rates)";
    for (const Mechanism::Constraint& c : d.mechanism.constraints)
        if (!c.position) return fmt::format("the constraint '{}' is one of rates", c.name);
    return std::nullopt;
}

void need_canonical(const Derived& d, std::string_view method) {
    if (const auto why = not_canonical(d))
        throw ModelError(fmt::format("method '{}' needs coordinates with their rates and holonomic constraints, but {}; take gauss or dop853",
                                     method, *why));
}

Program canonical_form(const Derived& d, const Request& request) {
    Derived form = d;
    Mechanism& m = form.mechanism;
    Intermediates& z = *m.z;
    ex L = m.lagrangian();
    for (const Mechanism::Constraint& c : m.constraints) {
        if (!c.norm) continue;
        GiNaC::exvector along;
        for (int i = 0; i < m.size(); ++i) along.push_back(c.row[i] * m.qdot[i]);
        L += GiNaC::pow(z.name(GiNaC::add(std::move(along))), 2) / 2;
    }
    const std::vector<ex> p = z.pull_back({{z.name(L), 1}}, m.qdot), slope = z.pull_back({{z.name(L), 1}}, m.q);
    const std::vector<ex> applied = m.generalized_forces(false), damping = m.generalized_forces(true);
    const int n = m.size();
    std::vector<std::vector<ex>> columns;
    for (int j = 0; j < n; ++j) columns.push_back(z.push_forward(p, {{m.qdot[j], 1}}));
    m.outputs.clear();
    for (int i = 0; i < n; ++i)
        for (int j = 0; j <= i; ++j) m.outputs.push_back({fmt::format("M_{}_{}", i, j), columns[static_cast<std::size_t>(j)][static_cast<std::size_t>(i)]});
    for (int i = 0; i < n; ++i) m.outputs.push_back({fmt::format("p_{}", i), p[static_cast<std::size_t>(i)]});
    for (int i = 0; i < n; ++i) {
        const auto k = static_cast<std::size_t>(i);
        m.outputs.push_back({fmt::format("F_{}", i), z.name(slope[k] + applied[k] + damping[k])});
    }
    m.events.clear();
    m.event_stops.clear();
    m.speeds.clear();
    m.name += "_canonical";
    return lowered(form, request).program;
}

}  // namespace alembert
