// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "alembert/base/inertia.hpp"
#include "base/language/say.hpp"
#include "model/building.hpp"

namespace alembert {

using GiNaC::numeric;

namespace {

bool is_constant(const GiNaC::ex& e) {
    return !GiNaC::is_a<GiNaC::symbol>(e) &&
           std::all_of(e.begin(), e.end(), [](const GiNaC::ex& part) { return is_constant(part); });
}

void declare_parameters(Building& here) {
    for (std::size_t i = 0; i < here.scene.parameters.size(); ++i) {
        const Parameter& p = here.scene.parameters[i];
        const auto s = here.m.symbols->declare(p.name.text, SymbolInfo::Kind::parameter, static_cast<int>(i));
        here.translator.know(p.name.text, s);
        here.m.parameters.push_back({.symbol = s, .value = 0, .unit = p.unit, .about = p.about, .shown = p.shown});
    }
    for (std::size_t i = 0; i < here.scene.parameters.size(); ++i)
        here.attempt([&] {
            here.m.parameters[i].value = here.m.z->expand(here.translator.scalar(here.scene.parameters[i].value));
            here.m.parameters[i].independent = is_constant(here.m.parameters[i].value);
        });
}

/// A parameter behind those of the scene, known to nobody by its name but through the input.
GiNaC::ex given_from_outside(Building& here, const Input& input, const GiNaC::ex& value) {
    const auto s = here.m.symbols->declare(input.name.text, SymbolInfo::Kind::parameter,
                                           static_cast<int>(here.m.parameters.size()));
    here.m.parameters.push_back({.symbol = s,
                                 .value = value,
                                 .from_outside = true,
                                 .unit = input.unit,
                                 .about = input.about,
                                 .shown = input.shown});
    return s;
}

void declare_inputs(Building& here) {
    for (std::size_t i = 0; i < here.scene.inputs.size(); ++i) {
        const Input& input = here.scene.inputs[i];
        Mechanism::Input made{.derivative = {}, .value = 0, .unit = input.unit};
        for (int order = 0; order < 3; ++order)
            made.derivative[order] =
                here.m.symbols->declare(input.name.text, SymbolInfo::Kind::input, static_cast<int>(i), order);
        here.translator.know(input.name.text, made.derivative[0]);
        here.m.inputs.push_back(made);
    }
    for (std::size_t i = 0; i < here.scene.inputs.size(); ++i)
        here.attempt([&] {
            const GiNaC::ex value = here.translator.scalar(here.scene.inputs[i].value);
            here.m.inputs[i].value = here.scene.inputs[i].from_outside
                                         ? given_from_outside(here, here.scene.inputs[i], here.m.z->expand(value))
                                         : here.m.z->name(value);
        });
}

void declare_coordinates(Building& here) {
    for (std::size_t i = 0; i < here.scene.coordinates.size(); ++i) {
        const Coordinate& c = here.scene.coordinates[i];
        const int index = static_cast<int>(i);
        here.m.q.push_back(here.m.symbols->declare(c.name.text, SymbolInfo::Kind::coordinate, index, 0));
        here.m.qdot.push_back(here.m.symbols->declare(c.name.text, SymbolInfo::Kind::coordinate, index, 1));
        here.m.qddot.push_back(here.m.symbols->declare(c.name.text, SymbolInfo::Kind::coordinate, index, 2));
        here.m.units.push_back(c.unit);
        here.m.shown_units.push_back(c.shown);
        here.m.q_is_guess.push_back(c.initial_is_guess);
        here.m.qdot_is_guess.push_back(c.rate_is_guess);
    }
    for (std::size_t i = 0; i < here.scene.speeds.size(); ++i) {
        const Speed& s = here.scene.speeds[i];
        const int index = static_cast<int>(i);
        here.m.speeds.push_back({.u = here.m.symbols->declare(s.name.text, SymbolInfo::Kind::speed, index, 0),
                                 .udot = here.m.symbols->declare(s.name.text, SymbolInfo::Kind::speed, index, 1),
                                 .form = 0,
                                 .row = {},
                                 .offset = 0,
                                 .start = {},
                                 .unit = s.unit,
                                 .place = s.name.place,
                                 .shown = s.shown});
    }
    for (const Coordinate& c : here.scene.coordinates) {
        here.m.q_start.emplace_back(0);
        here.m.qdot_start.emplace_back(0);
        here.attempt([&] {
            here.m.q_start.back() = here.m.z->expand(here.translator.scalar(c.initial));
            here.m.qdot_start.back() = here.m.z->expand(here.translator.scalar(c.rate));
        });
    }
}

void declare_states(Building& here) {
    for (std::size_t i = 0; i < here.scene.states.size(); ++i) {
        const FirstOrderState& z = here.scene.states[i];
        Mechanism::State made{.derivative = {},
                              .rate = 0,
                              .start = 0,
                              .unit = z.unit,
                              .about = z.about,
                              .place = z.name.place,
                              .shown = z.shown};
        for (int order = 0; order < 3; ++order)
            made.derivative[order] =
                here.m.symbols->declare(z.name.text, SymbolInfo::Kind::state, static_cast<int>(i), order);
        here.translator.know(z.name.text, made.derivative[0]);
        here.attempt([&] { made.start = here.m.z->expand(here.translator.scalar(z.initial)); });
        here.m.states.push_back(std::move(made));
    }
}

void declare_functions(Building& here) {
    for (std::size_t i = 0; i < here.scene.functions.size(); ++i) {
        here.translator.know_function(here.m.symbols->declare(here.scene.functions[i].name.text,
                                                              SymbolInfo::Kind::function, static_cast<int>(i)));
        here.m.tables.push_back(here.scene.functions[i].table);
    }
}

void define(Building& here) {
    for (const Speed& s : here.scene.speeds)
        here.translator.know_later(s.name.text, [&here, &s] {
            SourceScope source(*here.m.z, "speed " + s.name.text);
            return Value(here.m.z->name(here.translator.scalar(s.form)));
        });
    for (const Definition& d : here.scene.definitions)
        here.translator.know_later(d.name.text, [&here, &d] {
            SourceScope source(*here.m.z, "definition " + d.name.text);
            return here.translator.value(d.value);
        });
    for (const Definition& d : here.scene.definitions)
        here.attempt([&] {
            const Tree self{.kind = Tree::Kind::name, .text = d.name.text};
            const Expression whole{d.name.text, {d.name.place}, std::make_shared<Tree>(self)};
            const Value value = here.translator.value(whole);
            if (const auto* scalar = std::get_if<GiNaC::ex>(&value))
                here.m.definitions.push_back({d.name.text, *scalar});
        });
}

/// If `least` is given, the value must not be less.
void require(Building& here, const Expression& e, const std::string& what, std::optional<double> least = {}) {
    here.attempt([&] {
        const double value = here.number_at(e);
        if (!std::isfinite(value))
            throw SceneMistake{{e.place(), say("{} is not a finite real number at the scene's values", what)}};
        if (least && value < *least)
            throw SceneMistake{{e.place(), say("{} is {}; expected zero or more", what, value)}};
    });
}

/// Of parameters and the start, which stand in no definition: whoever counts with them may rely on numbers.
void check_given(Building& here) {
    for (const Parameter& p : here.scene.parameters) require(here, p.value, say("parameter '{}'", p.name.text));
    for (const Coordinate& c : here.scene.coordinates) {
        require(here, c.initial, say("the initial value of '{}'", c.name.text));
        require(here, c.rate, say("the initial rate of '{}'", c.name.text));
    }
    for (const Speed& s : here.scene.speeds)
        if (s.initial) require(here, s.initial, say("the initial value of '{}'", s.name.text));
    for (const FirstOrderState& z : here.scene.states)
        require(here, z.initial, say("the initial value of '{}'", z.name.text));
    if (here.scene.simulation.start) require(here, here.scene.simulation.start, say("the start"));
    if (!here.mistakes.empty()) fail(here.scene, here.mistakes);
}

void check_masses(Building& here) {
    for (const Particle& p : here.scene.particles)
        if (!p.leaves) require(here, p.mass, say("the mass of particle '{}'", p.name.text), 0);
    for (const Body& b : here.scene.bodies) {
        require(here, b.mass, say("the mass of body '{}'", b.name.text), 0);
        if (!b.inertia) continue;
        const std::string what = say("the moment of inertia of body '{}'", b.name.text);
        if (b.inertia->planar) {
            require(here, *b.inertia->planar, what, 0);
            continue;
        }
        double largest = 0;  // relative to this, a negative moment may be rounding
        for (std::size_t k = 0; k < 3; ++k)
            here.attempt([&] { largest = std::max(largest, std::abs(here.number_at(b.inertia->tensor[k]))); });
        for (std::size_t k = 0; k < 6; ++k)
            require(here, b.inertia->tensor[k], what,
                    k < 3 ? std::optional(-rounded_moment * largest) : std::nullopt);
    }
    for (const Armature& rotor : here.scene.armatures)
        require(here, rotor.inertia, say("the armature of '{}'", rotor.coordinate.text), 0);
    if (!here.mistakes.empty()) fail(here.scene, here.mistakes);
}

}  // namespace

void declare(Building& here) {
    // Tables have values, which parameters, inputs and the start may hold.
    const auto& functions = here.scene.functions;
    const bool has_tables =
        std::any_of(functions.begin(), functions.end(), [](const auto& f) { return f.table != nullptr; });
    if (has_tables) declare_functions(here);
    declare_parameters(here);
    declare_inputs(here);
    declare_coordinates(here);
    declare_states(here);
    if (!has_tables) declare_functions(here);
    if (here.mistakes.empty()) {
        here.values.emplace(here.m);
        check_given(here);
        if (here.on_sheets) here.translator.go_on(here.sheets = std::make_shared<RootSheets>(here.m));
    }
    define(here);
    if (!here.mistakes.empty()) fail(here.scene, here.mistakes);
    check_masses(here);
}

}  // namespace alembert
