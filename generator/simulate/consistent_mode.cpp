// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/consistent_mode.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "alembert/base/error.hpp"
#include "alembert/hybrid/filippov_system.hpp"
#include "alembert/hybrid/side_choice.hpp"
#include "alembert/hybrid/sliding_field.hpp"
#include "base/language/say.hpp"

namespace alembert {

namespace {

constexpr double on_zero = 1e-12;  // a sliding velocity below this, relative to the rates, is zero
constexpr double jammed = 1e-3;    // a determinant of the normal forces below this, of 1 without friction

/// The program in the form that the runtime needs, evaluated by interpretation; y is q, followed by the rates or
/// speeds.
FilippovSystem interpreted(const Switched& s, const State<double>& state) {
    const std::size_t held = static_cast<std::size_t>(s.held()), n = state.q.size(), all = n + state.qdot.size();
    const auto at = [state, n](double t, const double* y, const double* sigma, std::size_t signs) {
        State<double> here = state;
        here.t = t;
        std::copy_n(y, n, here.q.begin());
        std::copy_n(y + n, here.qdot.size(), here.qdot.begin());
        here.parameters.insert(here.parameters.end(), sigma, sigma + signs);
        return here;
    };
    const auto events_from = [&s, at, held, n](std::size_t before_end, std::size_t count) {
        return [=, &s](double t, const double* y, const double* sigma, const double* rate, double* out) {
            State<double> here = at(t, y, sigma, held);
            here.qddot.assign(rate + n, rate + n + here.qdot.size());
            const std::vector<double> value = interpret(s.program, here);
            const std::vector<int> nodes = s.program.nodes_of(Group::event);
            const std::size_t first = nodes.size() - before_end;
            for (std::size_t k = 0; k < count; ++k) out[k] = value[static_cast<std::size_t>(nodes[first + k])];
        };
    };
    FilippovSystem system;
    system.names.resize(s.functions.size());
    system.pairs = s.pairs;
    system.rates = [&s, at, held, n, all](double t, const double* y, const double* sigma, double* rate) {
        const std::vector<double> value = interpret(s.program, at(t, y, sigma, held));
        const std::vector<int> first = s.program.nodes_of(Group::rate),
                               second = s.program.nodes_of(Group::acceleration);
        for (std::size_t i = 0; i < n; ++i)
            rate[i] = first.empty() ? y[n + i] : value[static_cast<std::size_t>(first[i])];
        for (std::size_t i = n; i < all; ++i) rate[i] = value[static_cast<std::size_t>(second[i - n])];
    };
    system.positional = s.positional;
    system.values = events_from(s.events(), system.numbers());
    if (s.bounds() > 0) system.bounds = events_from(s.bounds(), s.bounds());
    return system;
}

std::vector<double> with_rates(const State<double>& state) {
    std::vector<double> y = state.q;
    y.insert(y.end(), state.qdot.begin(), state.qdot.end());
    return y;
}

}  // namespace

ConsistentMode consistent_mode(const Switched& s, State<double> state) {
    const FilippovSystem system = interpreted(s, state);
    const std::vector<double> y = with_rates(state);
    double fastest = 0;
    for (const double rate : state.qdot) fastest = std::max(fastest, std::abs(rate));
    FilippovMode found;
    const std::vector<double> sigma = consistent_signs(
        system, [&](int) { return on_zero * fastest; }, state.t, y.data(), static_cast<int>(y.size()), &found);
    ConsistentMode held{.program = s.program, .state = std::move(state), .frictions = {}};
    held.state.parameters.insert(held.state.parameters.end(), sigma.begin(), sigma.end());
    std::vector<const Root*> names;
    for (const Root& root : held.program.roots)
        if (root.group == Group::sliding_velocity) names.push_back(&root);
    const std::vector<double> value = interpret(held.program, held.state);
    for (const Root& root : held.program.roots)
        if (root.group == Group::determinant && !(value[static_cast<std::size_t>(root.node)] > 0))
            throw IntegrationError(
                say("at t = {:.15g} no mode of friction '{}' is consistent, or more than one is (Painlevé): the "
                    "determinant of the equation for its normal force is {:.6g}, and not positive",
                    held.state.t, root.name, value[static_cast<std::size_t>(root.node)]),
                held.state.t, held.state.q);
    for (const Root& root : held.program.roots) {
        const double normal = value[static_cast<std::size_t>(root.node)];
        if (root.group == Group::normal && normal < 0 && std::abs(normal) > on_zero)
            throw IntegrationError(say("the normal force of friction '{}' is {:.6g} at t = {:.15g}; give one that "
                                       "is never negative, such "
                                       "as max(0, …), or abs(…) where it acts on both sides",
                                       root.name, normal, held.state.t),
                                   held.state.t, held.state.q);
    }
    const auto name = [&](std::size_t k, std::size_t i) {
        return names[static_cast<std::size_t>(s.frictions[k][i].friction)]->name;
    };
    for (int c = 0; c < s.pairs; ++c)
        held.frictions.emplace_back(name(static_cast<std::size_t>(2 * c), 0),
                                    sigma[static_cast<std::size_t>(2 * c)] == 0 ? 0 : 1);
    for (std::size_t k = 2 * static_cast<std::size_t>(s.pairs); k < found.size(); ++k)
        for (std::size_t i = 0; i < s.frictions[k].size(); ++i) {
            const double sign = sigma[system.place(static_cast<int>(k))];
            const bool sticks = found[k] == 0 && std::abs(sign) != 1;
            held.frictions.emplace_back(name(k, i),
                                        sticks ? 0 : s.frictions[k][i].direction * (sign > 0 ? 1 : -1));
        }
    return held;
}

std::optional<ConsistentMode> standing_state(const Switched& s, State<double> state) {
    constexpr std::size_t most_open = 6;  // as many as a run lets change together
    const FilippovSystem system = interpreted(s, state);
    const std::vector<double> y = with_rates(state), none(y.size());
    std::vector<double> g(system.numbers());
    FilippovMode sides = system.start();
    std::vector<int> open;
    for (int k = 0; k < system.count(); ++k) {  // a function may contain the signs of those before it
        const auto at = static_cast<std::size_t>(k);
        system.values(state.t, y.data(), system.sigma(sides).data(), none.data(), g.data());
        sides[at] = g[at] < 0 ? -1 : 1;
        if (g[at] == 0) open.push_back(k);
    }
    if (open.empty() || open.size() > most_open) return std::nullopt;
    const std::vector<SideChoice> choices = side_choices(system, sides, open, state.t, y);
    if (!choices[0].is_consistent() || are_ambiguous(choices)) return std::nullopt;
    SlidingField at(system, choices[0].sides, static_cast<int>(y.size()));
    at.evaluate(state.t, y.data());
    ConsistentMode held{.program = s.program, .state = std::move(state), .frictions = {}};
    held.state.parameters.insert(held.state.parameters.end(), at.sigma().begin(), at.sigma().end());
    return held;
}

std::optional<std::string> jamming_friction(const Switched& s, const State<double>& state) try {
    const ConsistentMode held = consistent_mode(s, state);
    const std::vector<double> value = interpret(held.program, held.state);
    const auto of = [&](Group group) {
        std::vector<double> numbers;
        for (const int node : held.program.nodes_of(group))
            numbers.push_back(value[static_cast<std::size_t>(node)]);
        return numbers;
    };
    const std::vector<double> determinants = of(Group::determinant), normals = of(Group::normal);
    std::vector<std::string> names;
    for (const Root& root : held.program.roots)
        if (root.group == Group::determinant) names.push_back(root.name);
    // Frictions on reactions share one determinant; that with the largest force jams.
    std::optional<std::size_t> found;
    for (std::size_t k = 0; k < names.size(); ++k)
        if (determinants[k] < jammed && (!found || std::abs(normals[k]) > std::abs(normals[*found]))) found = k;
    if (found)
        return say(
            "friction '{}' jams: it makes its normal force {:.3g} times as large as it would be without "
            "friction, and larger beyond all bounds (Painlevé); a smaller coefficient has a motion there",
            names[*found], 1 / determinants[*found]);
    return std::nullopt;
} catch (const IntegrationError&) {  // no mode is consistent there
    return std::nullopt;
}

std::vector<double> with_held_parameters(std::vector<double> of_scene, const Program& program) {
    for (std::size_t k = of_scene.size(); k < program.parameters.size(); ++k)
        of_scene.push_back(program.parameters[k].value);
    return of_scene;
}

}  // namespace alembert
