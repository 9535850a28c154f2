// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/phased_members.hpp"

#include <algorithm>
#include <limits>

#include "alembert/base/error.hpp"
#include "alembert/ode/energy_error.hpp"
#include "alembert/ode/running_extrema.hpp"
#include "base/language/say.hpp"
#include "model/formalism/with_states.hpp"
#include "program/known_knots.hpp"
#include "simulate/consistent_mode.hpp"
#include "simulate/run_contacts.hpp"
#include "simulate/table_watch.hpp"

namespace alembert {

namespace {

Work work_of(const Mechanism& m) {
    const bool conserved = energy_of(m.unilateral.empty() ? m : with_all_closed(m)).conserved;
    return conserved ? Work::left_out : Work::integrated;
}

/// What is known along a motion.
struct Account {
    EnergyError energy_error;
    RunningExtrema along;
    EndedEvents ended;
};

Outcome outcome_of(const HybridMotion& motion, const Account& account, bool along) {
    return {.time = motion.final_time(),
            .steps = motion.statistics.steps,
            .rejected = motion.statistics.rejected,
            .evaluations = motion.statistics.evaluations,
            .energy_drift = account.energy_error.energy(),
            .work_balance = account.energy_error.balance(),
            .stopped = motion.ending == Ending::stopped_by_event,
            .failure = motion.failure ? motion.failure->message : std::string(),
            .along = along ? account.along.values() : std::vector<double>(),
            .ended = account.ended.found()};
}

}  // namespace

bool is_phased(const Mechanism& m, const Program& program) {
    if (has_jumps(m) || !m.frictions.empty() || !tables_with_close_knots(program).empty() ||
        TableWatch::has_work(program) || Corners::of(m))
        return true;
    if (std::any_of(m.masses.begin(), m.masses.end(), [](const auto& e) { return !e.mass_rate.is_zero(); }))
        return true;
    const std::optional<Switched> jumps = switched(program);
    return jumps && std::any_of(jumps->functions.begin(), jumps->functions.end(), [&](int function) {
               const Op op = program[function].op;  // steps end at knots of tables too, so that no order falls
               return op == Op::sign || op == Op::unspecified;
           });
}

PhasedMembers::PhasedMembers(const Derived& derived, const RunOptions& wishes, const MethodChoice& method,
                             const Options& options, bool along)
    : derived_(derived),
      options_(options),
      along_(along),
      work_(work_of(derived.mechanism)),
      compiled_(wishes, derived, work_, method) {
    compiled_.is_shared = true;
    if (changes_masses(derived.scene))
        bodies_ = std::make_shared<const InertiaCheck>(derived.scene, derived.mechanism);
    if (!has_jumps(derived.mechanism)) return;
    view_.emplace(derived.mechanism);
    kicks_.emplace(derived.mechanism, derived.scene);
}

Module PhasedMembers::compile(const State<double>& first) {
    free_ = &compiled_({}, first);
    has_long_tables_ = TableWatch::has_work(free_->program);
    return free_->code.module;
}

std::optional<std::string> PhasedMembers::obstacle(const Start& start) const {
    if (derived_.mechanism.unilateral.empty()) return {};
    const std::vector<Diagnostic> negative =
        negative_gaps(derived_.mechanism, *view_, start.state(), std::max(options_.tolerance, 1e-9));
    return negative.empty() ? std::optional<std::string>() : negative[0].message;
}

/// Gaps and impulses are found by interpretation, with exact numbers, on one thread at a time.
Contacts PhasedMembers::contacts_at(const Start& start) {
    if (!view_) return {};
    std::recursive_mutex& symbols = compiled_.symbols;
    const std::lock_guard lock(symbols);
    const auto guarded = [&symbols](auto function) {
        return [&symbols, function = std::move(function)](const auto&... arguments) {
            const std::lock_guard while_called(symbols);
            return function(arguments...);
        };
    };
    Contacts contacts = contacts_of(derived_, start, *view_, *kicks_);
    contacts.situation = guarded(std::move(contacts.situation));
    contacts.kicks.impulses = guarded(std::move(contacts.kicks.impulses));
    contacts.kicks.passed = guarded(std::move(contacts.kicks.passed));
    if (contacts.kicks.set) contacts.kicks.set = guarded(std::move(contacts.kicks.set));
    if (contacts.kicks.refusal) contacts.kicks.refusal = guarded(std::move(contacts.kicks.refusal));
    if (contacts.kicks.speeds) contacts.kicks.speeds = guarded(std::move(contacts.kicks.speeds));
    return contacts;
}

Outcome PhasedMembers::followed(const Member& member, std::vector<double>& state) {
    const std::size_t n = static_cast<std::size_t>(derived_.mechanism.size()), width = state.size();
    const auto middle = state.begin() + static_cast<std::ptrdiff_t>(n);
    const auto first_of_states = static_cast<std::ptrdiff_t>(first_state(width, derived_.mechanism)),
               states = static_cast<std::ptrdiff_t>(width) - first_of_states;
    const Start start{.parameters = member.parameters,
                      .t = member.start,
                      .q = {state.begin(), middle},
                      .qdot = std::vector<double>(n),
                      .speeds = {},
                      .states = {state.begin() + first_of_states, state.end()}};
    const State<double> first{.parameters = member.parameters,
                              .t = member.start,
                              .q = start.q,
                              .qdot = {middle, state.end()},
                              .qddot = {}};
    const bool works = work_ == Work::integrated;
    Account account{.energy_error = EnergyError(static_cast<int>(n), static_cast<int>(width - n), works),
                    .along = RunningExtrema(static_cast<int>(n), static_cast<int>(width)),
                    .ended = EndedEvents(derived_.mechanism.events.size())};
    std::optional<MassWatch> masses;
    if (bodies_) masses.emplace(derived_, member.parameters, width - n, bodies_);
    std::optional<TableWatch> tables;
    if (has_long_tables_) {
        const std::lock_guard lock(compiled_.symbols);
        tables.emplace(free_->program, with_held_parameters(member.parameters, free_->program));
        (*tables)(member.start, state);
    }
    LoadedModes modes(compiled_, start, first,
                      [&](LoadedMode& mode, double t, std::span<const double> y, std::span<const double> rate) {
                          if (masses) {
                              const std::lock_guard lock(compiled_.symbols);
                              (*masses)(t, y);
                          }
                          if (tables) (*tables)(t, y);
                          account.energy_error(mode.module.table(), mode.par, t, y, rate);
                          if (along_) account.along(t, y.data(), rate.data());
                          account.ended(mode.module.table(), mode.par.data(), t, y.data(), rate.data());
                      });
    const LoadedMode& free = modes({});
    Contacts contacts = contacts_at(start);
    const auto integrated = [&](double t, const double* y) {
        return as_integrated(contacts.kicks, t, {y, y + 2 * n + states});
    };
    contacts.on_jump = [&](double t, const double* before, const double* after, double jump) {
        account.energy_error.jump(free.module.table(), free.par, t, integrated(t, before).data(),
                                  integrated(t, after).data(), jump);
    };
    contacts.kicks.on_set = [&](double t, const double* before, const double* after) {
        if (tables) tables->jump();
        account.energy_error.set(free.module.table(), free.par, t, integrated(t, before).data(),
                                 integrated(t, after).data());
    };
    Options options = options_;
    options.start = member.start;
    options.duration = member.duration;
    modes.shorten_steps(quick_times_of(member));
    options.sample = member.duration;  // no rows but the end
    std::vector<double> initial = state;
    if (works) initial.push_back(0);
    const HybridMotion motion = follow(
        contacts, [&](const std::vector<int>& closed) -> const ContactMode& { return modes(closed).contact; },
        initial, options);
    const std::span<const double> end = motion.final_state();
    state.assign(end.begin(), end.begin() + static_cast<std::ptrdiff_t>(width));
    Outcome outcome = outcome_of(motion, account, along_);
    if (outcome.failure.empty() && tables && tables->passed())
        outcome.failure = say("not trustworthy: {}", TableWatch::text_of(*tables->passed()));
    return outcome;
}

Outcome PhasedMembers::operator()(const Member& member, std::vector<double>& state) {
    const auto refused = [&](const char* why) {
        const double nothing = std::numeric_limits<double>::quiet_NaN();
        state.assign(state.size(), nothing);
        return Outcome{.time = nothing,
                       .energy_drift = nothing,
                       .work_balance = nothing,
                       .failure = why,
                       .along = std::vector<double>(along_ ? 3 * state.size() : 0, nothing)};
    };
    try {
        return followed(member, state);
    } catch (const ModelError& error) {
        return refused(error.what());
    } catch (const IntegrationError& error) {
        return refused(error.what());
    }
}

}  // namespace alembert
