// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/kept_energy.hpp"

#include <algorithm>

#include "model/event_actions.hpp"

namespace alembert {

namespace {

/// Whether impulses act at the event: its own, or those of a constraint that moves with a state that it sets.
bool has_impulse(const Mechanism& m, const Mechanism::EventAction& event) {
    if (!event.impulse.empty() || !event.rates.empty()) return true;
    const std::vector<GiNaC::symbol> set = states_set(m, event);
    const auto moves = [&](const Mechanism::Constraint& c) {
        const GiNaC::ex row = GiNaC::lst(c.row.begin(), c.row.end());
        return m.z->depends(row, set) || m.z->depends(c.offset, set);
    };
    return !set.empty() && std::any_of(m.constraints.begin(), m.constraints.end(), moves);
}

}  // namespace

bool may_jump_in_energy(const Mechanism& m, const Energy& energy) {
    return std::any_of(m.unilateral.begin(), m.unilateral.end(),
                       [](const Mechanism::Unilateral& contact) { return !contact.restitution.is_equal(1); }) ||
           std::any_of(m.event_actions.begin(), m.event_actions.end(), [&](const Mechanism::EventAction& event) {
               const std::vector<GiNaC::symbol> set = states_set(m, event);
               return has_impulse(m, event) || (!set.empty() && energy.z->depends(energy.energy, set));
           });
}

bool has_jumped_in_energy(const HybridMotion& motion, const Mechanism& m, const std::vector<double>& restitution) {
    return std::any_of(motion.events.begin(), motion.events.end(),
                       [&](const EventRecord& e) {
                           return has_impulse(m, m.event_actions[static_cast<std::size_t>(e.index)]);
                       }) ||
           std::any_of(motion.contacts.begin(), motion.contacts.end(), [&](const ContactEvent& e) {
               return e.kind == ContactEvent::Kind::impact && restitution[static_cast<std::size_t>(e.contact)] < 1;
           });
}

}  // namespace alembert
