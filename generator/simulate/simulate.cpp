// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/simulate.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "alembert/base/process_time.hpp"
#include "alembert/ode/energy_error.hpp"
#include "analysis/contact/contacts.hpp"
#include "analysis/state/assemble.hpp"
#include "base/language/libraries.hpp"
#include "base/language/say.hpp"
#include "model/formalism/with_states.hpp"
#include "program/lower/lower.hpp"
#include "program/lower/quick_times.hpp"
#include "simulate/consistent_mode.hpp"
#include "simulate/kept_energy.hpp"
#include "simulate/mass_watch.hpp"
#include "simulate/method.hpp"
#include "simulate/regularization.hpp"
#include "simulate/run_contacts.hpp"
#include "simulate/sides.hpp"
#include "simulate/trust.hpp"

namespace alembert {

namespace {

/// The state at which the computation failed.
State<double> state_at(State<double> state, const Failure& failure) {
    state.t = failure.time;
    const auto middle = failure.state.begin() + static_cast<std::ptrdiff_t>(state.q.size());
    state.q.assign(failure.state.begin(), middle);
    state.qdot.assign(middle, middle + static_cast<std::ptrdiff_t>(state.qdot.size()));
    return state;
}

/// The quantities that are watched at every step of the main run, but not in the runs that estimate its error.
struct Watch {
    EnergyError energy_error;
    std::optional<TableWatch> tables = {};
    PoseWatch poses = {};
    double constraint_drift = 0;
    long steps = 0;
    bool near_lock = false;
    bool is_over = false;
};

/// The computation of a Run from a scene.
class Simulating {
public:
    Simulating(Run& run, const RunOptions& wishes)
        : run_(run),
          wishes_(wishes),
          has_contacts_(!run.mechanism.unilateral.empty()),
          // With contacts, the energy account must be valid in all their modes.
          energy_(energy_of(has_contacts_ ? with_all_closed(run.mechanism) : run.mechanism)) {}

