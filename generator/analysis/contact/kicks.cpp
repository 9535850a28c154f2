// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/contact/kicks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "alembert/base/tolerances.hpp"
#include "analysis/state/assemble.hpp"
#include "base/language/say.hpp"
#include "model/event_actions.hpp"
#include "program/lower/lower.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double same = 1e-9;  // of two values, relative to their size

bool agree(double a, double b) {
    return std::abs(a - b) <= same * std::max(std::abs(a), std::abs(b));
}

}  // namespace

KickView::KickView(const Mechanism& m, const Scene& scene)
    : program_(begun(m)), holds_multipliers_(events_of_forces(m)), holds_modes_alone_(events_of_modes(m)) {
    std::vector<ex> values;
    for (std::size_t k = 0; k < m.events.size(); ++k)
        values.push_back(holds_multipliers_[k] ? ex(0) : m.events[k].value);
    std::vector<ex> wanted = values;
    const std::vector<ex> slopes = m.time_derivative(values);
    const std::vector<ex> bends = m.time_derivative(slopes);  // without q''', if `when` contains rates
    wanted.insert(wanted.end(), slopes.begin(), slopes.end());
    wanted.insert(wanted.end(), bends.begin(), bends.end());
    for (const ex& value : values) {
        const std::vector<ex> gradient = m.z->pull_back({{value, 1}}, m.q);
        wanted.insert(wanted.end(), gradient.begin(), gradient.end());
    }
    for (const Mechanism::Speed& speed : m.speeds) wanted.push_back(speed.form);
    for (const Mechanism::EventAction& event : m.event_actions) {
        wanted.insert(wanted.end(), event.impulse.begin(), event.impulse.end());
        for (const auto* list : {&event.set, &event.rates})
            for (const auto& one : *list) wanted.push_back(one.second);
    }
    const bool sets = std::any_of(m.event_actions.begin(), m.event_actions.end(),
                                  [](const Mechanism::EventAction& event) { return !event.set.empty(); });
    if (sets) wanted.push_back(m.lagrangian());
    const std::vector<int> nodes = lower_expressions(program_, m, wanted);
    if (sets) energy_ = nodes.back();
    auto next = nodes.begin();
    const auto taken = [&next](std::size_t count) {
        const auto first = next;
        next += static_cast<std::ptrdiff_t>(count);
        return std::vector<int>(first, next);
    };
    values_ = taken(m.events.size());
    slopes_ = taken(m.events.size());
    bends_ = taken(m.events.size());
    for (std::size_t k = 0; k < m.events.size(); ++k) gradients_.push_back(taken(m.q.size()));
    speeds_ = taken(m.speeds.size());
    for (std::size_t k = 0; k < m.events.size(); ++k) {
        const Mechanism::EventAction& event = m.event_actions[k];
        const EventRule& rule = scene.events[k];
        impulses_.push_back(taken(event.impulse.size()));
        const auto given = [&](const auto& list, const std::vector<GeneralizedForce>& written) {
            std::vector<Given> result;
            for (std::size_t i = 0; i < list.size(); ++i)
                result.push_back({list[i].first, taken(1)[0], written[i].value.text});
            return result;
        };
        set_.push_back(given(event.set, rule.set));
        rates_.push_back(given(event.rates, rule.rates));
        texts_.emplace_back();
        for (const GeneralizedForce& impulse : rule.impulses)
            texts_.back()[impulse.coordinate.text] = impulse.value.text;
    }
    for (const Mechanism::Definition& event : m.events) names_.push_back(event.name);
    for (const GiNaC::symbol& q : m.q) coordinates_.push_back(q.get_name());
    for (const Mechanism::State& z : m.states) states_.push_back(z.derivative[0].get_name());
}

