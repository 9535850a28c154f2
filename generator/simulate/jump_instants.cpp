// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/jump_instants.hpp"

#include <algorithm>

#include "base/language/say.hpp"

namespace alembert {

void add_instants(JumpInstants& instants, const Mechanism& m, const HybridMotion& motion,
                  const std::vector<std::string>& contacts) {
    using Kind = JumpInstant::Kind;
    const auto name_of = [&](int contact) {
        return say("contact '{}'", contacts[static_cast<std::size_t>(contact)]);
    };
    for (const EventRecord& event : motion.events) {
        const Mechanism::EventAction& action = m.event_actions[static_cast<std::size_t>(event.index)];
        if (!action.set.empty() || !action.rates.empty() || !action.impulse.empty())
            instants.list.push_back({Kind::event, event.index, event.time, event.name});
    }
    for (const ContactEvent& event : motion.contacts) {
        const bool is_impact = event.kind == ContactEvent::Kind::impact;
        instants.list.push_back(
            {is_impact ? Kind::impact : Kind::closing, event.contact, event.time,
             is_impact ? contacts[static_cast<std::size_t>(event.contact)] : name_of(event.contact)});
    }
    for (const Phase& phase : motion.phases)
        if (!phase.closed.empty())
            instants.list.push_back(
                {Kind::closing, phase.closed[0], phase.motion.times.front(), name_of(phase.closed[0])});
    std::stable_sort(instants.list.begin(), instants.list.end(),
                     [](const JumpInstant& a, const JumpInstant& b) { return a.time < b.time; });
}

}  // namespace alembert