    void run() {
        const double begin = process_seconds();
        Program program = with_signs_told(run_, lowered(run_).program);
        start_ = start_of(run_.mechanism);
        run_.adjusted = assemble(start_, run_.mechanism, lower_constraints(run_.mechanism), {});
        first_ = state_of(start_, run_.mechanism, run_.equations);
        if (changes_masses(run_.scene)) masses_.emplace(run_, start_.parameters, first_.qdot.size());
        if (!wishes_.sensitivity.empty())
            sensitivities_.emplace(run_, program, start_, wishes_.sensitivity, wishes_.sensitivity_of);
        choice_ = method_for(wishes_, run_, program, start_);
        options_ = options_of(wishes_, choice_, start_);
        options_.regularization = regularization_of(wishes_, run_, energy_, choice_, start_);
        run_.is_regularized = options_.regularization != Regularization::none;
        prepare_contacts();
        run_.timings = {.derive = run_.seconds, .emit = process_seconds() - begin};
        angles_ = angles_of_frame(run_, choice_);
        Watch watch = fresh_watch();
        CompiledModes compiled(wishes_, run_, work(), choice_);
        compiled.take_free(std::move(program));
        LoadedModes modes(
            compiled, start_, first_,
            [&](LoadedMode& mode, double t, std::span<const double> state, std::span<const double> rate) {
                reach(state);
                if (masses_) (*masses_)(t, state);
                if (!watch.is_over) look(watch, mode, t, state, rate);
            });
        tell_sides(modes, watch);
        const LoadedMode& free = modes({});
        if (wishes_.reactions && has_reactions(run_.mechanism))
            reactions_ = joint_reactions(run_.scene, run_.mechanism);
        std::vector<std::string> columns = row_columns(run_.mechanism, free.program, reactions());
        check_recorded(run_.scene, columns);
        columns.erase(columns.begin());  // t is the other axis of a picture
        check_columns(columns, wishes_.columns);
        quick_times_ = quick_times(free.program, with_held_parameters(start_.parameters, free.program),
                                   options_.start, options_.start + options_.duration);
        modes.shorten_steps(quick_times_);
        watch.tables = table_watch(free);
        contacts_.on_jump = [&](double t, const double* before, const double* after, double jump) {
            if (!watch.is_over) look_at_jump(watch, free, t, before, after, jump);
        };
        contacts_.kicks.on_set = [&](double t, const double* before, const double* after) {
            if (watch.is_over) return;
            set_at_ = t;
            if (watch.tables) watch.tables->jump();
            const std::size_t size = 2 * run_.mechanism.q.size() + run_.mechanism.states.size();
            const std::vector<double> a = as_integrated(contacts_.kicks, t, {before, before + size}),
                                      b = as_integrated(contacts_.kicks, t, {after, after + size});
            watch.energy_error.set(free.module.table(), free.par, t, a.data(), b.data());
        };
        try_methods(modes);
        integrate(modes);
        if (watch.near_lock && !run_.is_regularized && take_quaternion(modes)) {
            watch = fresh_watch();
            watch.tables = table_watch(free);
            integrate(modes);
            run_.chart_frame = angles_->name(run_.scene).text;
            run_.chart_passes = charts_->passes();
        }
        add_seconds(modes);
        watch.is_over = true;
        settle_account(watch);
        refuse_start_without_energy(free);
        add_instants(run_.instants, run_.mechanism, run_.motion, contacts_.names);
        if (wishes_.estimate && !run_.motion.failure && options_.duration > 0) estimate(modes, free, watch);
        if (sensitivities_ && !run_.motion.failure)
            run_.sensitivity = sensitivities_->at(
                run_.motion.final_time(), {.tolerance = options_.tolerance,
                                           .budget = wishes_.budget,
                                           .sample = wishes_.sensitivity_rows ? sample_interval(options_) : 0,
                                           .instants = run_.instants,
                                           .progress = wishes_.progress});
        describe(modes, free);
    }

private:
    /// What friction and the sides of functions do along the motion, until `watch` is over.
    void tell_sides(LoadedModes& modes, const Watch& watch) {
        modes.on_side_change = [this, &watch](const LoadedModes::SideChange& side) {
            if (watch.is_over) return;
            const ModeChange& change = side.change;
            if (side.frictions.empty())
                run_.side_changes.push_back({change.time, side.name, change.kind, side.is_knot});
            const bool is_crossed = change.kind == ModeChange::Kind::crossing;
            run_.instants.list.push_back({is_crossed ? JumpInstant::Kind::side : JumpInstant::Kind::holding,
                                          change.index, change.time, side.name});
            for (const Switched::Rubbing& one : side.frictions)
                note(run_.friction_changes,
                     {change.time, one.friction, one.direction * change.side, change.direction});
        };
        modes.on_side_begin = [this, &watch](const ModeChange& change,
                                             const std::vector<Switched::Rubbing>& frictions) {
            if (!watch.is_over && change.time == options_.start) {
                std::vector<int>& sides = run_.instants.sides;
                sides.resize(std::max(sides.size(), static_cast<std::size_t>(change.index) + 1), 0);
                sides[static_cast<std::size_t>(change.index)] = change.side;
            }
            // What an impact leaves of a velocity may be rounding.
            if (watch.is_over || (has_contacts_ && change.time != set_at_)) return;
            for (const Switched::Rubbing& one : frictions)  // after an event it may stick no more
                if (sticks(one.friction))
                    note(run_.friction_changes,
                         {change.time, one.friction, one.direction * change.side, change.direction});
        };
    }

    void prepare_contacts() {
        if (!has_jumps(run_.mechanism)) return;
        view_.emplace(run_.mechanism);
        kicks_.emplace(run_.mechanism, run_.scene);
        contacts_ = contacts_of(run_, start_, *view_, *kicks_);
        if (has_contacts_)
            check_gaps(run_.scene, run_.mechanism, *view_, start_.state(), std::max(options_.tolerance, 1e-9));
    }

