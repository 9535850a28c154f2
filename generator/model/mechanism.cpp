// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/mechanism.hpp"

#include <cln/real.h>

#include <algorithm>

#include "alembert/base/interrupt.hpp"
#include "algebra/symbolic/fifty_digits.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

ex total(const std::vector<Part>& parts, Intermediates& z) {
    GiNaC::exvector values;
    for (const Part& part : parts) values.push_back(part.value);
    return z.name(GiNaC::add(std::move(values)));
}

Intermediates::Direction along_time(const Mechanism& m) {
    Intermediates::Direction direction{{m.t, 1}};
    const auto follow = [&](const std::array<GiNaC::symbol, 3>& derivative) {
        direction.emplace_back(derivative[0], derivative[1]);
        direction.emplace_back(derivative[1], derivative[2]);
    };
    for (const Mechanism::Input& input : m.inputs) follow(input.derivative);
    for (const Mechanism::State& state : m.states) follow(state.derivative);
    return direction;
}

void append(Intermediates::Direction& direction, const std::vector<GiNaC::symbol>& moving,
            const std::vector<GiNaC::symbol>& rates) {
    for (std::size_t i = 0; i < moving.size(); ++i) direction.emplace_back(moving[i], rates[i]);
}

}  // namespace

GiNaC::numeric Mechanism::Parameter::number() const {
    if (const auto* number = GiNaC::is_a<GiNaC::numeric>(value) ? &GiNaC::ex_to<GiNaC::numeric>(value) : nullptr;
        number != nullptr && number->is_rational())
        return *number;
    const FiftyDigits digits;
    return GiNaC::numeric(
        cln::cl_N(cln::rational(cln::the<cln::cl_R>(GiNaC::ex_to<GiNaC::numeric>(value.evalf()).to_cl_N()))));
}

Mechanism::Mechanism() = default;
Mechanism::Mechanism(const Mechanism&) = default;
Mechanism::Mechanism(Mechanism&&) noexcept = default;
Mechanism& Mechanism::operator=(const Mechanism&) = default;
Mechanism& Mechanism::operator=(Mechanism&&) noexcept = default;
Mechanism::~Mechanism() = default;

std::vector<const Mechanism::Constraint*> Mechanism::undetermined() const {
    std::vector<const Constraint*> result;
    for (const Unilateral& u : unilateral) result.push_back(&u.gap);
    for (const Constraint& c : redundant) result.push_back(&c);
    return result;
}

std::vector<GiNaC::symbol> Mechanism::moving() const {
    std::vector<GiNaC::symbol> symbols = q;
    const std::vector<GiNaC::symbol> others = clock();
    symbols.insert(symbols.end(), others.begin(), others.end());
    return symbols;
}

std::vector<GiNaC::symbol> Mechanism::clock() const {
    std::vector<GiNaC::symbol> symbols{t};
    for (const Input& input : inputs)
        symbols.insert(symbols.end(), input.derivative.begin(), input.derivative.end());
    for (const State& state : states)
        symbols.insert(symbols.end(), state.derivative.begin(), state.derivative.end());
    return symbols;
}

ex Mechanism::kinetic_energy() const {
    return total(kinetic, *z);
}

ex Mechanism::potential_energy() const {
    return total(potential, *z);
}

ex Mechanism::lagrangian() const {
    return given_lagrangian ? *given_lagrangian : z->name(kinetic_energy() - potential_energy());
}

std::vector<ex> Mechanism::time_derivative(const std::vector<ex>& values) const {
    ask_whether_wanted();
    Intermediates::Direction direction = along_time(*this);
    append(direction, q, qdot);
    append(direction, qdot, qddot);
    return z->push_forward(values, direction);
}

std::vector<ex> Mechanism::time_derivative_without_acceleration(const std::vector<ex>& values) const {
    ask_whether_wanted();
    Intermediates::Direction direction = along_time(*this);
    append(direction, q, qdot);
    return z->push_forward(values, direction);
}

std::vector<ex> Mechanism::explicit_time_derivative(const std::vector<ex>& values) const {
    return z->push_forward(values, along_time(*this));
}

const TabulatedFunction* Mechanism::table_of(const ex& function) const {
    const auto index = static_cast<std::size_t>(symbols->info(GiNaC::ex_to<GiNaC::symbol>(function)).index);
    return index < tables.size() ? tables[index].get() : nullptr;
}

std::vector<GiNaC::symbol> Mechanism::open_functions() const {
    std::vector<GiNaC::symbol> result;
    for (const GiNaC::symbol& function : symbols->functions())
        if (table_of(function) == nullptr) result.push_back(function);
    return result;
}

bool Mechanism::has_kicks() const {
    return std::any_of(event_actions.begin(), event_actions.end(), [](const EventAction& o) {
        return !o.impulse.empty() || !o.set.empty() || !o.rates.empty();
    });
}

bool Mechanism::has_counts() const {
    return std::any_of(event_actions.begin(), event_actions.end(),
                       [](const EventAction& o) { return o.count.has_value(); });
}

std::vector<ex> Mechanism::generalized_forces(bool dissipative) const {
    ask_whether_wanted();
    std::vector<std::pair<ex, ex>> targets;
    for (const Load& load : loads)
        if (load.dissipative == dissipative)
            for (const Load::Pair& pair : load.pairs) targets.emplace_back(pair.velocity, pair.force);
    return z->pull_back(targets, qdot);
}

std::vector<ex> Mechanism::generalized_impulses() const {
    std::vector<std::pair<ex, ex>> targets;
    for (const Load& impulse : impulses)
        for (const Load::Pair& pair : impulse.pairs) targets.emplace_back(pair.velocity, pair.force);
    return z->pull_back(targets, qdot);
}

Mechanism with_own_intermediates(const Mechanism& mechanism) {
    Mechanism result = mechanism;
    result.z = std::make_shared<Intermediates>(*mechanism.z);
    return result;
}

}  // namespace alembert
