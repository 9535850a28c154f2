// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/linear/about.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "alembert/base/error.hpp"
#include "alembert/base/tolerances.hpp"
#include "algebra/notation/readable.hpp"
#include "algebra/notation/text.hpp"
#include "analysis/contact/contacts.hpp"
#include "analysis/state/assemble.hpp"
#include "base/language/say.hpp"
#include "model/constant.hpp"
#include "model/formalism/needs.hpp"
#include "model/friction.hpp"
#include "program/lower/lower.hpp"
#include "stability/linear/linearize_symbolic.hpp"
#include "stability/linear/steady.hpp"

namespace alembert {

namespace {

constexpr std::size_t widest = 60;  // the most letters of an element in symbols

using SymbolRows = decltype(LinearizedScene::symbols);

/// The initial values of the scene, or exactly those that were requested.
std::vector<GiNaC::ex> starts(const Mechanism& m, const LinearizeOptions& options, const std::string& prime) {
    std::vector<GiNaC::ex> values = prime.empty() ? m.q_start : m.qdot_start;
    for (const auto& [name, number] : options.exact_at)
        for (int i = 0; i < m.size(); ++i)
            if (m.q[i].get_name() + prime == name) values[i] = constant_value(number);
    return values;
}

SymbolRows in_symbols(const Linearization& near, const Derived& d, const LinearizeOptions& options) {
    const Mechanism& m = d.mechanism;
    if (!near.paired || static_cast<int>(near.speeds.size()) != m.size()) return {};
    const auto found = symbolic_matrices(m, d.equations, starts(m, options, ""), starts(m, options, "'"));
    if (!found) return {};
    std::vector<int> order;
    for (const std::string& speed : near.speeds)
        for (int i = 0; i < m.size(); ++i)
            if (m.q[i].get_name() + "'" == speed) order.push_back(i);
    if (static_cast<int>(order.size()) != m.size()) return {};
    SymbolRows result;
    for (const auto& [name, matrix] :
         {std::pair("M", &found->M), std::pair("C", &found->C), std::pair("G", &found->G),
          std::pair("K", &found->K), std::pair("N", &found->N)}) {
        result.push_back({name, {}});
        for (const int i : order) {
            result.back().second.emplace_back();
            for (const int j : order) {
                const auto f = fourier((*matrix)(i, j), *m.symbols);
                if (!f) return {};
                result.back().second.back().push_back(text(readable(*f)));
                if (result.back().second.back().back().size() > widest) return {};
            }
        }
    }
    return result;
}

/// A sledge that runs straight has constant speeds along and across its axes, but not along x and y: if rates are
/// not steady, Kane's speeds may be.
void choose_speeds(Derived& d, const LinearizeOptions& options, const Start& start) {
    const std::vector<Mechanism::Constraint>& all = d.mechanism.constraints;
    const bool nonholonomic = std::any_of(all.begin(), all.end(), [](const auto& c) { return !c.holonomic; });
    const Formalism& minimal = formalism_for(Need::minimal_speeds);
    if (!nonholonomic || !options.by.empty() || !d.mechanism.speeds.empty() || minimal.obstacle(d.mechanism) ||
        is_steady(d.mechanism, d.equations, start))
        return;
    Derived other = derived_again(d, d.mechanism, minimal.name);
    if (!is_steady(other.mechanism, other.equations, start)) return;
    d.mechanism = std::move(other.mechanism);
    d.equations = std::move(other.equations);
}

/// Contacts that are closed and stay so become constraints of the mechanism.
void close_contacts(Derived& d, const Start& start) {
    need_rates(d);
    const ContactView view(d.mechanism);
    const State<double> state = start.state();
    check_gaps(d.scene, d.mechanism, view, state, tolerance::closed_gap);
    const LastingContacts lasting = contacts_at_rest(view, state, tolerance::closed_gap);
    const std::vector<std::string> idle = touching_without_force(view, state, lasting);
    if (!idle.empty())
        throw ModelError(say(
            "contact {} touches at this state without a force: it presses on one side of the state and opens on "
            "the other, so the equations of motion have no first derivative there. Give a state in "
            "which the contact presses or is open, or leave the contact out",
            fmt::join(idle, ", ")));
    if (!lasting.closed.empty())
        d = derived_again(d, with_closed(d.mechanism, lasting.closed), formalism_for(Need::multipliers).name);
}

/// About the state that Newton's method reaches from the start; nothing if there is none, or it is refused.
std::optional<LinearizedScene> linearize_near(const LinearizedScene& begun, const LinearizeOptions& options) {
    const auto reached = steady_nearby(begun.mechanism, begun.equations, begun.start);
    if (reached.empty()) return {};
    LinearizeOptions there = options;
    there.exact_at = reached;
    for (const auto& [name, value] : reached) there.at.emplace_back(name, std::stod(value));
    try {
        LinearizedScene result = linearize(begun.scene, there);
        result.reached = reached;
        return result;
    } catch (const ModelError&) {
        return {};
    } catch (const IntegrationError&) {
        return {};
    }
}

}  // namespace

LinearizedScene linearize(Scene scene, const LinearizeOptions& options) {
    LinearizedScene result{derived(std::move(scene), {.by = options.by, .at = options.at, .with_states = true})};
    need_given_normal_forces(result.mechanism, "linearize");
    result.start = start_of(result.mechanism, options.at);
    assemble(result.start, result.mechanism, lower_constraints(result.mechanism), options.at);
    if (!result.mechanism.unilateral.empty()) close_contacts(result, result.start);
    if (options.along) {
        result.about = About::any;
        const std::vector<Start> states = states_along(result, result.start, *options.along);
        std::function<void(double)> told;
        if (options.along->progress)
            told = [&](double part) { options.along->progress(say("the matrices"), part); };
        result.along = linearize_along(result.mechanism, result.equations, states, told);
        for (const Start& state : states) result.times.push_back(state.t);
        result.matrices = result.along.front();
        return result;
    }
    result.about = options.about;
    if (result.about == About::any) {
        result.matrices = linearize(result.mechanism, result.equations, result.start, About::any);
        return result;
    }
    choose_speeds(result, options, result.start);
    if (options.at.empty() && !is_steady(result.mechanism, result.equations, result.start))
        if (std::optional<LinearizedScene> other = linearize_near(result, options)) return std::move(*other);
    result.matrices = linearize(result.mechanism, result.equations, result.start);
    result.symbols = in_symbols(result.matrices, result, options);
    return result;
}

}  // namespace alembert
