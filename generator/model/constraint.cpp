// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/constraint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "base/language/say.hpp"
#include "model/energy.hpp"
#include "model/translate.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

constexpr const char* of_second_degree = to_say(
    ". Only constraints that are linear in the rates determine which displacements are virtual. For others, as in "
    "the "
    "example of Appell and Hamel, the motion depends on the mechanism that keeps them: describe that mechanism by "
    "constraints that are linear in its rates");

/// Whether the coefficient of a rate changes with the rates. Its slopes do not tell: that of |x'| is sign x',
/// whose own slopes are zero.
bool is_nonlinear(const ex& coefficient, const Mechanism& m) {
    const ex here = m.z->expand(coefficient);
    GiNaC::exmap elsewhere;
    for (int i = 0; i < m.size(); ++i) elsewhere[m.qdot[i]] = m.qddot[i];
    return !is_identically_zero(here - here.subs(elsewhere, GiNaC::subs_options::no_pattern), m);
}

}  // namespace

std::pair<std::vector<ex>, ex> linear_form(const ex& value, const std::string& what, Place at, const Mechanism& m,
                                           const std::string& advice) {
    const std::vector<ex> row = m.z->pull_back({{value, 1}}, m.qdot);
    GiNaC::exvector rest{value};
    for (int i = 0; i < m.size(); ++i) {
        if (m.z->depends(row[i], m.qdot) && is_nonlinear(row[i], m))
            throw SceneMistake{
                {at, say("{} is not linear in the rates; expected a sum of coefficients times rates{}", what,
                         advice)}};
        rest.push_back(-row[i] * m.qdot[i]);
    }
    const ex offset = m.z->name(GiNaC::add(std::move(rest)));
    return {row, is_identically_zero(offset, m) ? ex(0) : offset};
}

bool all_zero(const std::vector<ex>& row) {
    return std::all_of(row.begin(), row.end(), [](const ex& e) { return e.is_zero(); });
}

Mechanism::Constraint constraint_of(const Rule& rule, const Mechanism& m) {
    Intermediates& z = *m.z;
    const ex value = z.name(rule.value);
    Mechanism::Constraint made{.name = rule.name,
                               .holonomic = rule.holonomic,
                               .position = {},
                               .row = {},
                               .offset = 0,
                               .acceleration = 0,
                               .multiplier = rule.multiplier,
                               .place = rule.place};
    ex velocity = value;
    if (rule.holonomic) {
        made.position = value;
        made.row = z.pull_back({{value, 1}}, m.q);
        made.offset = m.explicit_time_derivative({value})[0];
        velocity = m.time_derivative({value})[0];
    } else {
        std::tie(made.row, made.offset) =
            linear_form(value, say("constraint '{}'", rule.name), rule.at, m, of_second_degree);
        if (!rule.drifts) made.offset = 0;
    }
    if (all_zero(made.row))
        throw SceneMistake{{rule.at, say("constraint '{}' contains no {}", rule.name,
                                         rule.holonomic ? say("coordinate") : say("rate"))}};
    made.acceleration = z.name(-m.time_derivative_without_acceleration({velocity})[0]);
    return made;
}

}  // namespace alembert
