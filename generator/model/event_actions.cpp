// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/event_actions.hpp"

#include "model/multipliers.hpp"

namespace alembert {

std::vector<GiNaC::symbol> states_set(const Mechanism& m, const Mechanism::EventAction& action) {
    std::vector<GiNaC::symbol> result;
    for (const auto& [state, value] : action.set)
        result.push_back(m.states[static_cast<std::size_t>(state)].derivative[0]);
    return result;
}

std::vector<bool> events_of_forces(const Mechanism& m) {
    const std::vector<GiNaC::symbol> multipliers = multipliers_of(m);
    std::vector<bool> result;
    for (const Mechanism::Definition& event : m.events) result.push_back(m.z->depends(event.value, multipliers));
    return result;
}

std::vector<bool> events_of_modes(const Mechanism& m) {
    std::vector<GiNaC::symbol> moving{m.t};
    for (const auto* list : {&m.q, &m.qdot, &m.qddot}) moving.insert(moving.end(), list->begin(), list->end());
    for (const Mechanism::Input& input : m.inputs)
        moving.insert(moving.end(), input.derivative.begin(), input.derivative.end());
    for (const Mechanism::State& z : m.states)
        if (!z.rate.is_zero()) moving.insert(moving.end(), z.derivative.begin(), z.derivative.end());
    for (const GiNaC::symbol& multiplier : multipliers_of(m)) moving.push_back(multiplier);
    std::vector<bool> result;
    for (const Mechanism::Definition& event : m.events) result.push_back(!m.z->depends(event.value, moving));
    return result;
}

}  // namespace alembert
