// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/constraint.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "model/energy.hpp"
#include "model/translate.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

bool is_nonlinear(const ex& coefficient, const Mechanism& m) {
    for (const ex& slope : m.z->pull_back({{coefficient, 1}}, m.qdot))
        if (!is_identically_zero(slope, m)) return true;
    return false;
}

}  // namespace

Mechanism::Constraint constraint_of(const Rule& rule, const Mechanism& m) {
    Intermediates& z = *m.z;
    const ex value = z.name(rule.value);
    Mechanism::Constraint made{.name = rule.name,
                               .holonomic = rule.holonomic,
                               .position = {},
                               .row = {},
                               .drift = 0,
                               .acceleration = 0,
                               .multiplier = rule.multiplier,
                               .place = rule.place};
    ex velocity = value;
    if (rule.holonomic) {
        made.position = value;
        made.row = z.pull_back({{value, 1}}, m.q);
        made.drift = m.explicit_time_derivative({value})[0];
        velocity = m.time_derivative({value})[0];
    } else {
        made.row = z.pull_back({{value, 1}}, m.qdot);
        GiNaC::exvector rest{value};
        for (int i = 0; i < m.size(); ++i) {
            if (z.depends(made.row[i], m.qdot) && is_nonlinear(made.row[i], m))
                throw SceneMistake{{rule.at,
                                    fmt::format("constraint '{}' is not linear in the rates; expected a sum of "
                                                "coefficients times rates",
                                                rule.name)}};
            rest.push_back(-made.row[i] * m.qdot[i]);
        }
        made.drift = z.name(GiNaC::add(std::move(rest)));
        if (is_identically_zero(made.drift, m)) made.drift = 0;
    }
    if (std::all_of(made.row.begin(), made.row.end(), [](const ex& e) { return e.is_zero(); }))
        throw SceneMistake{{rule.at, fmt::format("constraint '{}' contains no {}", rule.name,
                                                 rule.holonomic ? "coordinate" : "rate")}};
    made.acceleration = z.name(-m.time_derivative_without_acceleration({velocity})[0]);
    return made;
}

}  // namespace alembert
