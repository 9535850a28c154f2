// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/linear/events_here.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/contact/kicks.hpp"
#include "base/language/say.hpp"
#include "model/event_actions.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

/// Newton's method finds a state to rounding; people type about nine digits of one.
constexpr double as_typed = 1e-9;  // of the size of the event's value

/// Whether equations of motion hold one of these symbols.
bool hold(const Derived& d, const std::vector<GiNaC::symbol>& symbols) {
    const Equations& e = d.equations;
    const Intermediates& z = *d.mechanism.z;
    const auto depends = [&](const ex& value) { return z.depends(value, symbols); };
    const auto any = [&](const auto& list) { return std::any_of(list.begin(), list.end(), depends); };
    for (std::size_t i = 0; i < e.M.nops(); ++i)
        if (depends(e.M.op(i))) return true;
    return any(e.own) || any(e.dissipative) || any(e.applied) || any(e.gamma) || any(e.h) ||
           std::any_of(e.A.begin(), e.A.end(), any);
}

bool changes_motion(const Derived& d, const Mechanism::EventAction& event) {
    if (!event.impulse.empty() || !event.rates.empty()) return true;
    const std::vector<GiNaC::symbol> set = states_set(d.mechanism, event);
    if (set.empty()) return false;
    // What another event makes of it may change the motion.
    const auto is_seen = [&](const ex& value) { return d.mechanism.z->depends(value, set); };
    for (std::size_t k = 0; k < d.mechanism.events.size(); ++k)
        if (&d.mechanism.event_actions[k] != &event && is_seen(d.mechanism.events[k].value)) return true;
    return hold(d, set);
}

}  // namespace

std::optional<std::string> disturbed_by_event(const Derived& d, const Start& start) {
    const Mechanism& m = d.mechanism;
    if (!m.has_kicks()) return {};
    const KickView view(m, d.scene);
    const State<double> here = start.state();
    const std::vector<PassedZero> zeros = view.passed(here, here);
    std::vector<GiNaC::symbol> disturbed = m.q;
    disturbed.insert(disturbed.end(), m.qdot.begin(), m.qdot.end());
    for (const Mechanism::State& z : m.states)
        disturbed.insert(disturbed.end(), z.derivative.begin(), z.derivative.end());
    std::optional<std::string> at_this_time;
    for (std::size_t k = 0; k < zeros.size(); ++k) {
        if (view.of_multipliers()[k] || view.of_modes()[k] || !changes_motion(d, m.event_actions[k])) continue;
        if (!(std::abs(view.value(k, here)) <= as_typed * std::max(zeros[k].size, 1e-300))) continue;
        if (m.z->depends(m.events[k].value, disturbed))
            return say(
                "event '{0}' is at its zero here: a disturbance sets it off, and no first approximation describes "
                "the motion after that",
                m.events[k].name);
        if (!at_this_time)
            at_this_time = say(
                "event '{0}' happens at this time, t = {1:.6g}, and changes the motion: no first approximation "
                "describes the motion after that",
                m.events[k].name, here.t);
    }
    return at_this_time;
}

bool is_changed_by_events(const Scene& scene) {
    return std::any_of(scene.events.begin(), scene.events.end(), [](const EventRule& one) {
        return !one.set.empty() || !one.rates.empty() || !one.impulses.empty();
    });
}

}  // namespace alembert
