// SPDX-License-Identifier: GPL-2.0-or-later
// Dry friction (Coulomb): the force −μ N sign(v) along the sliding velocity v. While v stays 0, the sign is
// replaced by the number between −μₛ/μ and μₛ/μ that keeps it 0; a run finds that number
// (alembert/hybrid/filippov_system.hpp).
#include "model/friction.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "alembert/base/error.hpp"
#include "base/language/say.hpp"
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
    if (const double e = rule.restitution ? here.number_at(rule.restitution) : 0; !(e >= 0 && e <= 1))
        throw SceneMistake{{rule.restitution.place(),
                            say("the restitution of friction '{}' is {}; expected a number from 0 (it grips) to 1 "
                                "(the sliding velocity is reversed)",
                                rule.name.text, e)}};
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

void need_rate(Building& here, const ex& sliding_velocity, const Expression& given, const std::string& what) {
    const auto [row, offset] = linear_form(sliding_velocity, say("the slip of {}", what), given.place(), here.m);
    if (all_zero(row))
        throw SceneMistake{{given.place(), say("the slip of {} contains no rate, so nothing slides there", what)}};
}

std::vector<ex> components(const Mechanism::Friction& f) {
    return f.across ? std::vector{f.sliding_velocity, *f.across} : std::vector{f.sliding_velocity};
}

// −μ N sign(v), or −μ N v/|v|
std::vector<Load::Pair> pairs_of(const Mechanism::Friction& f, Intermediates& z) {
    std::vector<Load::Pair> pairs;
    const std::vector<ex> v = components(f);
    for (std::size_t i = 0; i < v.size(); ++i)
        pairs.push_back({v[i], z.name(-f.coefficient * f.normal * f.direction[i])});
    return pairs;
}

void add_friction(Building& here, const FrictionRule& rule, int index) {
    const Origin origin{Origin::Kind::friction, index, rule.name.text};
    const std::string what = shown_label(origin);
    SourceScope source(*here.m.z, label(origin));
    need_coefficients(here, rule);
    Mechanism::Friction made{.name = rule.name.text,
                             .sliding_velocity = here.m.z->name(here.translator.scalar(rule.sliding_velocity)),
                             .across = {},
                             .direction = {},
                             .coefficient = here.translator.scalar(rule.coefficient),
                             .resting = here.translator.scalar(rule.resting ? rule.resting : rule.coefficient),
                             .normal = 0,
                             .multiplier = {},
                             .restitution = rule.restitution ? here.translator.scalar(rule.restitution) : ex(0),
                             .place = rule.name.place};
    if (rule.on) {
        const Pressing by = pressing_on(here, rule);
        if (rule.restitution && by.may_pull)
            throw SceneMistake{
                {rule.restitution.place(), say("friction '{}' gives a 'restitution' on a constraint; "
                                               "only a [[unilateral]] contact has impacts",
                                               rule.name.text)}};
        made.multiplier = by.multiplier;
        made.normal = by.may_pull ? *here.translator.applied("abs", {by.multiplier}) : by.multiplier;
    } else {
        made.normal = here.translator.scalar(rule.normal);
    }
    need_rate(here, made.sliding_velocity, rule.sliding_velocity, what);
    if (rule.across) {
        made.across = here.m.z->name(here.translator.scalar(rule.across));
        need_rate(here, *made.across, rule.across, what);
        const ex speed =
            here.m.z->name(pow(pow(made.sliding_velocity, 2) + pow(*made.across, 2), GiNaC::numeric(1, 2)));
        made.direction = {here.m.z->name(made.sliding_velocity / speed), here.m.z->name(*made.across / speed)};
    } else {
        made.direction = {*here.translator.applied("sign", {made.sliding_velocity})};
    }
    here.m.loads.push_back({.origin = origin, .pairs = pairs_of(made, *here.m.z)});
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

std::vector<int> frictions_in_planes(const Mechanism& m, const std::vector<int>& closed) {
    std::vector<int> result;
    for (std::size_t k = 0; k < m.frictions.size(); ++k) {
        const Mechanism::Friction& f = m.frictions[k];
        if (!f.across) continue;
        const auto contact = std::find_if(m.unilateral.begin(), m.unilateral.end(), [&](const auto& u) {
            return f.multiplier && u.gap.multiplier.is_equal(*f.multiplier);
        });
        if (contact == m.unilateral.end() ||
            std::find(closed.begin(), closed.end(), contact - m.unilateral.begin()) != closed.end())
            result.push_back(static_cast<int>(k));
    }
    return result;
}

Mechanism with_directions_held(Mechanism m, const std::vector<int>& frictions) {
    std::vector<GiNaC::symbol> modes, sides;
    const auto add = [&](const std::string& name, double value) {
        const GiNaC::symbol s =
            m.symbols->declare(name, SymbolInfo::Kind::parameter, static_cast<int>(m.parameters.size()));
        m.parameters.push_back({.symbol = s, .value = GiNaC::numeric(value), .unit = "", .about = ""});
        return s;
    };
    const std::vector<double> values = directions_by_default(frictions.size());
    for (std::size_t i = 0; i < 2 * frictions.size(); ++i)
        modes.push_back(add(fmt::format("mode_{}", i + 1), values[i]));
    for (std::size_t i = 0; i < 2 * frictions.size(); ++i)
        sides.push_back(add(fmt::format("direction_{}", i + 1), values[2 * frictions.size() + i]));
    for (std::size_t c = 0; c < frictions.size(); ++c) {
        Mechanism::Friction& f = m.frictions[static_cast<std::size_t>(frictions[c])];
        const ex slides = modes[2 * c], smoothing = modes[2 * c + 1], p = sides[2 * c], q = sides[2 * c + 1];
        const ex ahead = m.z->name(f.sliding_velocity * p + *f.across * q + smoothing),
                 turn = m.z->name((*f.across * p - f.sliding_velocity * q) / ahead),
                 length = m.z->name(pow(1 + pow(turn, 2), GiNaC::numeric(1, 2)));
        f.direction = {m.z->name((1 - slides) * p + slides * (p - turn * q) / length),
                       m.z->name((1 - slides) * q + slides * (q + turn * p) / length)};
        f.is_held = true;
        for (Load& load : m.loads)
            if (load.origin.kind == Origin::Kind::friction && load.origin.index == frictions[c])
                load.pairs = pairs_of(f, *m.z);
    }
    return m;
}

std::vector<double> directions_by_default(std::size_t frictions) {
    std::vector<double> values;
    for (std::size_t k = 0; k < 2 * frictions; ++k) values.insert(values.end(), {1, 0});
    return values;
}

Mechanism without_plane_friction(Mechanism m) {
    std::erase_if(m.loads, [&](const Load& load) {
        return load.origin.kind == Origin::Kind::friction &&
               m.frictions[static_cast<std::size_t>(load.origin.index)].across;
    });
    return m;
}

void add_frictions(Building& here) {
    for (std::size_t k = 0; k < here.scene.frictions.size(); ++k)
        here.attempt([&] { add_friction(here, here.scene.frictions[k], static_cast<int>(k)); });
}

}  // namespace alembert
