// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/record.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace alembert {

namespace {

constexpr std::size_t most_lines = 20;

const char* word(ContactEvent::Kind kind) {
    switch (kind) {
        case ContactEvent::Kind::impact: return "impact";
        case ContactEvent::Kind::release: return "release";
        default: return "rest";
    }
}

/// One phase's rows, without the last one if it is said again by the next.
void add_rows(std::string& text, const Phase& phase, const LoadedMode& mode, const Derived& d, std::size_t rows, const JointReactions* reactions,
              State<double> at) {
    const alembert_solver_table& table = mode.module.table();
    const auto n = static_cast<std::size_t>(d.mechanism.size()), bilateral = d.mechanism.constraints.size(),
               redundant = d.mechanism.redundant.size(), held = static_cast<std::size_t>(table.constraints);
    std::vector<double> rate(static_cast<std::size_t>(mode.contact.rhs.dimension)), out(static_cast<std::size_t>(table.outputs)),
        lambda(held + redundant), all(bilateral + redundant + d.mechanism.unilateral.size());
    for (std::size_t row = 0; row < rows; ++row) {
        const double t = phase.motion.times[row];
        const auto state = phase.motion.state(row);
        mode.contact.rhs(t, state.data(), rate.data());
        double energy[4], jacobi = 0;
        table.energy(t, state.data(), rate.data(), mode.par.data(), energy, &jacobi);
        table.outputs_at(t, state.data(), rate.data(), mode.par.data(), out.data());
        table.multipliers_at(t, state.data(), mode.par.data(), lambda.data());
        std::copy_n(lambda.begin(), bilateral, all.begin());
        std::copy_n(lambda.begin() + static_cast<std::ptrdiff_t>(held), redundant, all.begin() + static_cast<std::ptrdiff_t>(bilateral));
        for (std::size_t i = 0; i < phase.closed.size(); ++i)
            all[bilateral + redundant + static_cast<std::size_t>(phase.closed[i])] = lambda[bilateral + i];
        text += fmt::format("{:.17g}", t);
        for (std::size_t i = 0; i < n; ++i) text += fmt::format(",{:.17g}", state[i]);
        for (std::size_t i = 0; i < n; ++i) text += fmt::format(",{:.17g}", rate[i]);
        for (const double value : all) text += fmt::format(",{:.17g}", value);
        text += fmt::format(",{:.17g}", energy[2]);
        for (const double value : out) text += fmt::format(",{:.17g}", value);
        if (reactions != nullptr) {
            at.t = t;
            std::copy_n(state.begin(), at.q.size(), at.q.begin());
            std::copy_n(state.begin() + static_cast<std::ptrdiff_t>(at.q.size()), at.qdot.size(), at.qdot.begin());
            for (const JointLoad& load : reactions->at(mode.program, at)) text += fmt::format(",{:.17g},{:.17g}", fmt::join(load.force, ","), fmt::join(load.moment, ","));
        }
        text += "\n";
    }
}

}  // namespace

std::string csv(const PhasedMotion& motion, const Derived& d, Modes& modes, const JointReactions* reactions, const State<double>& first) {
    std::string text = "t";
    for (const GiNaC::symbol& q : d.mechanism.q) text += "," + q.get_name();
    for (const GiNaC::symbol& q : d.mechanism.q) text += "," + q.get_name() + "'";
    for (const auto* list : {&d.mechanism.constraints, &d.mechanism.redundant})
        for (const Mechanism::Constraint& c : *list) text += "," + c.multiplier.get_name();
    for (const Mechanism::Unilateral& c : d.mechanism.unilateral) text += "," + c.gap.multiplier.get_name();
    text += ",energy";
    for (const Mechanism::Definition& output : d.mechanism.outputs) text += "," + output.name;
    for (const Root& root : modes({}).program.roots)
        if (root.group == "speed") text += "," + root.name;
    for (std::size_t k = 0; reactions != nullptr && k < reactions->joints.size(); ++k)
        for (const char* part : {"fx", "fy", "fz", "mx", "my", "mz"}) text += fmt::format(",{}.{}", reactions->joints[k], part);
    text += "\n";
    for (std::size_t k = 0; k < motion.phases.size(); ++k) {
        const Phase& phase = motion.phases[k];
        const Trajectory& here = phase.motion;
        std::size_t rows = here.rows();
        if (k + 1 < motion.phases.size()) {
            const Trajectory& next = motion.phases[k + 1].motion;
            const auto last = here.final_state(), first = next.state(0);
            if (next.times[0] == here.times.back() && std::equal(last.begin(), last.end(), first.begin(), [](double a, double b) {
                    return std::abs(a - b) <= 1e-8 * std::max(1.0, std::abs(a));
                }))
                --rows;
        }
        add_rows(text, phase, modes(phase.closed), d, rows, reactions, first);
    }
    return text;
}

Json event_as_json(const EventRecord& event, const Mechanism& m) {
    const auto k = static_cast<std::size_t>(event.index);
    Json result{{"name", m.events[k].name}, {"time", event.time}};
    if (event.impulse.empty()) return result;
    result["impulses"] = Json::object();
    for (std::size_t i = 0; i < event.impulse.size(); ++i)
        if (!m.occasions[k].impulse[i].is_zero()) result["impulses"][m.q[i].get_name()] = event.impulse[i];
    result["energy_gain"] = event.energy_gain;
    return result;
}

std::string events_as_text(const std::vector<EventRecord>& events, const Mechanism& m) {
    std::string text;
    for (std::size_t i = 0; i < events.size(); ++i) {
        if (i + 1 == most_lines && events.size() > most_lines) {
            text += fmt::format("… and {} more, then\n", events.size() - most_lines);
            i = events.size() - 1;
        }
        const EventRecord& event = events[i];
        text += fmt::format("event {} at t = {:.15g}{}\n", m.events[static_cast<std::size_t>(event.index)].name, event.time,
                            event.impulse.empty() ? "" : fmt::format(", energy gain {:.6g}", event.energy_gain));
    }
    return text;
}

Json contacts_as_json(const std::vector<ContactEvent>& events, const std::vector<std::string>& names) {
    Json list = Json::array();
    for (const ContactEvent& e : events)
        list.push_back({{"time", e.time},
                        {"name", names[static_cast<std::size_t>(e.contact)]},
                        {"event", word(e.kind)},
                        {"speed_before", e.speed_before},
                        {"speed_after", e.speed_after},
                        {"energy_loss", e.energy_loss},
                        {"reaction_impulse", e.impulse}});
    return list;
}

std::string contacts_as_text(const std::vector<ContactEvent>& events, const std::vector<std::string>& names) {
    std::string text;
    for (std::size_t i = 0; i < std::min(events.size(), most_lines); ++i) {
        const ContactEvent& e = events[i];
        text += fmt::format("contact {}: {} at t = {:.15g}", names[static_cast<std::size_t>(e.contact)], word(e.kind), e.time);
        if (e.kind == ContactEvent::Kind::impact)
            text += fmt::format(", speed {:.6g} -> {:.6g}, energy loss {:.6g}", e.speed_before, e.speed_after, e.energy_loss);
        text += "\n";
    }
    if (events.size() > most_lines) text += fmt::format("… and {} more\n", events.size() - most_lines);
    return text;
}

}  // namespace alembert
