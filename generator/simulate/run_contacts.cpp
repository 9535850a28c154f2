// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/run_contacts.hpp"

#include "analysis/state/inertia_check.hpp"
#include "base/language/say.hpp"

namespace alembert {

bool has_jumps(const Mechanism& m) {
    return !m.unilateral.empty() || m.has_kicks() || m.has_counts();
}

namespace {

/// What has no finite value there, of all that the equations of motion are made of; nothing if all has one.
std::optional<std::string> without_value(const Mechanism& m, const ContactView& view, const Situation& here) {
    for (int i = 0; i < m.size(); ++i)
        if (!here.M.row(i).allFinite() || !std::isfinite(here.f[i]))
            return say("the equation of motion of {}", m.q[static_cast<std::size_t>(i)].get_name());
    const auto bad = [](const Situation::Rows& rows, Eigen::Index k) {
        return !rows.rows.row(k).allFinite() || !std::isfinite(rows.value[k]) || !std::isfinite(rows.offset[k]) ||
               !std::isfinite(rows.acceleration[k]);
    };
    for (Eigen::Index k = 0; k < here.bilateral.value.size(); ++k)
        if (bad(here.bilateral, k)) return say("constraint '{}'", m.constraints[static_cast<std::size_t>(k)].name);
    for (Eigen::Index k = 0; k < here.contacts.value.size(); ++k)
        if (bad(here.contacts, k))
            return say("the gap of contact '{}'", view.names()[static_cast<std::size_t>(k)]);
    return {};
}

/// Why the states that events have set cannot be, with the coordinates where they are: something has no value, a
/// constraint breaks, or a gap is negative. `what` says what has been set.
std::optional<std::string> broken_by_set(const Mechanism& m, const ContactView& view, const State<double>& before,
                                         const State<double>& after, const std::string& what) {
    constexpr double negligible = 1e-9;  // of coordinates of size max(1, |q|), as for initial values
    constexpr double drift = 10;         // times what a value was off before: it is no more wrong than that
    const Situation was = view.at(before), is = view.at(after);
    if (const auto missing = without_value(m, view, is); missing && !without_value(m, view, was))
        return say("at t = {0:.6g} {1}, and {2} has no finite real value then; set what gives it one", after.t,
                   what, *missing);
    const auto off = [&](const Situation::Rows& rows, Eigen::Index k) {
        double size = 0;
        for (Eigen::Index i = 0; i < rows.rows.cols(); ++i)
            size += std::abs(rows.rows(k, i)) * std::max(1.0, std::abs(after.q[static_cast<std::size_t>(i)]));
        return negligible * size;
    };
    for (Eigen::Index k = 0; k < is.bilateral.value.size(); ++k)
        if (const double value = is.bilateral.value[k];
            std::abs(value) > off(is.bilateral, k) + drift * std::abs(was.bilateral.value[k]))
            return say(
                "what events set at t = {:.6g} puts constraint '{}' off by {:.6g}, and coordinates do not jump; "
                "set values with which it holds, or give the state a rate",
                after.t, m.constraints[static_cast<std::size_t>(k)].name, value);
    for (Eigen::Index k = 0; k < is.contacts.value.size(); ++k)
        if (const double value = is.contacts.value[k];
            - value > off(is.contacts, k) + drift * std::abs(was.contacts.value[k]))
            return say(
                "what events set at t = {:.6g} makes the gap of contact '{}' {:.6g}, and coordinates do not jump; "
                "set values with which it is not negative, or give the state a rate",
                after.t, view.names()[static_cast<std::size_t>(k)], value);
    return {};
}

}  // namespace

Contacts contacts_of(const Derived& d, const Start& start, const ContactView& view, const KickView& kicks) {
    const Mechanism& m = d.mechanism;
    if (!m.unilateral.empty() || (m.speeds.empty() && m.size() > 0)) need_rates(d);
    const auto at = [state = start.state()](double t, const double* y) {
        State<double> result = state;
        result.t = t;
        std::copy_n(y, state.q.size(), result.q.begin());
        std::copy_n(y + state.q.size(), state.qdot.size(), result.qdot.begin());
        return result;
    };
    Contacts contacts{.names = view.names(),
                      .restitution = restitutions(m, start.parameters),
                      .situation = [&view, at](double t, const double* y) { return view.at(at(t, y)); },
                      .on_jump = {}};
    bool sets = false, has_rates = false;
    for (const Mechanism::EventAction& event : m.event_actions) {
        contacts.kicks.events.push_back(!event.impulse.empty() || !event.set.empty() || !event.rates.empty() ||
                                        event.count);
        contacts.kicks.last.push_back(event.count.value_or(0));
        sets = sets || !event.set.empty();
        has_rates = has_rates || !event.rates.empty();
    }
    if (sets)
        contacts.kicks.set = [&m, &kicks, &view, at, bodies = std::make_shared<const InertiaCheck>(d.scene, m)](
                                 const std::vector<int>& events, double t, const double* before,
                                 double* after) -> std::optional<std::string> {
            const State<double> from = at(t, before);
            if (auto why = kicks.set(events, from, after)) return why;
            const State<double> to = at(t, after);
            for (const Diagnostic& found : bodies->findings(to))
                if (found.severity == Severity::error)
                    return say("what events set at t = {:.6g} is not possible: {}", t, found.message);
            if (auto why = kicks.without_energy(events, to)) return why;
            return broken_by_set(m, view, from, to, kicks.what_is_set(events, to));
        };
    if (has_rates)
        contacts.kicks.refusal = [&kicks, at](int event, double t, const double* before, const double* after) {
            return kicks.refusal(event, at(t, before), at(t, after));
        };
    contacts.kicks.coordinates = m.size();
    contacts.kicks.of_modes = kicks.of_modes();
    contacts.kicks.of_multipliers = kicks.of_multipliers();
    contacts.kicks.impulses = [&kicks, &view, at](const std::vector<int>& events, double t, const double* before,
                                                  const double* set) {
        KickView::Kicks kicked = kicks.kicks(events, at(t, before));
        Impulses result{.list = {}, .refusal = std::move(kicked.refusal)};
        for (KickView::Kicks::Kick& one : kicked.list) {
            Eigen::VectorXd& impulse = result.list.emplace_back(std::move(one.impulse));
            if (one.change_of_rates.size() == 0) continue;
            const Eigen::VectorXd needed = view.at(at(t, set)).M * one.change_of_rates;
            impulse = impulse.size() == 0 ? needed : Eigen::VectorXd(impulse + needed);
        }
        return result;
    };
    contacts.kicks.passed = [&kicks, at](double t, const double* before, const double* after,
                                         const Eigen::VectorXd& acceleration) {
        State<double> a = at(t, before), b = at(t, after);
        a.qddot.assign(acceleration.begin(), acceleration.end());
        b.qddot = a.qddot;
        return kicks.passed(a, b);
    };
    if (!d.equations.speeds_are_rates())
        contacts.kicks.speeds = [&kicks, at](double t, const double* y) { return kicks.speeds(at(t, y)); };
    return contacts;
}

}  // namespace alembert
