// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/linear/events_here.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/contact/kicks.hpp"
#include "base/language/say.hpp"

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
    std::vector<GiNaC::symbol> set;
    for (const auto& one : event.set)
        set.push_back(d.mechanism.states[static_cast<std::size_t>(one.first)].derivative[0]);
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
    for (std::size_t k = 0; k < zeros.size(); ++k) {
        if (view.of_multipliers()[k] || view.of_modes()[k] || !changes_motion(d, m.event_actions[k])) continue;
        if (!(std::abs(view.value(k, here)) <= as_typed * std::max(zeros[k].size, 1e-300))) continue;
        return say(
            "event '{0}' is at its zero here: a disturbance sets it off, and no first approximation describes the "
            "motion after that",
            m.events[k].name);
    }
    return {};
}

}  // namespace alembert
