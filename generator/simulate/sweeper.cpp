// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/sweeper.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "alembert/base/process_time.hpp"
#include "alembert/native/fingerprint.hpp"
#include "analysis/contact/contacts.hpp"
#include "analysis/state/assemble.hpp"
#include "base/language/say.hpp"
#include "codegen/emit/emit.hpp"
#include "model/formalism/with_states.hpp"
#include "program/event_code.hpp"
#include "program/lower/lower.hpp"
#include "simulate/kept_energy.hpp"
#include "simulate/method.hpp"
#include "simulate/regularization.hpp"
#include "simulate/rows.hpp"
#include "simulate/sides.hpp"
#include "simulate/solver_code.hpp"
#include "simulate/sweep_method.hpp"

namespace alembert {

namespace {

constexpr std::size_t most_checked = 1'000'000;  // bodies, before the first motion

/// After a check of the numbers.
Derived derived_for(Scene scene, const Grid& grid, const RunOptions& wishes) {
    check_numbers(wishes);
    check_grid(grid);
    return derived(std::move(scene), {.by = wishes.by, .use = Use::run});
}

/// Whether masses may change from motion to motion.
bool varies_parameters(const Mechanism& m, const std::vector<std::string>& names) {
    return std::any_of(m.parameters.begin(), m.parameters.end(), [&](const Mechanism::Parameter& p) {
        return std::find(names.begin(), names.end(), p.symbol.get_name()) != names.end();
    });
}

/// The rates at the end of a motion, whose state may have speeds instead.
std::vector<double> rates_at(const Program& program, const Module& module, const Member& member, double t,
                             std::span<const double> state) {
    const alembert_solver_table& table = module.table();
    if (program.speeds.empty()) return {state.begin() + table.coordinates, state.end()};
    std::vector<double> values = member.parameters;
    values.resize(static_cast<std::size_t>(table.parameters), 1.0);  // signs, on which rates do not depend
    const std::vector<double> par = prepared(module, values);
    std::vector<double> rate(state.size());
    table.rhs(t, state.data(), par.data(), rate.data());
    rate.resize(static_cast<std::size_t>(table.coordinates));
    return rate;
}

}  // namespace

Sweeper::Sweeper(Scene scene, Grid grid, const RunOptions& wishes, std::vector<std::string> along)
    : s_{derived_for(std::move(scene), grid, wishes)}, wishes_(wishes) {
    s_.grid = std::move(grid);
    s_.along = std::move(along);
    const Mechanism& m = s_.mechanism;
    if (asks_regularization(wishes, m))
        throw ModelError(
            say("sweep does not run regularized; simulate does, for one state at a time. Leave 'regularize' out"));
    if (!m.impulses.empty())
        s_.warn("before_impulses",
                say("{}: the motions start with the rates before the scene's impulses; 'alembert eval --impact' "
                    "gives those after\n",
                    s_.scene.file));
    const std::vector<std::string> names = s_.grid.names();
    starts_.emplace(m, names);
    has_varied_bodies_ = !m.masses.empty() && varies_parameters(m, names);
    const Energy energy = energy_of(m.unilateral.empty() ? m : with_all_closed(m));
    s_.conserved = energy.conserved && !may_jump_in_energy(m, energy);
    program_ = with_signs_told(s_, lowered(s_).program);
    for (const Quantity& q : program_.coordinates) s_.coordinates.push_back(q.name);
    const std::size_t others = first_state(program_.speeds.size(), m);
    for (std::size_t k = 0; k < others && !m.speeds.empty(); ++k)
        if (program_.speeds[k].rate_of < 0) s_.speeds.push_back(program_.speeds[k].name);
    for (const Mechanism::State& z : m.states) s_.states.push_back(z.derivative[0].get_name());
    check_columns(end_columns(s_), wishes.columns);
    const bool phased = !program_.singular && is_phased(m, program_);
    options_ = phased ? options_of_phased() : options_for();
    s_.method = name(options_.method);
    constraints_ = lower_constraints(m);
    left_out_.emplace(m);
    is_assembled_ = !m.constraints.empty() || !m.speeds.empty() || !m.redundant.empty();
    if (phased) {
        phased_.emplace(s_, wishes_, choice_, options_, !s_.along.empty());
    } else {
        const Source source = emit(program_, {.batch = true});
        source_ = source.text;
        s_.formulation = source.formulation;
        s_.operations = source.operations.total();
    }
    make_key();
}

Options Sweeper::options_of_phased() {
    given_method(wishes_, s_);
    const Start start = start_of(s_.mechanism);
    choice_ = method_for(wishes_, s_, program_, start);
    return options_of(wishes_, choice_, start);
}

Options Sweeper::options_for() {
    const Start start = start_of(s_.mechanism);
    choice_ = method_for_sweep(wishes_, s_, program_, start, !s_.along.empty());
    return options_of(wishes_, choice_, start);
}

void Sweeper::make_key() {
    Fingerprint print;
    for (const std::string& text :
         {std::string(ALEMBERT_VERSION), s_.scene.text, source_, wishes_.by, s_.method, wished_code(wishes_)})
        print.add(text);
    for (const std::optional<double>& wish : {wishes_.duration, wishes_.tolerance, wishes_.step, wishes_.max_step})
        print.add(wish ? fmt::format("{}", *wish) : std::string("-"));
    print.add(fmt::format("{} {} {}", wishes_.budget, wishes_.fast_math, s_.grid.size()));
    for (const std::string& statistic : s_.along) print.add(statistic);
    for (const Axis& axis : s_.grid.axes)
        print.add(fmt::format("{} {} {} {}", axis.name, axis.from, axis.to, axis.count));
    for (const double value : s_.grid.listed) print.add(fmt::format("{}", value));
    for (std::size_t k = 0; k < std::min<std::size_t>(3, s_.grid.size());
         ++k)  // they show kind and seed of samples
        for (const double value : s_.grid.point(k)) print.add(fmt::format("{}", value));
    key_ = print.hex();
}

void Sweeper::check() {
    if (program_.singular) {
        const State<double> first = state_of(start_of(s_.mechanism), s_.mechanism, s_.equations);
        throw IntegrationError(failure_at(s_, first).value_or(say("the mass matrix is singular")), first.t,
                               first.q);
    }
    if (!has_varied_bodies_) return;
    const InertiaCheck check(s_.scene, s_.mechanism);
    const std::vector<std::string> names = s_.grid.names();
    std::set<Place> told;
    for (std::size_t k = 0; k < std::min(most_checked, s_.grid.size()); ++k) {
        const std::vector<double> values = s_.grid.point(k);
        const Possible<Start> start = starts_->possible(values);
        if (!start.exists()) continue;  // its row gives the reason
        for (Diagnostic& one : check.findings(start.value().state())) {
            for (std::size_t i = 0; i < values.size(); ++i)
                one.message += fmt::format("{}{} = {:.6g}", i == 0 ? say(", at ") : ", ", names[i], values[i]);
            if (one.severity == Severity::error) fail(s_.scene, {one});
            if (told.insert(one.place).second) s_.warn({one});
        }
    }
}

void Sweeper::compile_phased() {
    ensemble_.emplace(
        Ensemble{.module = phased_->compile(state_of(start_of(s_.mechanism), s_.mechanism, s_.equations))});
    ensemble_->by = [this](const Member& member, std::vector<double>& state) { return (*phased_)(member, state); };
    s_.formulation = phased_->free().run().formulation;
    s_.operations = phased_->operations();
    s_.timings.compile = phased_->seconds_of_compiler();
}

void Sweeper::compile_smooth() {
    const double begin = process_seconds();
    ensemble_.emplace(Ensemble{.module = batch_code(program_, source_, wishes_).module});
    ensemble_->along = !s_.along.empty();
    ensemble_->work = s_.conserved ? Work::left_out : Work::integrated;
    if (needs_series(options_.method)) {
        BatchSeries series = batch_series(program_, !s_.conserved, wishes_);
        ensemble_->series = std::move(series.module);
        ensemble_->series_packs = std::move(series.packs);
    }
    s_.timings.compile = process_seconds() - begin;
    ensemble_->event_code = event_code(program_);
    ensemble_->place_code = quick_places_code(program_, Kinks::watched);
    for (const Mechanism::EventAction& event : s_.mechanism.event_actions) {
        ensemble_->stops.push_back(event.stop);
        ensemble_->directions.push_back(event.direction);
    }
}

void Sweeper::compile() {
    if (phased_)
        compile_phased();
    else
        compile_smooth();
    const double begin = process_seconds();
    if (has_varied_bodies_ && s_.grid.size() > most_checked) bodies_.emplace(s_.scene, s_.mechanism);
    if (!has_fixed_step(options_.method)) {
        variants_.emplace(phased_ ? phased_->free().program : program_, *starts_, s_.grid, wishes_.duration);
        if (variants_->has_too_many())
            s_.warnings.push_back(
                say("only {} variants of the inputs were searched for narrow pulses; a longest step "
                    "(max_step) bounds the steps of all\n",
                    InputVariants::most));
    }
    s_.timings.start = process_seconds() - begin;
}

void Sweeper::run(const SweepDesk& desk, int threads) {
    const double begin = process_seconds();
    ensemble_->threads = threads;
    const EnsembleFeed feed{.next = [&] { return next(desk); },
                            .done =
                                [&](const Member& member, const Outcome& outcome, std::span<const double> state) {
                                    note_ended(member.index, outcome.ended);
                                    keep(member.index, motion_of(member, outcome, state), desk);
                                },
                            .breathe = desk.breathe,
                            .most = desk.most};
    const Feeding used = integrate(*ensemble_, feed, options_);
    s_.packed = used.packed;
    s_.threads = used.threads;
    tell_ended();
    s_.timings.integrate = process_seconds() - begin;
    if (!phased_) return;
    const double seconds = phased_->seconds_of_compiler();  // some modes were compiled while motions ran
    s_.timings.integrate -= seconds - std::exchange(s_.timings.compile, seconds);
    s_.operations = phased_->operations();
}

std::optional<Member> Sweeper::next(const SweepDesk& desk) {
    const std::lock_guard lock(taking_);
    for (;;) {
        if (current_.count == 0) {
            const std::optional<SweepPart> part = desk.next();
            if (!part) return std::nullopt;
            current_ = *part;
            const std::lock_guard both(giving_);
            taken_ =
                &open_.emplace(part->first, OpenPart{*part, std::vector<SweptMotion>(part->count), part->count})
                     .first->second;
        }
        --current_.count;
        if (std::optional<Member> found = member(current_.first++, desk)) return found;
    }
}

std::optional<Member> Sweeper::member(std::size_t k, const SweepDesk& desk) {
    const std::vector<double> values = s_.grid.point(k);
    taken_->motions[k - taken_->part.first].varied = values;
    std::unique_lock<std::recursive_mutex> symbols;
    if (phased_) symbols = std::unique_lock(phased_->symbols());
    try {
        Start start = starts_->at(values);
        if (const std::optional<std::string> why = impossible_body(start)) throw ModelError(*why);
        if (is_assembled_) {
            Overrides held;
            for (std::size_t i = 0; i < values.size(); ++i) held.emplace_back(s_.grid.axes[i].name, values[i]);
            assemble(start, s_.mechanism, constraints_, held, *left_out_);
        }
        if (phased_)
            if (const std::optional<std::string> why = phased_->obstacle(start)) throw ModelError(*why);
        const State<double> first = state_of(start, s_.mechanism, s_.equations);
        Member member{.index = k,
                      .state = first.q,
                      .parameters = start.parameters,
                      .start = start.t,
                      .duration = wishes_.duration.value_or(start.duration)};
        if (!std::isfinite(member.duration) || member.duration < 0)
            throw ModelError(
                say("the motion would take {} s; expected a finite number, zero or more", member.duration));
        member.state.insert(member.state.end(), first.qdot.begin(), first.qdot.end());
        if (variants_) member.quick_times = variants_->quick_times(start);
        return member;
    } catch (const ModelError& error) {
        keep(k, refused(error.what()), desk);
    } catch (const IntegrationError& error) {
        keep(k, refused(error.what()), desk);
    }
    return std::nullopt;
}

std::optional<std::string> Sweeper::impossible_body(const Start& start) const {
    if (!bodies_) return {};
    for (const Diagnostic& one : bodies_->findings(start.state()))
        if (one.severity == Severity::error) return one.message;
    return {};
}

SweptMotion Sweeper::refused(const std::string& why) const {
    const double nothing = std::numeric_limits<double>::quiet_NaN();
    const std::vector<double> none(s_.coordinates.size(), nothing);
    return {.varied = {},  // when it is kept
            .final_coordinates = none,
            .final_rates = none,
            .final_speeds = std::vector<double>(s_.speeds.size(), nothing),
            .final_states = std::vector<double>(s_.states.size(), nothing),
            .along = std::vector<double>(along_columns(s_).size(), nothing),
            .time = nothing,
            .drift = nothing,
            .status = why,
            .failed = true};
}

SweptMotion Sweeper::motion_of(const Member& member, const Outcome& outcome, std::span<const double> state) const {
    const auto n = static_cast<std::ptrdiff_t>(s_.coordinates.size());
    SweptMotion m{.varied = {},  // when it is kept
                  .final_coordinates = {state.begin(), state.begin() + n},
                  .final_rates = rates_at(program_, ensemble_->module, member, outcome.time, state),
                  .final_speeds = {},
                  .final_states = {state.end() - static_cast<std::ptrdiff_t>(s_.states.size()), state.end()}};
    if (!s_.speeds.empty())
        m.final_speeds.assign(state.begin() + n,
                              state.begin() + n + static_cast<std::ptrdiff_t>(s_.speeds.size()));
    for (const std::string& statistic : s_.along) {
        const std::size_t block = statistic == "min" ? 0 : statistic == "max" ? 1 : 2;
        const auto first = outcome.along.begin() + static_cast<std::ptrdiff_t>(block * state.size());
        m.along.insert(m.along.end(), first, first + static_cast<std::ptrdiff_t>(state.size()));
    }
    m.time = outcome.time;
    m.drift = s_.conserved ? outcome.energy_drift : outcome.work_balance;
    m.steps = outcome.steps;
    m.rejected = outcome.rejected;
    m.evaluations = outcome.evaluations;
    m.failed = !outcome.failure.empty();
    m.status = m.failed ? outcome.failure : outcome.stopped ? "stopped" : "done";
    if (!m.failed && s_.conserved && std::isnan(m.drift)) {
        m.failed = true;
        m.status =
            say("the energy, which should stay, is not a number: its terms are too large or too small for "
                "double precision, or divide by zero");
    }
    return m;
}

void Sweeper::note_ended(std::size_t k, const std::vector<EndedEvents::One>& ended) {
    if (ended.empty()) return;
    const std::lock_guard lock(giving_);
    for (const EndedEvents::One& one : ended) {
        const auto known = ended_.try_emplace(one.event, k, one).first;
        if (k < known->second.first) known->second = {k, one};
    }
}

void Sweeper::tell_ended() {
    for (const auto& [event, first] : std::exchange(ended_, {}))
        s_.warn("not_a_number", warning_of_end(s_.mechanism.events[static_cast<std::size_t>(event)].name,
                                               first.second.last, first.second.first_without));
}

void Sweeper::keep(std::size_t k, SweptMotion motion, const SweepDesk& desk) {
    const std::lock_guard lock(giving_);
    const auto at = std::prev(open_.upper_bound(k));
    OpenPart& open = at->second;
    s_.computed += static_cast<double>(motion.evaluations);
    SweptMotion& place = open.motions[k - open.part.first];
    motion.varied = std::move(place.varied);
    place = std::move(motion);
    if (--open.left > 0) return;
    OpenPart whole = std::move(open);
    open_.erase(at);
    desk.done(whole.part, std::move(whole.motions));
}

}  // namespace alembert
