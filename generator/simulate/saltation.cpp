// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/saltation.hpp"

#include <algorithm>
#include <cmath>

#include "alembert/base/error.hpp"
#include "base/language/say.hpp"
#include "model/multipliers.hpp"
#include "program/lower/lower.hpp"

namespace alembert {

std::string Saltation::obstacle(const Mechanism& m) {
    if (!m.unilateral.empty() || !m.frictions.empty())
        return say("the scene has contacts or dry friction, at which derivatives jump");
    if (m.has_counts()) return say("the scene counts zeros of an event");
    if (!m.has_kicks()) return {};
    if (!m.constraints.empty() || !m.speeds.empty())
        return say("beside events that change the motion the scene has constraints or generalized speeds");
    std::vector<GiNaC::symbol> unknown = multipliers_of(m);
    unknown.insert(unknown.end(), m.qddot.begin(), m.qddot.end());
    for (std::size_t k = 0; k < m.events.size(); ++k) {
        const Mechanism::EventAction& action = m.event_actions[k];
        if (!action.impulse.empty()) return say("event '{}' gives an impulse", m.events[k].name);
        if ((!action.set.empty() || !action.rates.empty()) && m.z->depends(m.events[k].value, unknown))
            return say("event '{}' looks at accelerations", m.events[k].name);
    }
    return {};
}

Saltation::Saltation(const Mechanism& mechanism, std::vector<int> by)
    : program_(begun(mechanism)),
      by_(std::move(by)),
      coordinates_(mechanism.q.size()),
      size_(2 * mechanism.q.size() + mechanism.states.size()) {
    const Mechanism m = with_own_intermediates(mechanism);
    std::vector<GiNaC::ex> wanted;
    for (std::size_t k = 0; k < m.events.size(); ++k) {
        const Mechanism::EventAction& action = m.event_actions[k];
        names_.push_back(m.events[k].name);
        set_.emplace_back();
        const bool acts = !action.set.empty() || !action.rates.empty();
        wanted.push_back(acts ? m.events[k].value : GiNaC::ex(0));
        const auto add = [&](std::size_t component, const GiNaC::ex& value) {
            set_.back().push_back({component, static_cast<int>(wanted.size())});
            wanted.push_back(value);
        };
        for (const auto& [index, value] : action.rates) add(coordinates_ + static_cast<std::size_t>(index), value);
        for (const auto& [index, value] : action.set)
            add(2 * coordinates_ + static_cast<std::size_t>(index), value);
    }
    const std::vector<int> nodes = lower_expressions(program_, m, wanted);
    std::size_t next = 0;
    for (std::vector<Given>& list : set_) {
        when_.push_back(nodes[next++]);
        for (Given& one : list) one.node = nodes[static_cast<std::size_t>(one.node)], ++next;
    }
}

/// With derivatives by the state, then the time, then what the columns vary besides.
std::vector<Jet<double>> Saltation::values(const Moment& at, const std::vector<double>& y) const {
    const std::size_t count = size_ + 1 + by_.size();
    const auto varied = [&](double value, std::size_t k) {
        std::vector<double> d(count, 0.0);
        d[k] = 1;
        return Jet<double>(value, std::move(d));
    };
    State<Jet<double>> state;
    for (std::size_t p = 0; p < at.parameters.size(); ++p) {
        Jet<double> value(at.parameters[p]);
        for (std::size_t c = 0; c < by_.size(); ++c) {
            if (by_[c] != static_cast<int>(p)) continue;
            value.d.resize(count, 0.0);
            value.d[size_ + 1 + c] = 1;
        }
        state.parameters.push_back(std::move(value));
    }
    state.t = varied(at.t, size_);
    for (std::size_t i = 0; i < size_; ++i) (i < coordinates_ ? state.q : state.qdot).push_back(varied(y[i], i));
    std::vector<int> wanted{when_[static_cast<std::size_t>(at.event)]};
    for (const Given& one : set_[static_cast<std::size_t>(at.event)]) wanted.push_back(one.node);
    std::vector<Jet<double>> value(static_cast<std::size_t>(program_.size())), result;
    interpret_into(value, program_, state, program_.needed(wanted));
    for (const int node : wanted) result.push_back(value[static_cast<std::size_t>(node)]);
    return result;
}

void Saltation::pass(const Moment& at, const std::function<std::vector<double>(const std::vector<double>&)>& rate,
                     std::vector<double>& y) const {
    constexpr double grazing = 1e-6;  // of what moves the value
    const std::vector<double> before(y.begin(), y.begin() + static_cast<std::ptrdiff_t>(size_));
    const std::vector<Jet<double>> value = values(at, before);
    const std::vector<Given>& set = set_[static_cast<std::size_t>(at.event)];
    std::vector<double> after = before;
    for (std::size_t k = 0; k < set.size(); ++k) after[set[k].component] = value[k + 1].value;
    const std::vector<double> f = rate(before), f_after = rate(after);
    const Jet<double>& h = value[0];
    double speed = h.derivative(size_), size = std::abs(speed);
    for (std::size_t i = 0; i < size_; ++i) {
        speed += h.derivative(i) * f[i];
        size += std::abs(h.derivative(i) * f[i]);
    }
    const std::string& name = names_[static_cast<std::size_t>(at.event)];
    if (!(std::abs(speed) > grazing * size))
        throw IntegrationError(say("--sensitivity: event '{}' is only grazed at t = {:.6g}: its value passes zero "
                                   "with next to no speed, "
                                   "and there are no derivatives beyond",
                                   name, at.t),
                               at.t, before);
    for (std::size_t c = 0; c < by_.size(); ++c) {
        double* const column = y.data() + size_ * (c + 1);
        double later = by_[c] >= 0 ? h.derivative(size_ + 1 + c) : 0;
        for (std::size_t i = 0; i < size_; ++i) later += h.derivative(i) * column[i];
        later /= -speed;
        std::vector<double> moved(size_), result(size_);
        for (std::size_t i = 0; i < size_; ++i) result[i] = moved[i] = column[i] + f[i] * later;
        for (std::size_t k = 0; k < set.size(); ++k) {
            const Jet<double>& g = value[k + 1];
            double sum = g.derivative(size_) * later + g.derivative(size_ + 1 + c);
            for (std::size_t i = 0; i < size_; ++i) sum += g.derivative(i) * moved[i];
            result[set[k].component] = sum;
        }
        for (std::size_t i = 0; i < size_; ++i) column[i] = result[i] - f_after[i] * later;
    }
    std::copy(after.begin(), after.end(), y.begin());
}

}  // namespace alembert