    /// Whether a friction stuck when it was last told.
    bool sticks(int friction) const {
        const auto last = std::find_if(run_.friction_changes.rbegin(), run_.friction_changes.rend(),
                                       [&](const auto& known) { return known.friction == friction; });
        return last != run_.friction_changes.rend() && last->side == 0;
    }

    /// A change to the same state is not recorded. Frictions that stick at one instant come in the order of the
    /// scene: rounding decides which is found first.
    static void note(std::vector<Run::FrictionChange>& changes, const Run::FrictionChange& change) {
        const auto last = std::find_if(changes.rbegin(), changes.rend(),
                                       [&](const auto& known) { return known.friction == change.friction; });
        if (last != changes.rend() && last->side == change.side) return;
        const auto place = std::find_if(changes.rbegin(), changes.rend(), [&](const auto& known) {
            return known.time != change.time || known.side != 0 || change.side != 0 ||
                   known.friction <= change.friction;
        });
        changes.insert(place.base(), change);
    }

    const JointReactions* reactions() const { return reactions_ ? &*reactions_ : nullptr; }

    void look(Watch& watch, LoadedMode& mode, double t, std::span<const double> state,
              std::span<const double> rate) const {
        watch.near_lock = watch.near_lock || (angles_ && angles_->evenness(state.data()) < to_quaternion);
        watch.energy_error(mode.module.table(), mode.par, t, state, rate);
        if (watch.tables) (*watch.tables)(t, state);
        if (wishes_.estimate) watch.poses(t, state, start_.q.size(), first_.qdot.size());
        if (mode.contact.system.project)
            watch.constraint_drift = std::max(watch.constraint_drift, mode.projection.residual(t, state.data()));
        // A report costs more than a step of a small system.
        if (wishes_.progress && ++watch.steps % 1000 == 0)
            wishes_.progress(say("integrating"), (t - options_.start) / options_.duration);
    }

    void look_at_jump(Watch& watch, const LoadedMode& free, double t, const double* before, const double* after,
                      double jump) const {
        const std::size_t size = 2 * run_.mechanism.q.size() + run_.mechanism.states.size();
        const std::vector<double> a = as_integrated(contacts_.kicks, t, {before, before + size}),
                                  b = as_integrated(contacts_.kicks, t, {after, after + size});
        watch.energy_error.jump(free.module.table(), free.par, t, a.data(), b.data(), jump);
    }

    /// Widens what the run has reached by a state.
    void reach(std::span<const double> state) {
        if (reached_.empty())
            for (const double y : state) reached_.push_back({y, y});
        for (std::size_t i = 0; i < std::min(reached_.size(), state.size()); ++i)
            reached_[i] = hull(reached_[i], {state[i], state[i]});
    }

    HybridMotion followed(LoadedModes& modes, const Options& options, const std::vector<double>& from) {
        modes.begin();
        reached_.clear();
        return follow(
            contacts_, [&](const std::vector<int>& closed) -> const ContactMode& { return modes(closed).contact; },
            from, options);
    }

    std::vector<double> initial_state() const {
        std::vector<double> initial = start_.q;
        initial.insert(initial.end(), first_.qdot.begin(), first_.qdot.end());
        if (!energy_.conserved) initial.push_back(0);
        return initial;
    }

    /// A long run takes the method that is the fastest in its first part.
    void try_methods(LoadedModes& modes) {
        if (choice_.rivals.empty() || has_jumps(run_.mechanism) || run_.is_regularized) return;
        ContactMode& mode = modes({}).contact;
        if (mode.switching) return;
        const std::optional<MethodTrial> trial = method_trial(mode.system, initial_state(), options_,
                                                              choice_.rivals, {.begin = [&] { modes.begin(); }});
        if (!trial) return;
        choice_ = after_trial(choice_, *trial);
        options_.method = choice_.method;
        options_.when_stuck = choice_.when_stuck;
        options_.when_cheaper = choice_.when_cheaper;
        if (needs_series(choice_.method) && !mode.system.rhs.series) mode.system.rhs = mode.system.with_series();
    }

