// SPDX-License-Identifier: GPL-2.0-or-later
// Dry friction (Coulomb): the force −μ N sign(v) along the sliding velocity v. While v stays 0, the sign is
// replaced by the number between −μₛ/μ and μₛ/μ that keeps it 0; a run finds that number (alembert/switching.hpp).
#include "model/friction.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "alembert/error.hpp"
#include "language/say.hpp"
#include "model/building.hpp"
#include "model/constraint.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

/// Checks the coefficients at the scene's parameters, if they are numbers there.
void need_coefficients(Building& here, const FrictionRule& rule) {
    const double sliding = here.number_at(rule.coefficient);
    if (sliding < 0)
        throw SceneMistake{
            {rule.coefficient.place(),
             say("the coefficient of friction '{}' is {}; expected 0 or more", rule.name.text, sliding)}};
    if (!rule.resting) return;
    const double resting = here.number_at(rule.resting);
    if (resting < sliding)
        throw SceneMistake{
            {rule.resting.place(), say("the static coefficient of friction '{}' is {}, less than its coefficient "
                                       "{}; what sticks resists at least as much as what slides",
                                       rule.name.text, resting, sliding)}};
    if (sliding == 0 && resting > 0)
        throw SceneMistake{
            {rule.coefficient.place(), say("friction '{}' has a static coefficient and slides without any; give a "
                                           "coefficient above 0, however small",
                                           rule.name.text)}};
}

/// The multiplier of the constraint, row or contact of that name.
struct Pressing {
    GiNaC::symbol multiplier;
    bool may_pull;
};

Pressing pressing_on(Building& here, const FrictionRule& rule) {
    std::vector<std::string> known;
    for (const Mechanism::Unilateral& contact : here.m.unilateral) {
        if (contact.gap.name == rule.on->text) return {contact.gap.multiplier, false};
        known.push_back(contact.gap.name);
    }
    for (const Mechanism::Constraint& c : here.m.constraints) {
        if (c.name == rule.on->text) return {c.multiplier, true};
        known.push_back(c.name);
    }
    const std::string meant = nearest(rule.on->text, known);
    throw SceneMistake{
        {rule.on->place,
         say("friction '{}' is on '{}', and no constraint, row of a rolling or joint, or unilateral has this "
             "name and a multiplier{}",
             rule.name.text, rule.on->text,
             !meant.empty()  ? say("; did you mean '{}'?", meant)
             : known.empty() ? ""
                             : say("; there are {}", fmt::join(known, ", ")))}};
}

// −μ N sign(v)
void add_friction(Building& here, const FrictionRule& rule, int index) {
    const Origin origin{Origin::Kind::friction, index, rule.name.text};
    const std::string what = shown_label(origin);
    SourceScope source(*here.m.z, label(origin));
    need_coefficients(here, rule);
    Mechanism::Friction made{.name = rule.name.text,
                             .slip = here.m.z->name(here.translator.scalar(rule.slip)),
                             .coefficient = here.translator.scalar(rule.coefficient),
                             .resting = here.translator.scalar(rule.resting ? rule.resting : rule.coefficient),
                             .normal = 0,
                             .multiplier = {},
                             .place = rule.name.place};
    if (rule.on) {
        const Pressing by = pressing_on(here, rule);
        made.multiplier = by.multiplier;
        made.normal = by.may_pull ? *here.translator.applied("abs", {by.multiplier}) : by.multiplier;
    } else {
        made.normal = here.translator.scalar(rule.normal);
    }
    const auto [row, drift] = linear_form(made.slip, say("the slip of {}", what), rule.slip.place(), here.m);
    if (all_zero(row))
        throw SceneMistake{
            {rule.slip.place(), say("the slip of {} contains no rate, so nothing slides there", what)}};
    const ex side = *here.translator.applied("sign", {made.slip});
    here.m.loads.push_back(
        {.origin = origin, .pairs = {{made.slip, here.m.z->name(-made.coefficient * made.normal * side)}}});
    here.m.frictions.push_back(std::move(made));
}

}  // namespace

void need_given_normal_forces(const Mechanism& m, std::string_view who) {
    for (const Mechanism::Friction& f : m.frictions)
        if (f.multiplier)
            throw ModelError(
                say("{} does not know friction whose normal force is a reaction, as that of "
                    "'{}'; give it as an expression, `normal`, in place of `on`",
                    who, f.name));
}

void add_frictions(Building& here) {
    for (std::size_t k = 0; k < here.scene.frictions.size(); ++k)
        here.attempt([&] { add_friction(here, here.scene.frictions[k], static_cast<int>(k)); });
}

}  // namespace alembert
