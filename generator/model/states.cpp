// SPDX-License-Identifier: GPL-2.0-or-later
// First-order states, z' = r(q, q', z, F, t).
#include "base/language/say.hpp"
#include "model/building.hpp"
#include "scene/text.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

/// Whether each state's rate depends on the rates of the coordinates, itself or by those of other states. Throws
/// SceneMistake for rates in a circle.
std::vector<bool> follow_rates(const Building& here) {
    const std::vector<Mechanism::State>& states = here.m.states;
    enum class Seen { no, open, done };
    std::vector<Seen> seen(states.size(), Seen::no);
    std::vector<bool> result(states.size(), false);
    const auto visit = [&](const auto& self, std::size_t k) -> bool {
        if (seen[k] == Seen::open)
            throw SceneMistake{{states[k].place, say("the rate of {} is determined by itself",
                                                     in_quotes(states[k].derivative[0].get_name()))}};
        if (seen[k] == Seen::done) return result[k];
        seen[k] = Seen::open;
        bool found = here.m.z->depends(states[k].rate, here.m.qdot);
        for (std::size_t j = 0; j < states.size(); ++j)
            if (here.m.z->depends(states[k].rate, {states[j].derivative[1]})) found = self(self, j) || found;
        seen[k] = Seen::done;
        return result[k] = found;
    };
    for (std::size_t k = 0; k < states.size(); ++k) visit(visit, k);
    return result;
}

/// z'' must be known before the accelerations are: where z moves a mass or a constraint, z' may not hold rates.
void refuse_coupled_states(Building& here) {
    const std::vector<bool> with_rates = follow_rates(here);
    GiNaC::lst first, second;  // expressions that hold z'' if they hold z', and those that hold z'' themselves
    for (const Part& part : here.m.kinetic) first.append(part.value);
    if (here.m.given_lagrangian) first.append(*here.m.given_lagrangian);
    for (const MassElement& body : here.m.masses)
        for (const ex& component : body.velocity) first.append(component);
    for (const Mechanism::Constraint& c : here.m.constraints) second.append(c.acceleration);
    for (const Mechanism::Unilateral& u : here.m.unilateral) second.append(u.gap.acceleration);
    for (std::size_t k = 0; k < here.m.states.size(); ++k) {
        const Mechanism::State& state = here.m.states[k];
        if (with_rates[k] &&
            (here.m.z->depends(first, {state.derivative[1]}) || here.m.z->depends(second, {state.derivative[2]})))
            here.attempt([&] {
                throw SceneMistake{
                    {state.place,
                     say("a mass or a constraint moves with {0}, and {0}' depends on rates, so that {0}'' depends "
                         "on the accelerations that are sought; make {0} a coordinate, and its rate a "
                         "nonholonomic "
                         "constraint",
                         state.derivative[0].get_name())}};
            });
    }
}

}  // namespace

void add_states(Building& here) {
    for (std::size_t i = 0; i < here.scene.states.size(); ++i)
        here.attempt([&] {
            const FirstOrderState& z = here.scene.states[i];
            SourceScope source(*here.m.z, "state " + z.name.text);
            if (z.rate) here.m.states[i].rate = here.m.z->name(here.translator.scalar(z.rate));
        });
    if (!here.m.states.empty()) here.attempt([&] { refuse_coupled_states(here); });
}

}  // namespace alembert