    void integrate(LoadedModes& modes) {
        initial_ = initial_state();
        if (run_.is_regularized) need_depth(modes({}).contact.system.rhs, start_.t, initial_);
        const auto making = [&] {
            return modes.compiled().seconds().derive + modes.compiled().seconds().emit +
                   modes.compiled().seconds().compile;
        };
        const double made_before = making(), begin = process_seconds();
        run_.motion = followed(modes, options_, initial_);
        run_.timings.integrate = process_seconds() - begin - (making() - made_before);
        for (const Phase& phase : run_.motion.phases) modes(phase.closed).measure_sides(phase.motion);
    }

    Work work() const { return energy_.conserved ? Work::left_out : Work::integrated; }

    Watch fresh_watch() const {
        return {.energy_error =
                    EnergyError(run_.mechanism.size(), static_cast<int>(first_.qdot.size()), !energy_.conserved)};
    }

    TableWatch table_watch(const LoadedMode& free) const {
        TableWatch tables(free.program, with_held_parameters(start_.parameters, free.program));
        tables(start_.t, initial_state());
        return tables;
    }

    /// Prepares the run with a quaternion near gimbal lock; false if the scene does not allow it.
    bool take_quaternion(LoadedModes& modes) {
        ContactMode& mode = modes({}).contact;
        if (mode.switching) return false;
        try {
            charts_.emplace(run_, *angles_, start_.parameters, work(), wishes_);
        } catch (const CompileError&) {
            throw;
        } catch (const std::runtime_error& reason) {
            run_.warn("gimbal_lock",
                      say("warning: the angles of {} come near gimbal lock, and the run stays in them: {}\n",
                          angles_->is_joint ? say("joint '{}'", angles_->name(run_.scene).text)
                                            : say("frame '{}'", angles_->name(run_.scene).text),
                          reason.what()));
            return false;
        }
        mode.system.by = charts_->integrator();
        mode.system.with_series = {};
        return true;
    }

    void add_seconds(LoadedModes& modes) {
        const CompiledModes::Seconds& seconds = modes.compiled().seconds();
        run_.timings.derive += seconds.derive;
        run_.timings.emit += seconds.emit;
        run_.timings.compile += seconds.compile;
    }

    void settle_account(const Watch& watch) {
        EnergyAccount& account = run_.energy;
        account.set_change = watch.energy_error.set_change();
        account.conserved = energy_.conserved && !account.set_change &&
                            !has_jumped_in_energy(run_.motion, run_.mechanism, contacts_.restitution);
        account.jacobi_conserved = !energy_.conserved && energy_.jacobi_conserved && !has_contacts_;
        account.drift = watch.energy_error.energy();
        account.balance = watch.energy_error.balance();
        account.jacobi_drift = watch.energy_error.jacobi();
        for (const ContactEvent& event : run_.motion.contacts) account.impact_loss += event.energy_loss;
        for (const EventRecord& event : run_.motion.events) account.impulse_work += event.energy_gain;
        run_.constraint_drift = watch.constraint_drift;
    }

    /// Where the energy divides by zero at the start, the equations do too, although what they divide may be 0
    /// there as well, so that rates come out.
    void refuse_start_without_energy(const LoadedMode& free) {
        if (run_.motion.failure || !run_.energy.conserved || !std::isnan(run_.energy.drift)) return;
        State<double> state = first_;
        state.parameters = with_held_parameters(std::move(state.parameters), free.program);
        if (!divides_by_zero_at(free.derived, state)) return;
        run_.motion.failure = Failure{
            .kind = FailureKind::not_a_number,
            .message = say("the energy, which should stay, is not a number: its terms are too large or too "
                           "small for double precision, or divide by zero"),
            .time = start_.t,
            .state = initial_};
    }

