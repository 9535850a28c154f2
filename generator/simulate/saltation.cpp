// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/saltation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/language/say.hpp"
#include "model/formalism/routh.hpp"
#include "model/multipliers.hpp"
#include "program/lower/lower.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

/// Of linear equations K x = b with a square K, row by row, by elimination with the largest pivot of each column.
std::vector<Jet<double>> solution(std::vector<Jet<double>> K, std::vector<Jet<double>> b) {
    const std::size_t n = b.size();
    const auto swap_rows = [&](std::size_t i, std::size_t k) {
        for (std::size_t j = 0; j < n; ++j) std::swap(K[i * n + j], K[k * n + j]);
        std::swap(b[i], b[k]);
    };
    for (std::size_t k = 0; k < n; ++k) {
        std::size_t pivot = k;
        for (std::size_t i = k + 1; i < n; ++i)
            if (std::abs(K[i * n + k].value) > std::abs(K[pivot * n + k].value)) pivot = i;
        if (pivot != k) swap_rows(k, pivot);
        for (std::size_t i = k + 1; i < n; ++i) {
            const Jet<double> factor = K[i * n + k] / K[k * n + k];
            for (std::size_t j = k + 1; j < n; ++j) K[i * n + j] = K[i * n + j] - factor * K[k * n + j];
            b[i] = b[i] - factor * b[k];
        }
    }
    for (std::size_t k = n; k-- > 0;) {
        for (std::size_t j = k + 1; j < n; ++j) b[k] = b[k] - K[k * n + j] * b[j];
        b[k] = b[k] / K[k * n + k];
    }
    return b;
}

bool needs_mass(const Mechanism& m) {
    return !m.unilateral.empty() || std::any_of(m.event_actions.begin(), m.event_actions.end(),
                                                [](const auto& one) { return !one.impulse.empty(); });
}

}  // namespace

std::string Saltation::obstacle(const Mechanism& m) {
    if (!m.frictions.empty()) return say("the scene has dry friction, at which derivatives jump");
    if (m.has_counts()) return say("the scene counts zeros of an event");
    if (!m.has_kicks() && m.unilateral.empty()) return {};
    if (!m.speeds.empty())
        return say("beside contacts or events that change the motion the scene has generalized speeds");
    std::vector<GiNaC::symbol> unknown = multipliers_of(m);
    unknown.insert(unknown.end(), m.qddot.begin(), m.qddot.end());
    for (std::size_t k = 0; k < m.events.size(); ++k) {
        const Mechanism::EventAction& action = m.event_actions[k];
        const bool sets = !action.set.empty() || !action.rates.empty(), kicks = !action.impulse.empty();
        if (sets && kicks) return say("event '{}' gives an impulse and sets values", m.events[k].name);
        if (sets && !m.constraints.empty()) return say("beside events that set values the scene has constraints");
        if ((sets || kicks) && m.z->depends(m.events[k].value, unknown))
            return say("event '{}' looks at accelerations", m.events[k].name);
    }
    std::vector<GiNaC::symbol> states;
    for (const Mechanism::State& one : m.states)
        states.insert(states.end(), one.derivative.begin(), one.derivative.end());
    for (const Mechanism::Unilateral& contact : m.unilateral)
        if (m.z->depends(*contact.gap.position, states))
            return say("the gap of contact '{}' holds a state of the scene", contact.gap.name);
    return {};
}

