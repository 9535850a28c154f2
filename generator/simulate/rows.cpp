// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/rows.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "alembert/base/error.hpp"
#include "alembert/ode/ended_events.hpp"
#include "base/language/say.hpp"
#include "model/multipliers.hpp"
#include "scene/text.hpp"

namespace alembert {

namespace {

/// Puts the rows of phases one after the other.
class RowWriter {
public:
    /// `at` is a state with the scene's parameters.
    RowWriter(std::vector<double>& values, const Mechanism& m, const JointReactions* reactions, State<double> at)
        : values_(values), m_(m), reactions_(reactions), at_(std::move(at)) {}

    /// The first `rows` of a phase.
    void add(const Phase& phase, LoadedMode& mode, std::size_t rows) {
        const alembert_solver_table& table = mode.module.table();
        const auto n = static_cast<std::size_t>(m_.size()), bilateral = m_.constraints.size(),
                   redundant = m_.redundant.size(),
                   held = static_cast<std::size_t>(mode.module.independent_constraints());
        std::vector<double> rate(static_cast<std::size_t>(mode.contact.system.rhs.dimension)),
            out(static_cast<std::size_t>(table.outputs)), lambda(held + redundant),
            all(bilateral + redundant + m_.unilateral.size());
        for (std::size_t row = 0; row < rows; ++row) {
            const double t = phase.motion.times[row];
            const auto state = phase.motion.state(row);
            mode.hold_sides(t, state.data());
            mode.contact.system.rhs(t, state.data(), rate.data());
            double energy[4], jacobi = 0;
            table.energy(t, state.data(), rate.data(), mode.par.data(), energy, &jacobi);
            table.outputs_at(t, state.data(), rate.data(), mode.par.data(), out.data());
            table.multipliers_at(t, state.data(), mode.par.data(), lambda.data());
            std::copy_n(lambda.begin(), bilateral, all.begin());
            std::copy_n(lambda.begin() + static_cast<std::ptrdiff_t>(held), redundant,
                        all.begin() + static_cast<std::ptrdiff_t>(bilateral));
            for (std::size_t i = 0; i < phase.closed.size(); ++i)
                all[bilateral + redundant + static_cast<std::size_t>(phase.closed[i])] = lambda[bilateral + i];
            values_.push_back(t);
            add(state.first(n));
            add(std::span(rate).first(n));
            add(state.subspan(static_cast<std::size_t>(table.coordinates + table.speeds) - m_.states.size(),
                              m_.states.size()));
            add(all);
            values_.push_back(energy[2]);
            add(out);
            if (reactions_ != nullptr) add_reactions(t, state, mode.program);
        }
    }

private:
    template <typename List>
    void add(const List& list) {
        values_.insert(values_.end(), std::begin(list), std::end(list));
    }

    void add_reactions(double t, std::span<const double> state, const Program& program) {
        at_.t = t;
        std::copy_n(state.begin(), at_.q.size(), at_.q.begin());
        std::copy_n(state.begin() + static_cast<std::ptrdiff_t>(at_.q.size()), at_.qdot.size(), at_.qdot.begin());
        for (const JointLoad& load : reactions_->at(program, at_)) {
            add(load.force);
            add(load.moment);
        }
        add(reactions_->normals_at(program, at_));
    }