    /// Where rows of constraints nearly depend on each other, as those of a linkage that lies flat, a root of
    /// roundings is left in the constraints and in the rates, by chance and in each run another: the difference of
    /// two runs may be much less than the error of both, but the energy tells it. Rates that are all wrong by the
    /// part ρ make T wrong by 2ρ T, and coordinates by ρ of the way that follows.
    void raise_where_flat(const Watch& watch) {
        constexpr double rounding = 1e-12, safety = 2.5;  // as for the difference of two runs
        const double drift =
            run_.energy.conserved ? watch.energy_error.energy_of_motion() : watch.energy_error.balance_of_motion();
        if (run_.mechanism.constraints.empty() || !run_.estimate->value || !std::isfinite(drift) ||
            !(watch.constraint_drift > rounding * size_of(run_.motion, run_.mechanism.q.size())))
            return;
        const double part = safety * drift / 2;
        double largest = 0;
        for (std::size_t i = 0; i < std::min(reached_.size(), start_.q.size() + first_.qdot.size()); ++i) {
            const Interval& one = reached_[i];
            const double moved = i < start_.q.size() ? one.high - one.low : one.size();
            largest = std::max(largest, moved / std::max(1.0, one.size()));
        }
        run_.estimate->value = std::max(*run_.estimate->value, part * largest);
        if (run_.estimate->scaled) run_.estimate->scaled = std::max(*run_.estimate->scaled, part);
    }

    void estimate(LoadedModes& modes, const LoadedMode& free, const Watch& watch) {
        const double begin = process_seconds();
        const std::size_t coordinates = start_.q.size(), speeds = first_.qdot.size();
        Components components = components_of(free.program, coordinates, speeds);
        if (!run_.mechanism.speeds.empty())
            components.rates = [&, all = std::vector<double>(initial_.size())](
                                   double t, std::span<const double> state, std::span<double> rates) mutable {
                free.contact.system.rhs(t, state.data(), all.data());
                std::copy_n(all.begin(), rates.size(), rates.begin());
            };
        components.reached = [this] { return reached_; };
        run_.estimate = error_estimate(
            run_.motion,
            [&](const Options& options, const std::vector<double>& from) {
                return followed(modes, options, from);
            },
            options_, initial_, components);
        raise_where_flat(watch);
        const bool fixed = has_fixed_step(options_.method) && choice_.sundials.empty();
        const bool conserved = run_.energy.conserved;
        run_.distrust_reasons = distrust_reasons(
            {.error = *run_.estimate,
             .energy = conserved ? std::optional(watch.energy_error.energy_of_motion()) : std::nullopt,
             .balance = conserved ? std::nullopt : std::optional(watch.energy_error.balance_of_motion()),
             .jacobi = run_.energy.jacobi_conserved ? std::optional(watch.energy_error.jacobi_of_motion())
                                                    : std::nullopt,
             .constraints = watch.constraint_drift > 0
                                ? watch.constraint_drift / size_of(run_.motion, coordinates + speeds)
                                : 0,
             .singular = most_singular(run_.motion, free, watch.poses),
             .precision = fixed ? run_.estimate->value.value_or(0) : options_.tolerance,
             .fixed_step = fixed ? options_.step : 0,
             .inputs = quick_times_,
             .passed = watch.tables ? watch.tables->passed() : std::nullopt,
             .passed_place = run_.motion.statistics.passed_place});
        run_.timings.estimate = process_seconds() - begin;
    }

