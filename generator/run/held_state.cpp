// SPDX-License-Identifier: GPL-2.0-or-later
#include "run/held_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "alembert/error.hpp"
#include "alembert/switching.hpp"
#include "language/say.hpp"

namespace alembert {

namespace {

constexpr double on_zero = 1e-12;  // a sliding velocity below this, relative to the rates, is zero

/// The program in the form that the runtime needs, evaluated by interpretation; y is q, followed by the rates or
/// speeds.
Switching interpreted(const Switched& s, const State<double>& state) {
    const std::size_t count = s.functions.size(), n = state.q.size(), all = n + state.qdot.size();
    const auto at = [state, n](double t, const double* y, const double* sigma, std::size_t signs) {
        State<double> here = state;
        here.t = t;
        std::copy_n(y, n, here.q.begin());
        std::copy_n(y + n, here.qdot.size(), here.qdot.begin());
        here.parameters.insert(here.parameters.end(), sigma, sigma + signs);
        return here;
    };
    const auto events = [&s, at, count, n](std::size_t before_end) {
        return [=, &s](double t, const double* y, const double* sigma, const double* rate, double* out) {
            State<double> here = at(t, y, sigma, count);
            here.qddot.assign(rate + n, rate + n + here.qdot.size());
            const std::vector<double> value = interpret(s.program, here);
            const std::vector<int> nodes = s.program.nodes_of(Group::event);
            for (std::size_t k = 0; k < 2 * count; ++k)
                out[k] = value[static_cast<std::size_t>(nodes[nodes.size() - before_end + k])];
        };
    };
    Switching system;
    system.names.resize(count);
    system.rates = [&s, at, count, n, all](double t, const double* y, const double* sigma, double* rate) {
        const std::vector<double> value = interpret(s.program, at(t, y, sigma, count));
        const std::vector<int> first = s.program.nodes_of(Group::rate),
                               second = s.program.nodes_of(Group::acceleration);
        for (std::size_t i = 0; i < n; ++i)
            rate[i] = first.empty() ? y[n + i] : value[static_cast<std::size_t>(first[i])];
        for (std::size_t i = n; i < all; ++i) rate[i] = value[static_cast<std::size_t>(second[i - n])];
    };
    const std::size_t more = s.has_frictions() ? 2 * count : 0;
    system.values = events(2 * count + more);
    if (more > 0) system.bounds = events(more);
    return system;
}

}  // namespace

HeldState held_state(const Switched& s, State<double> state) {
    const std::size_t count = s.functions.size();
    const Switching system = interpreted(s, state);
    std::vector<double> y = state.q, sigma(count, 1.0), g(2 * count);
    y.insert(y.end(), state.qdot.begin(), state.qdot.end());
    const std::vector<double> none(y.size());
    double fastest = 0;
    for (const double rate : state.qdot) fastest = std::max(fastest, std::abs(rate));
    std::vector<int> sides(count);
    for (std::size_t k = 0; k < count; ++k) {  // a function may contain the signs of those before it
        system.values(state.t, y.data(), sigma.data(), none.data(), g.data());
        sides[k] = std::abs(g[k]) <= on_zero * fastest ? 0 : g[k] > 0 ? 1 : -1;
        sigma[k] = sides[k];
    }
    const std::vector<int> found = sides;
    sigma = consistent_signs(system, sides, state.t, y.data(), static_cast<int>(y.size()));
    HeldState held{.program = s.program, .state = std::move(state), .frictions = {}};
    held.state.parameters.insert(held.state.parameters.end(), sigma.begin(), sigma.end());
    std::vector<const Root*> names;
    for (const Root& root : held.program.roots)
        if (root.group == Group::slip) names.push_back(&root);
    const std::vector<double> value = interpret(held.program, held.state);
    for (const Root& root : held.program.roots)
        if (root.group == Group::determinant && !(value[static_cast<std::size_t>(root.node)] > 0))
            throw IntegrationError(
                say("at t = {:.15g} no mode of friction '{}' is consistent, or more than one is (Painlevé): the "
                    "determinant of the equation for its normal force is {:.6g}, and not positive",
                    held.state.t, root.name, value[static_cast<std::size_t>(root.node)]),
                held.state.t, held.state.q);
    for (std::size_t k = 0; k < count; ++k)
        for (const Switched::Rubbing& one : s.frictions[k]) {
            const bool sticks = found[k] == 0 && std::abs(sigma[k]) != 1;
            held.frictions.emplace_back(names[static_cast<std::size_t>(one.friction)]->name,
                                        sticks ? 0 : one.direction * (sigma[k] > 0 ? 1 : -1));
        }
    return held;
}

}  // namespace alembert