    std::vector<double>& values_;
    const Mechanism& m_;
    const JointReactions* const reactions_;
    State<double> at_;
};

/// Does the next phase begin with the row with which this one ends?
bool is_continued(const Trajectory& here, const Trajectory& next) {
    const auto last = here.final_state(), first = next.state(0);
    return next.times[0] == here.times.back() &&
           std::equal(last.begin(), last.end(), first.begin(),
                      [](double a, double b) { return std::abs(a - b) <= 1e-8 * std::max(1.0, std::abs(a)); });
}

}  // namespace

std::string warning_of_end(const std::string& event, double last, double first_without) {
    return say(
        "warning: the expression of event '{}' has a value at t = {:.6g} and none at t = {:.6g}: it ends between "
        "them, and nothing is found where it has none\n",
        event, last, first_without);
}

std::vector<EndedEvent> ended_events(const HybridMotion& motion, const Mechanism& m, LoadedModes& modes) {
    EndedEvents ended(m.events.size());
    if (m.events.empty()) return {};
    for (const Phase& phase : motion.phases) {
        LoadedMode& mode = modes(phase.closed);
        std::vector<double> rate(static_cast<std::size_t>(mode.contact.system.rhs.dimension));
        for (std::size_t row = 0; row < phase.motion.rows(); ++row) {
            const double t = phase.motion.times[row];
            const auto state = phase.motion.state(row);
            mode.hold_sides(t, state.data());
            mode.contact.system.rhs(t, state.data(), rate.data());
            ended(mode.module.table(), mode.par.data(), t, state.data(), rate.data());
        }
    }
    std::vector<EndedEvent> result;
    for (const EndedEvents::One& one : ended.found())
        result.push_back({m.events[static_cast<std::size_t>(one.event)].name, one.last, one.first_without});
    return result;
}

bool has_records(const Mechanism& m) {
    return std::any_of(m.event_actions.begin(), m.event_actions.end(),
                       [](const Mechanism::EventAction& event) { return !event.record.empty(); });
}

MotionTable rows_at_events(const HybridMotion& motion, const Derived& d, LoadedModes& modes,
                           const JointReactions* reactions, const State<double>& first) {
    MotionTable table{.columns = row_columns(d.mechanism, modes({}).program, reactions), .values = {}};
    RowWriter writer(table.values, d.mechanism, reactions, first);
    for (const Phase& phase : motion.phases)
        for (const EventRecord& event : phase.motion.events) {
            Phase one{.closed = event.closed.value_or(phase.closed), .motion = {}};
            one.motion.dimension = phase.motion.dimension;
            one.motion.times = {event.time};
            one.motion.states = event.state;
            writer.add(one, modes(one.closed), 1);
        }
    return table;
}

std::vector<std::string> row_columns(const Mechanism& m, const Program& program, const JointReactions* reactions) {
    std::vector<std::string> columns{"t"};
    for (const GiNaC::symbol& q : m.q) columns.push_back(q.get_name());
    for (const GiNaC::symbol& q : m.q) columns.push_back(q.get_name() + "'");
    for (const Mechanism::State& z : m.states) columns.push_back(z.derivative[0].get_name());
    for (const GiNaC::symbol& multiplier : multipliers_of(m)) columns.push_back(multiplier.get_name());
    columns.emplace_back("energy");
    for (const Mechanism::Definition& output : m.outputs) columns.push_back(output.name);
    for (const Root& root : program.roots)
        if (root.group == Group::speed) columns.push_back(root.name);
    for (std::size_t k = 0; reactions != nullptr && k < reactions->joints.size(); ++k)
        for (const char* part : {"fx", "fy", "fz", "mx", "my", "mz"})
            columns.push_back(fmt::format("{}.{}", reactions->joints[k], part));
    if (reactions != nullptr) columns.insert(columns.end(), reactions->normals.begin(), reactions->normals.end());
    return columns;
}

namespace {

/// Nothing for the name of a column.
std::optional<std::string> complaint(const std::vector<std::string>& columns, const std::string& name) {
    if (std::find(columns.begin(), columns.end(), name) != columns.end()) return {};
    const std::string meant = nearest(name, columns);
    return say("there is no {} to show{}; expected one of {}", in_quotes(name),
               meant.empty() ? "" : say(" (did you mean '{}'?)", meant), fmt::join(columns, ", "));
}

}  // namespace

void check_columns(const std::vector<std::string>& columns, const std::vector<std::string>& wanted) {
    for (const std::string& name : wanted)
        if (const auto why = complaint(columns, name)) throw ModelError(*why);
}

void check_recorded(const Scene& scene, const std::vector<std::string>& columns) {
    std::vector<Diagnostic> mistakes;
    for (const EventRule& event : scene.events)
        for (const Name& name : event.record)
            if (const auto why = complaint(columns, name.text)) mistakes.push_back({name.place, *why});
    if (!mistakes.empty()) fail(scene, std::move(mistakes));
}

MotionTable rows_of(const HybridMotion& motion, const Derived& d, LoadedModes& modes,
                    const JointReactions* reactions, const State<double>& first) {
    MotionTable table{.columns = row_columns(d.mechanism, modes({}).program, reactions), .values = {}};
    RowWriter writer(table.values, d.mechanism, reactions, first);
    for (std::size_t k = 0; k < motion.phases.size(); ++k) {
        const Phase& phase = motion.phases[k];
        std::size_t rows = phase.motion.rows();
        if (k + 1 < motion.phases.size() && is_continued(phase.motion, motion.phases[k + 1].motion)) --rows;
        writer.add(phase, modes(phase.closed), rows);
    }
    return table;
}

}  // namespace alembert