KickView::Kicks KickView::kicks(const std::vector<int>& events, const State<double>& before) const {
    const std::vector<double> value = interpret(program_, before);
    const auto n = static_cast<Eigen::Index>(coordinates_.size());
    Kicks result;
    std::map<int, std::pair<int, double>> set;  // by coordinate: the event that sets its rate, and the value
    const auto refuse = [&](std::string why) {
        if (!result.refusal) result.refusal = std::move(why);
    };
    for (const int event : events) {
        const auto k = static_cast<std::size_t>(event);
        Kicks::Kick& kick = result.list.emplace_back();
        if (!impulses_[k].empty()) kick.impulse.resize(n);
        for (std::size_t i = 0; i < impulses_[k].size(); ++i) {
            const double given = kick.impulse[static_cast<Eigen::Index>(i)] = value[impulses_[k][i]];
            if (!std::isfinite(given))
                refuse(
                    say("event '{0}' gives {1} the impulse {2} at t = {3:.6g}, which is no finite real number "
                        "there",
                        names_[k], coordinates_[i], texts_[k].at(coordinates_[i]), before.t));
        }
        if (!rates_[k].empty()) kick.change_of_rates = Eigen::VectorXd::Zero(n);
        for (const Given& one : rates_[k]) {
            const auto i = static_cast<std::size_t>(one.index);
            const double given = value[one.node];
            if (!std::isfinite(given)) refuse(not_finite(event, coordinates_[i] + "'", one, before.t));
            const auto [first, is_first] = set.emplace(one.index, std::pair(event, given));
            if (is_first)
                kick.change_of_rates[one.index] = given - before.qdot[i];
            else if (const double other = first->second.second; !agree(given, other))
                refuse(
                    say("events '{0}' and '{1}' both set {2}' at t = {3:.6g}, to {4:.6g} and to {5:.6g}; let "
                        "one of them set it, or make the values agree",
                        names_[static_cast<std::size_t>(first->second.first)], names_[k], coordinates_[i],
                        before.t, other, given));
        }
    }
    return result;
}

std::string KickView::not_finite(int event, const std::string& what, const Given& given, double t) const {
    return say("event '{0}' sets {1} to {2} at t = {3:.6g}, which is no finite real number there",
               names_[static_cast<std::size_t>(event)], what, given.text, t);
}

std::optional<std::string> KickView::refusal(int event, const State<double>& before,
                                             const State<double>& after) const {
    constexpr double rounding = 1e-13;  // of the largest rate, where equations of motion have coupled them
    const std::vector<double> value = interpret(program_, before);
    double size = 0;
    for (std::size_t i = 0; i < coordinates_.size(); ++i)
        size = std::max({size, std::abs(before.qdot[i]), std::abs(after.qdot[i])});
    for (const Given& one : rates_[static_cast<std::size_t>(event)]) {
        const auto i = static_cast<std::size_t>(one.index);
        const double wanted = value[static_cast<std::size_t>(one.node)];
        const double own = std::max({std::abs(before.qdot[i]), std::abs(after.qdot[i]), std::abs(wanted)});
        if (std::abs(after.qdot[i] - wanted) <= same * own + rounding * size) continue;
        return say(
            "event '{0}' sets {1}' = {2:.6g} at t = {3:.6g}, and constraints, contacts or another event make "
            "it {4:.6g}; set rates that these allow, or give an impulse",
            names_[static_cast<std::size_t>(event)], coordinates_[i], wanted, before.t, after.qdot[i]);
    }
    return {};
}

/// The value of a state after these events, each of which takes what the one before has left.
double KickView::set_in_turn(const Setters& setters, std::size_t at, const State<double>& before) const {
    State<double> state = before;
    for (const auto& setter : setters) state.qdot[at] = interpret(program_, state)[setter.second->node];
    return state.qdot[at];
}

/// An order of the events that gives another value. All orders of a few are tried; of more, those in which two
/// neighbours are exchanged, and the opposite one.
std::optional<KickView::Setters> KickView::other_order(const Setters& setters, std::size_t at,
                                                       const State<double>& before) const {
    constexpr std::size_t few = 5;  // 120 orders
    const double value = set_in_turn(setters, at, before);
    const auto differs = [&](const Setters& order) { return !agree(value, set_in_turn(order, at, before)); };
    Setters order(setters.rbegin(), setters.rend());
    if (differs(order)) return order;
    if (setters.size() > few) {
        for (std::size_t i = 1; i < setters.size(); ++i) {
            order = setters;
            std::swap(order[i - 1], order[i]);
            if (differs(order)) return order;
        }
        return {};
    }
    std::vector<std::size_t> places(setters.size());
    std::iota(places.begin(), places.end(), 0);
    while (std::next_permutation(places.begin(), places.end())) {
        for (std::size_t i = 0; i < places.size(); ++i) order[i] = setters[places[i]];
        if (differs(order)) return order;
    }
    return {};
}