    /// Sets names, rows and the end, so that the loaded modes are not needed any more.
    void describe(LoadedModes& modes, const LoadedMode& free) {
        const Mechanism& m = run_.mechanism;
        run_.why_method = choice_.why;
        run_.solver = {.formulation = free.compiled.run().formulation,
                       .operations = modes.compiled().operations(),
                       .jacobian_operations = free.compiled.jacobian_operations,
                       .code = free.compiled.kind,
                       .from_cache = free.compiled.code.from_cache};
        for (const Quantity& q : free.program.coordinates) run_.coordinates.push_back(q.name);
        const auto end = run_.motion.final_state();
        run_.final_coordinates.assign(end.begin(), end.begin() + m.size());
        const std::size_t other = first_state(free.program.speeds.size(), m);
        if (!m.speeds.empty())
            for (std::size_t k = 0; k < other; ++k) {
                if (free.program.speeds[k].rate_of >= 0) continue;
                run_.speeds.push_back(free.program.speeds[k].name);
                run_.final_speeds.push_back(end[m.q.size() + k]);
            }
        for (std::size_t k = 0; k < m.states.size(); ++k) run_.final_states.push_back(end[m.q.size() + other + k]);
        std::vector<double> rates(end.size());
        free.contact.system.rhs(run_.motion.final_time(), end.data(), rates.data());
        run_.final_rates.assign(rates.begin(), rates.begin() + m.size());
        run_.contacts = contacts_.names;
        run_.rows = rows_of(run_.motion, run_, modes, reactions(), first_);
        if (has_records(m)) run_.event_rows = rows_at_events(run_.motion, run_, modes, reactions(), first_);
        for (const EndedEvent& one : ended_events(run_.motion, m, modes))
            run_.warn("not_a_number", warning_of_end(one.name, one.last, one.first_without));
        if (run_.motion.failure) run_.failure = reason_of(*run_.motion.failure, modes);
    }

    std::string reason_of(const Failure& failure, LoadedModes& modes) const {
        if (failure.kind == FailureKind::no_contact_mode || failure.kind == FailureKind::endless_kicks ||
            failure.kind == FailureKind::impossible_event || failure.kind == FailureKind::no_side)
            return translated_from_library(failure.message);
        const LoadedMode& last = modes(run_.motion.phases.back().closed);
        State<double> state = state_at(first_, failure);
        std::optional<std::string> there;
        if (failure.kind == FailureKind::step_underflow && last.compiled.jumps &&
            last.compiled.jumps->has_frictions())
            there = jamming_friction(*last.compiled.jumps, state);
        state.parameters = with_held_parameters(std::move(state.parameters), last.program);
        if (!there && masses_) there = masses_->used_up({options_.start, initial_}, {failure.time, failure.state});
        if (!there) there = failure_at(last.derived, state);
        return translated_from_library(failure.message) + (there ? say("\n  there: {}", *there) : "");
    }

    Run& run_;
    const RunOptions& wishes_;
    bool has_contacts_;
    std::optional<double> set_at_;  ///< when events last set states
    Energy energy_;
    Start start_;
    State<double> first_;
    std::optional<MassWatch> masses_;  ///< where masses change
    MethodChoice choice_;
    Options options_;
    std::vector<InputTimeScale> quick_times_;
    std::optional<ContactView> view_;
    std::optional<KickView> kicks_;
    Contacts contacts_;
    std::vector<double> initial_;
    std::vector<Interval> reached_;  ///< the values of each component at the ends of steps
    std::optional<JointReactions> reactions_;
    std::optional<AnglesOfFrame> angles_;
    std::optional<ChartRun> charts_;
    std::optional<Sensitivities> sensitivities_;
};

}  // namespace

Run simulate(Scene scene, const RunOptions& wishes) {
    check_numbers(wishes);
    Run result{derived(std::move(scene), {.by = wishes.by, .use = Use::run, .reactions = wishes.reactions})};
    if (!result.mechanism.impulses.empty())
        result.warn(
            "before_impulses",
            say("{}: the motion starts with the rates before the scene's impulses; 'alembert eval --impact' "
                "gives those after\n",
                result.scene.file));
    Simulating(result, wishes).run();
    return result;
}

}  // namespace alembert
