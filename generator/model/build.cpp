// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <tuple>

#include "alembert/base/error.hpp"
#include "base/language/say.hpp"
#include "model/building.hpp"
#include "model/constraint.hpp"
#include "scene/text.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

// u = W q' + w
void add_speeds(Building& here) {
    const bool has_start = std::any_of(here.scene.speeds.begin(), here.scene.speeds.end(),
                                       [](const Speed& s) { return !!s.initial; });
    for (std::size_t i = 0; i < here.scene.speeds.size(); ++i)
        here.attempt([&] {
            const Speed& s = here.scene.speeds[i];
            const std::string what = say("speed '{}'", s.name.text);
            SourceScope source(*here.m.z, "speed " + s.name.text);
            Mechanism::Speed& made = here.m.speeds[i];
            made.form = here.m.z->name(here.translator.scalar(s.form));
            std::tie(made.row, made.offset) = linear_form(made.form, what, s.form.place(), here.m);
            if (all_zero(made.row)) throw SceneMistake{{s.form.place(), say("{} contains no rate", what)}};
            if (has_start) made.start = s.initial ? here.m.z->expand(here.translator.scalar(s.initial)) : ex(0);
        });
}

/// The multiplier of a row that holds in every position is none: what bears the load is another constraint, or a
/// place that is given.
void refuse_left_out(const Building& here, const Tree& tree, const Expression& in) {
    if (tree.kind == Tree::Kind::name &&
        std::find(here.left_out.begin(), here.left_out.end(), tree.text) != here.left_out.end())
        throw SceneMistake{{in.place(tree.offset),
                            say("there is no {}: along this direction nothing can move, whatever the coordinates "
                                "do, so that the row has no multiplier; eval --reactions has the forces there",
                                in_quotes(tree.text))}};
    for (const TreePtr& arg : tree.args) refuse_left_out(here, *arg, in);
}

void add_outputs(Building& here) {
    for (const Output& o : here.scene.outputs)
        here.attempt([&] {
            refuse_left_out(here, *o.value.tree, o.value);
            SourceScope source(*here.m.z, "output " + o.name.text);
            here.m.outputs.push_back({o.name.text, here.m.z->name(here.translator.scalar(o.value))});
        });
    for (const EventRule& e : here.scene.events)
        here.attempt([&] {
            SourceScope source(*here.m.z, "event " + e.name.text);
            here.m.events.push_back({e.name.text, here.m.z->name(here.translator.scalar(e.when))});
            Mechanism::EventAction action{.stop = e.stop, .direction = e.direction};
            if (!e.impulses.empty()) action.impulse.assign(here.m.q.size(), 0);
            for (const GeneralizedForce& f : e.impulses)
                for (int i = 0; i < here.m.size(); ++i)
                    if (here.m.q[i].get_name() == f.coordinate.text)
                        action.impulse[i] = here.m.z->name(here.translator.scalar(f.value));
            const auto position = [&](const auto& list, const std::string& name, const auto& symbol_of) {
                return static_cast<int>(
                    std::find_if(list.begin(), list.end(),
                                 [&](const auto& one) { return symbol_of(one).get_name() == name; }) -
                    list.begin());
            };
            const auto value = [&](const Expression& of) { return here.m.z->name(here.translator.scalar(of)); };
            for (const GeneralizedForce& one : e.set)
                action.set.emplace_back(position(here.m.states, one.coordinate.text,
                                                 [](const Mechanism::State& z) { return z.derivative[0]; }),
                                        value(one.value));
            for (const GeneralizedForce& one : e.rates)
                action.rates.emplace_back(
                    position(here.m.q, one.coordinate.text, [](const GiNaC::symbol& q) { return q; }),
                    value(one.value));
            for (const Name& told : e.record) action.record.push_back(told.text);
            action.count = e.count;
            here.m.event_actions.push_back(std::move(action));
        });
}

void add_run(Building& here) {
    const Simulation& s = here.scene.simulation;
    const auto value = [&](const Expression& e, std::optional<ex>& to) {
        here.attempt([&] {
            if (e) to = here.m.z->expand(here.translator.scalar(e));
        });
    };
    value(s.start, here.m.run.start);
    value(s.duration, here.m.run.duration);
    value(s.tolerance, here.m.run.tolerance);
    value(s.step, here.m.run.step);
    value(s.max_step, here.m.run.max_step);
    value(s.sample, here.m.run.sample);
    value(s.period, here.m.run.period);
    if (s.method) here.m.run.method = s.method->text;
    here.m.run.regularize = s.regularize;
}

}  // namespace

Building::Building(const Scene& of)
    : scene(of),
      translator(m, {.position = [this](const std::string& p) { return places.position(p); },
                     .velocity = [this](const std::string& p) { return places.velocity(p); },
                     .orientation = [this](const std::string& f) -> const Orientation& {
                         return places.orientation(f);
                     }}),
      places(of, m, translator) {}

double Building::number_at(const Expression& e) {
    try {
        return values->number(m.z->expand(translator.scalar(e)));
    } catch (const SceneMistake&) {
        throw;
    } catch (const std::exception&) {  // a pole, or beyond CLN's range
        return std::nan("");
    }
}

namespace {

Mechanism built(Building& here) {
    const Scene& scene = here.scene;
    if (scene.polynomial)
        throw ModelError(
            say("the scene has a [polynomial] and no mechanism, so it has no equations of motion; ask for its "
                "`stability`"));
    Mechanism& m = here.m;
    m.name = std::filesystem::path(scene.file).stem().string();
    m.title = scene.title;
    m.symbols = std::make_shared<Symbols>();
    m.z = std::make_shared<Intermediates>(*m.symbols);
    m.t = m.symbols->declare("t", SymbolInfo::Kind::time);
    here.translator.know("t", m.t);
    declare(here);
    add_loads(here);
    add_speeds(here);
    add_conditions(here);
    add_states(here);
    add_frictions(here);
    add_outputs(here);
    add_run(here);
    if (!here.mistakes.empty()) fail(scene, here.mistakes);
    m.skeleton = here.places.skeleton();
    return std::move(here.m);
}

}  // namespace

Mechanism build(const Scene& scene) {
    Building here(scene);
    return built(here);
}

OnSheets build_on_sheets(const Scene& scene) {
    Building here(scene);
    here.on_sheets = true;
    Mechanism mechanism = built(here);
    return {std::move(mechanism), here.sheets};
}

PolynomialScene polynomial_of(const Scene& scene) {
    Building here(scene);
    PolynomialScene result;
    here.m.symbols = std::make_shared<Symbols>();
    here.m.z = std::make_shared<Intermediates>(*here.m.symbols);
    here.m.t = here.m.symbols->declare("t", SymbolInfo::Kind::time);
    here.translator.know("t", here.m.t);
    declare(here);
    for (const Expression& coefficient : scene.polynomial->coefficients)
        here.attempt([&] {
            result.coefficients.push_back(here.m.z->expand(here.translator.scalar(coefficient)));
            if (!std::isfinite(here.number_at(coefficient)))
                throw SceneMistake{
                    {coefficient.place(),
                     say("{} is not a finite real number at the scene's values", say("this coefficient"))}};
        });
    if (!here.mistakes.empty()) fail(scene, here.mistakes);
    result.mechanism = std::move(here.m);
    return result;
}

}  // namespace alembert