Saltation::Saltation(const Mechanism& mechanism, std::shared_ptr<const Switched> switched, std::vector<int> by)
    : program_(begun(mechanism)),
      switched_(std::move(switched)),
      by_(std::move(by)),
      coordinates_(mechanism.q.size()),
      constraints_(mechanism.constraints.size()),
      size_(2 * mechanism.q.size() + mechanism.states.size()),
      scene_events_(mechanism.events.size()) {
    const Mechanism m = with_own_intermediates(mechanism);
    std::vector<ex> wanted;
    std::vector<int*> places;
    const auto add = [&](int& place, const ex& value) {
        places.push_back(&place);
        wanted.push_back(value);
    };
    const std::size_t n = coordinates_;
    events_.resize(m.events.size());
    contacts_.resize(m.unilateral.size());
    for (std::size_t k = 0; k < m.events.size(); ++k) {
        const Mechanism::EventAction& action = m.event_actions[k];
        Event& event = events_[k];
        event.name = m.events[k].name;
        for (const auto& [i, value] : action.rates) event.set.push_back({n + static_cast<std::size_t>(i), 0});
        for (const auto& [i, value] : action.set) event.set.push_back({2 * n + static_cast<std::size_t>(i), 0});
        for (std::size_t i = 0; i < action.impulse.size(); ++i) event.impulse.push_back({i, 0});
        add(event.when, acts(static_cast<int>(k)) ? m.events[k].value : ex(0));
        std::size_t at = 0;
        for (const auto* list : {&action.rates, &action.set})
            for (const auto& [i, value] : *list) add(event.set[at++].node, value);
        for (std::size_t i = 0; i < action.impulse.size(); ++i) add(event.impulse[i].node, action.impulse[i]);
    }
    for (std::size_t k = 0; k < m.unilateral.size(); ++k) {
        const Mechanism::Constraint& gap = m.unilateral[k].gap;
        Contact& contact = contacts_[k];
        contact.name = gap.name;
        contact.row.resize(n);
        add(contact.gap, *gap.position);
        add(contact.offset, gap.offset);
        add(contact.restitution, m.unilateral[k].restitution);
        for (std::size_t i = 0; i < n; ++i) add(contact.row[i], gap.row[i]);
    }
    if (needs_mass(m)) {
        const Equations e = routh(m);
        mass_.resize(n * n);
        rows_.resize(constraints_ * n);
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < n; ++j)
                add(mass_[i * n + j],
                    e.M(static_cast<unsigned>(std::max(i, j)), static_cast<unsigned>(std::min(i, j))));
        for (std::size_t k = 0; k < constraints_; ++k)
            for (std::size_t i = 0; i < n; ++i) add(rows_[k * n + i], m.constraints[k].row[i]);
    }
    const std::vector<int> nodes = lower_expressions(program_, m, wanted);
    for (std::size_t k = 0; k < nodes.size(); ++k) *places[k] = nodes[k];
}

std::vector<Jet<double>> Saltation::varied(const std::vector<double>& state) const {
    std::vector<Jet<double>> result;
    for (std::size_t i = 0; i < size_; ++i) {
        std::vector<double> d(size_ + 1 + by_.size(), 0.0);
        d[i] = 1;
        result.emplace_back(state[i], std::move(d));
    }
    return result;
}

std::vector<Jet<double>> Saltation::values(const Program& program, const std::vector<int>& nodes, const At& at,
                                           const std::vector<double>& y) const {
    const std::size_t count = size_ + 1 + by_.size();
    State<Jet<double>> state;
    for (std::size_t p = 0; p < program.parameters.size(); ++p) {
        Jet<double> value(at.parameters[p]);
        for (std::size_t c = 0; c < by_.size(); ++c) {
            if (by_[c] != static_cast<int>(p)) continue;
            value.d.resize(count, 0.0);
            value.d[size_ + 1 + c] = 1;
        }
        state.parameters.push_back(std::move(value));
    }
    state.t = Jet<double>(at.t, std::vector<double>(count, 0.0));
    state.t.d[size_] = 1;
    const std::vector<Jet<double>> all = varied(y);
    const auto middle = all.begin() + static_cast<std::ptrdiff_t>(coordinates_);
    state.q.assign(all.begin(), middle);
    state.qdot.assign(middle, all.end());
    std::vector<Jet<double>> value(static_cast<std::size_t>(program.size())), result;
    interpret_into(value, program, state, program.needed(nodes));
    for (const int node : nodes) result.push_back(value[static_cast<std::size_t>(node)]);
    return result;
}

int Saltation::side_function(int index) const {
    const std::vector<int> events = switched_->program.nodes_of(Group::event);
    return events[events.size() - switched_->events() + static_cast<std::size_t>(index)];
}

Jet<double> Saltation::value(const JumpInstant& instant, const At& at, const std::vector<double>& state) const {
    const auto k = static_cast<std::size_t>(instant.index);
    switch (instant.kind) {
        case JumpInstant::Kind::side:
            return values(switched_->program, {side_function(instant.index)}, at, state)[0];
        case JumpInstant::Kind::impact:
            return values(program_, {contacts_[k].gap}, at, state)[0];
        default:
            return values(program_, {events_[k].when}, at, state)[0];
    }
}

/// The change of the rates by an impulse, with constraints: M Δu = Q̂ + Aᵀ Λ, A Δu = 0.
std::vector<Jet<double>> Saltation::solved(const std::vector<Jet<double>>& values,
                                           std::vector<Jet<double>> impulse) const {
    const std::size_t n = coordinates_, all = n + constraints_;
    std::vector<Jet<double>> K(all * all);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) K[i * all + j] = values[i * n + j];
    for (std::size_t k = 0; k < constraints_; ++k)
        for (std::size_t i = 0; i < n; ++i) K[(n + k) * all + i] = K[i * all + n + k] = values[n * n + k * n + i];
    impulse.resize(all);
    std::vector<Jet<double>> change = solution(std::move(K), std::move(impulse));
    change.resize(n);
    return change;
}