std::string KickView::contradiction(const Setters& setters, const Setters& other, std::size_t at,
                                    const State<double>& before) const {
    const std::string& name = states_[at - coordinates_.size()];
    const double value = set_in_turn(setters, at, before), else_value = set_in_turn(other, at, before);
    if (setters.size() == 2)
        return say(
            "events '{0}' and '{1}' both set {2} at t = {3:.6g}, which makes it {4:.6g} in this order and "
            "{5:.6g} in the other; let one of them set it, or make the values agree",
            names_[static_cast<std::size_t>(setters[0].first)], names_[static_cast<std::size_t>(setters[1].first)],
            name, before.t, value, else_value);
    const auto listed = [&](const Setters& order) {
        std::string list;
        for (const auto& one : order)
            list += (list.empty() ? "" : ", ") + fmt::format("'{}'", names_[static_cast<std::size_t>(one.first)]);
        return list;
    };
    return say(
        "the events {0} set {1} at t = {2:.6g}, which makes it {3:.6g} in this order and {4:.6g} in the order "
        "{5}; "
        "let one of them set it, or make the values agree",
        listed(setters), name, before.t, value, else_value, listed(other));
}

std::optional<std::string> KickView::set(const std::vector<int>& events, const State<double>& before,
                                         double* after) const {
    std::map<int, Setters> by_state;
    for (const int event : events)
        for (const Given& one : set_[static_cast<std::size_t>(event)])
            by_state[one.index].emplace_back(event, &one);
    for (const auto& [index, setters] : by_state) {
        const std::size_t at = coordinates_.size() + static_cast<std::size_t>(index);
        const double value = set_in_turn(setters, at, before);
        const auto [last, given] = setters.back();
        if (!std::isfinite(value))
            return not_finite(last, states_[static_cast<std::size_t>(index)], *given, before.t);
        if (setters.size() > 1)
            if (const auto other = other_order(setters, at, before))
                return contradiction(setters, *other, at, before);
        after[coordinates_.size() + at] = value;
    }
    return {};
}

std::string KickView::what_is_set(const std::vector<int>& events, const State<double>& after) const {
    std::string result;
    for (const int event : events)
        for (const Given& one : set_[static_cast<std::size_t>(event)]) {
            const auto index = static_cast<std::size_t>(one.index);
            const std::string value = fmt::format("{:.6g}", after.qdot[coordinates_.size() + index]);
            result += (result.empty() ? "" : ", ") +
                      say("event '{0}' sets {1} to {2}", names_[static_cast<std::size_t>(event)], states_[index],
                          one.text == value ? value : fmt::format("{} = {}", one.text, value));
        }
    return result;
}

std::optional<std::string> KickView::without_energy(const std::vector<int>& events,
                                                    const State<double>& after) const {
    if (!energy_ || std::isfinite(interpret(program_, after)[static_cast<std::size_t>(*energy_)])) return {};
    return say("at t = {0:.6g} {1}, and the energy is no finite real number then; set what gives it a value",
               after.t, what_is_set(events, after));
}

std::vector<PassedZero> KickView::passed(const State<double>& before, const State<double>& after) const {
    const std::vector<double> a = interpret(program_, before), b = interpret(program_, after);
    std::vector<PassedZero> result;
    for (std::size_t k = 0; k < values_.size(); ++k) {
        if (holds_multipliers_[k]) {
            result.emplace_back();
            continue;
        }
        const double value = b[values_[k]], slope = b[slopes_[k]], bend = b[bends_[k]];
        double size = size_of_terms(program_, values_[k], b);
        const bool has_jumped = std::abs(value - a[values_[k]]) > tolerance::jump * size;
        const double rounding = 2 * std::abs(value) + 16 * epsilon * size;
        for (std::size_t i = 0; i < after.q.size(); ++i)
            size += std::abs(b[gradients_[k][i]]) * std::max(1.0, std::abs(after.q[i]));
        PassedZero one{.is_zero = std::abs(value) <= 16 * epsilon * size, .slope = a[slopes_[k]], .size = size};
        if (has_jumped) {  // the value itself decides
        } else if (std::abs(slope) > tolerance::jump * std::abs(one.slope)) {
            one.side = slope > 0 ? 1 : -1;
            one.hold = rounding / std::abs(slope);
            if (slope * bend < 0)
                one.hold = std::min(one.hold, std::abs(slope / bend) / 2);  // a quarter of the flight
            else if (bend != 0)  // a touch, whose slope is rounding, rises by its bend
                one.hold = std::min(one.hold, std::sqrt(2 * rounding / std::abs(bend)));
        } else if (std::abs(bend) > tolerance::jump * size_of_terms(program_, bends_[k], b)) {
            one.side = bend > 0 ? 1 : -1;
            one.hold = std::sqrt(2 * rounding / std::abs(bend));
        } else {
            one.band = tolerance::passed_zero * size;
        }
        result.push_back(one);
    }
    return result;
}

std::vector<double> KickView::speeds(const State<double>& state) const {
    const std::vector<double> value = interpret(program_, state);
    std::vector<double> result;
    for (const int node : speeds_) result.push_back(value[node]);
    return result;
}

}  // namespace alembert