void Saltation::kick(const Event& event, const At& at, const std::vector<double>& before,
                     std::vector<Jet<double>>& after) const {
    std::vector<int> nodes = mass_;
    nodes.insert(nodes.end(), rows_.begin(), rows_.end());
    for (const Given& one : event.impulse) nodes.push_back(one.node);
    const std::vector<Jet<double>> value = values(program_, nodes, at, before);
    const std::vector<Jet<double>> impulse(value.end() - static_cast<std::ptrdiff_t>(coordinates_), value.end());
    const std::vector<Jet<double>> change = solved(value, impulse);
    for (std::size_t i = 0; i < coordinates_; ++i) after[coordinates_ + i] += change[i];
}

void Saltation::strike(const Contact& contact, const At& at, const std::vector<double>& before,
                       std::vector<Jet<double>>& after) const {
    std::vector<int> nodes = mass_;
    nodes.insert(nodes.end(), rows_.begin(), rows_.end());
    nodes.insert(nodes.end(), contact.row.begin(), contact.row.end());
    nodes.insert(nodes.end(), {contact.offset, contact.restitution});
    const std::vector<Jet<double>> value = values(program_, nodes, at, before);
    const Jet<double>* const row = value.data() + mass_.size() + rows_.size();
    const Jet<double>& offset = row[coordinates_];
    const Jet<double>& restitution = row[coordinates_ + 1];
    const std::vector<Jet<double>> along =
        solved(value, std::vector<Jet<double>>(row, row + coordinates_));  // W gᵀ
    Jet<double> rate = offset, size;
    for (std::size_t i = 0; i < coordinates_; ++i) {
        rate += row[i] * after[coordinates_ + i];
        size += row[i] * along[i];
    }
    const Jet<double> factor = (Jet<double>(1) + restitution) * rate / size;
    for (std::size_t i = 0; i < coordinates_; ++i)
        after[coordinates_ + i] = after[coordinates_ + i] - factor * along[i];
}

Saltation::Jump Saltation::jump(const JumpInstant& instant, const At& at,
                                const std::vector<double>& before) const {
    Jump result{.value = value(instant, at, before), .after = varied(before)};
    const auto k = static_cast<std::size_t>(instant.index);
    if (instant.kind == JumpInstant::Kind::impact) strike(contacts_[k], at, before, result.after);
    if (instant.kind != JumpInstant::Kind::event) return result;
    const Event& event = events_[k];
    if (!event.impulse.empty()) kick(event, at, before, result.after);
    std::vector<int> nodes;
    for (const Given& one : event.set) nodes.push_back(one.node);
    const std::vector<Jet<double>> set = values(program_, nodes, at, before);
    for (std::size_t i = 0; i < event.set.size(); ++i) result.after[event.set[i].component] = set[i];
    return result;
}

double Saltation::speed(const Jet<double>& value, const std::vector<double>& f) const {
    double sum = value.derivative(size_);
    for (std::size_t i = 0; i < size_; ++i) sum += value.derivative(i) * f[i];
    return sum;
}

double Saltation::change(const Jet<double>& value, const double* column, std::size_t number) const {
    double sum = number < by_.size() && by_[number] >= 0 ? value.derivative(size_ + 1 + number) : 0;
    for (std::size_t i = 0; i < size_; ++i) sum += value.derivative(i) * column[i];
    return sum;
}

void Saltation::carry(const Jump& jump, const std::vector<double>& f, const std::vector<double>& f_after,
                      std::vector<double>& y) const {
    const double passing = speed(jump.value, f);
    std::vector<double> moved(size_);
    for (std::size_t c = 0; size_ * (c + 1) < y.size(); ++c) {
        double* const column = y.data() + size_ * (c + 1);
        const double later = -change(jump.value, column, c) / passing;
        for (std::size_t i = 0; i < size_; ++i) moved[i] = column[i] + f[i] * later;
        for (std::size_t i = 0; i < size_; ++i) {
            const Jet<double>& G = jump.after[i];
            double sum = G.derivative(size_) * later - f_after[i] * later;
            if (c < by_.size() && by_[c] >= 0) sum += G.derivative(size_ + 1 + c);
            for (std::size_t j = 0; j < size_; ++j) sum += G.derivative(j) * moved[j];
            column[i] = sum;
        }
    }
    for (std::size_t i = 0; i < size_; ++i) y[i] = jump.after[i].value;
}

std::vector<JumpInstant> Saltation::watched() const {
    std::vector<JumpInstant> result;
    for (std::size_t k = 0; k < events_.size(); ++k)
        if (acts(static_cast<int>(k)))
            result.push_back(
                {.kind = JumpInstant::Kind::event, .index = static_cast<int>(k), .name = events_[k].name});
    for (std::size_t k = 0; k < contacts_.size(); ++k)
        result.push_back(
            {.kind = JumpInstant::Kind::impact, .index = static_cast<int>(k), .name = contacts_[k].name});
    return result;
}

}  // namespace alembert
