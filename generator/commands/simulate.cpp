// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "alembert/drift.hpp"
#include "analysis/assemble.hpp"
#include "analysis/contacts.hpp"
#include "analysis/joint_reactions.hpp"
#include "commands/estimate.hpp"
#include "commands/method.hpp"
#include "commands/progress.hpp"
#include "commands/record.hpp"
#include "commands/run_options.hpp"
#include "commands/trust.hpp"
#include "lower/quick_times.hpp"

namespace alembert {

namespace {

/// "radau from t = 0.31 on: …", for a person.
std::string described(const Switch& s) {
    return fmt::format("{} from t = {:.6g} on: the system is stiff there (an eigenvalue of size {:.3g}/s held the step at {:.3g} s)",
                       s.method, s.time, s.largest_eigenvalue, s.step);
}

/// The state where the numbers failed.
State<double> state_at(State<double> state, const Failure& failure) {
    state.t = failure.time;
    const auto middle = failure.state.begin() + static_cast<std::ptrdiff_t>(state.q.size());
    state.q.assign(failure.state.begin(), middle);
    state.qdot.assign(middle, middle + static_cast<std::ptrdiff_t>(state.qdot.size()));
    return state;
}

/// Does E stay with the system? Not where an impact has taken some of it, or an impulse changed it.
bool is_lossy(const PhasedMotion& motion, const Contacts& contacts) {
    return std::any_of(motion.events.begin(), motion.events.end(), [](const EventRecord& e) { return !e.impulse.empty(); }) ||
           std::any_of(motion.contacts.begin(), motion.contacts.end(), [&](const ContactEvent& e) {
        return e.kind == ContactEvent::Kind::impact && contacts.restitution[static_cast<std::size_t>(e.contact)] < 1;
    });
}

/// What the run measured of itself.
struct Account {
    bool conserved = true, jacobi_conserved = true;
    Drift drift;
    double constraint_drift = 0, impact_loss = 0, impulse_work = 0;
    Modes::Seconds seconds;
    double integrate_seconds = 0, estimate_seconds = 0;
    std::string why_method;  ///< empty where it was given
    bool closed = false;  ///< what runs now is not the result
    std::optional<ErrorEstimate> estimate = {};
    std::vector<std::string> reasons = {};  ///< against trusting it
    PoseWatch poses = {};
};

/// Why the result is not to be trusted; empty where nothing speaks against it.
std::string distrust(const Account& account) {
    return account.reasons.empty() ? std::string() : fmt::format("NOT TRUSTWORTHY: {}", fmt::join(account.reasons, "; "));
}

Json as_json(const ErrorEstimate& e, const std::vector<std::string>& reasons) {
    const auto number = [](const std::optional<double>& x) { return x ? Json(*x) : Json(nullptr); };
    Json result{{"value", number(e.value)},
                {"by", e.by},
                {"trustworthy", reasons.empty()},
                {"norm", "value: max |y - y2| / max(1, |y2|) of coordinates and speeds at the end; scaled: max |y - y2| / how far components of "
                         "that unit move in the run"},
                {"scaled", number(e.scaled)},
                {"reasons", reasons}};
    if (e.lyapunov) result["lyapunov_exponent"] = *e.lyapunov;
    if (e.horizon) result["no_digit_after"] = *e.horizon;
    return result;
}

/// q' at the end, where the state may hold speeds instead.
std::vector<double> final_rates(const PhasedMotion& motion, const LoadedMode& mode) {
    std::vector<double> rates(motion.final_state().size());
    mode.contact.rhs(motion.final_time(), motion.final_state().data(), rates.data());
    return rates;
}

Json as_json(const PhasedMotion& motion, const Contacts& contacts, const Derived& d, const LoadedMode& mode, const Account& account,
             const std::vector<std::string>& moved) {
    const auto end = motion.final_state();
    const bool balance = !account.conserved;
    const std::vector<double> rates = final_rates(motion, mode);
    Json result;
    if (const std::string warning = distrust(account); !warning.empty()) result["warning"] = warning;
    result["final"] = {{"time", motion.final_time()},
                       {"coordinates", by_coordinate(mode.program, end.data())},
                       {"rates", by_coordinate(mode.program, rates.data())}};
    for (std::size_t k = 0; k < mode.program.speeds.size() && !d.mechanism.speeds.empty(); ++k)
        result["final"]["speeds"][mode.program.speeds[k].name] = end[d.mechanism.q.size() + k];
    result["method"] = motion.statistics.method;
    if (!account.why_method.empty()) result["method_why"] = account.why_method;
    if (const auto& s = motion.statistics.switched)
        result["switched"] = {{"time", s->time}, {"method", s->method}, {"largest_eigenvalue", s->largest_eigenvalue}, {"step", s->step}};
    if (mode.jacobian_operations) result["jacobian_operations"] = *mode.jacobian_operations;
    result["formulation"] = mode.source.formulation;
    result["steps"] = motion.statistics.steps;
    result["rejected"] = motion.statistics.rejected;
    result["evaluations"] = motion.statistics.evaluations;
    result["energy_drift"] = balance ? Json(nullptr) : Json(account.drift.energy());
    if (balance) result["work_balance"] = account.drift.balance();
    if (account.jacobi_conserved) result["jacobi_drift"] = account.drift.jacobi();
    result["constraint_drift"] = account.constraint_drift;
    if (account.estimate) result["error_estimate"] = as_json(*account.estimate, account.reasons);
    if (!moved.empty()) result["adjusted"] = moved;
    result["events"] = Json::array();
    for (const EventRecord& event : motion.events) result["events"].push_back(event_as_json(event, d.mechanism));
    if (d.mechanism.has_kicks()) result["impulse_work"] = account.impulse_work;
    if (!contacts.names.empty()) {
        result["contacts"] = contacts_as_json(motion.contacts, contacts.names);
        result["impact_loss"] = account.impact_loss;
    }
    result["seconds"] = {{"derive", account.seconds.derive},
                         {"emit", account.seconds.emit},
                         {"compile", account.seconds.compile},
                         {"integrate", account.integrate_seconds},
                         {"estimate", account.estimate_seconds}};
    result["completed"] = motion.ending != Ending::failed;
    return result;
}

void print(const PhasedMotion& motion, const Contacts& contacts, const Derived& d, const LoadedMode& mode, const Account& account,
           const std::vector<std::string>& moved) {
    const auto end = motion.final_state();
    const int n = d.mechanism.size();
    const std::vector<double> rates = final_rates(motion, mode);
    if (const std::string warning = distrust(account); !warning.empty()) fmt::print("{}\n", warning);
    fmt::print("{} with {}: {} steps, {} rejected, {} evaluations of {} operations\n", mode.source.formulation,
               motion.statistics.method, motion.statistics.steps, motion.statistics.rejected, motion.statistics.evaluations,
               mode.source.operations.total());
    if (!account.why_method.empty()) fmt::print("{}: {}\n", motion.statistics.method, account.why_method);
    if (motion.statistics.switched) fmt::print("{}\n", described(*motion.statistics.switched));
    if (mode.jacobian_operations) fmt::print("the Jacobian is emitted: {} operations\n", *mode.jacobian_operations);
    fmt::print("{}", events_as_text(motion.events, d.mechanism));
    fmt::print("{}", contacts_as_text(motion.contacts, contacts.names));
    fmt::print("\nat t = {:.15g}\n", motion.final_time());
    for (int i = 0; i < n; ++i)
        fmt::print("{:<16}{:>24.16g}   rate {:>24.16g}\n", mode.program.coordinates[i].name, end[i], rates[i]);
    for (std::size_t k = 0; k < mode.program.speeds.size() && !d.mechanism.speeds.empty(); ++k)
        fmt::print("{:<16}{:>24.16g}\n", mode.program.speeds[k].name, end[n + static_cast<int>(k)]);
    if (!contacts.names.empty()) {
        std::string closed;
        for (const int k : motion.phases.back().closed) closed += (closed.empty() ? "" : ", ") + contacts.names[k];
        fmt::print("closed: {}\n", closed.empty() ? "no contact" : closed);
    }
    if (account.estimate && account.estimate->value) {
        fmt::print("\nestimated error {:.1e} ({:.1e} of the motion's size), by {}\n", *account.estimate->value, *account.estimate->scaled, account.estimate->by);
        if (account.estimate->lyapunov)
            fmt::print("chaotic: Lyapunov exponent {:.3g}; no digit is left after about t = {:.4g}\n", *account.estimate->lyapunov, *account.estimate->horizon);
    }
    if (account.impact_loss != 0) fmt::print("\nlost in impacts {:.10g}", account.impact_loss);
    if (d.mechanism.has_kicks()) fmt::print("\ngained by impulses {:.10g}", account.impulse_work);
    if (account.conserved)
        fmt::print("\nenergy drift {:.2e}\n", account.drift.energy());
    else
        fmt::print("\nenergy is not conserved; work balance {:.2e}\n", account.drift.balance());
    if (account.jacobi_conserved) fmt::print("T2 - T0 + V is; its drift {:.2e}\n", account.drift.jacobi());
    if (!d.mechanism.constraints.empty() || !contacts.names.empty()) fmt::print("constraint drift {:.2e}\n", account.constraint_drift);
    for (const std::string& line : moved) fmt::print("adjusted at the start: {}\n", line);
    fmt::print("seconds: derive {:.4f}, emit {:.4f}, compile {:.4f}{}, integrate {:.4f}\n", account.seconds.derive,
               account.seconds.emit, account.seconds.compile, mode.from_cache ? " (cached)" : "", account.integrate_seconds);
}

}  // namespace

int simulate(const Request& request) {
    const Derived d = derived(request, Use::run);
    if (!d.mechanism.impulses.empty())
        std::cerr << fmt::format("{}: the motion starts with the rates before the scene's impulses; 'alembert impact' gives those after\n",
                                 request.scene);
    const double begin = process_seconds();
    const bool has_contacts = !d.mechanism.unilateral.empty();
    // With contacts: of all that their modes can do.
    const Energy energy = energy_of(has_contacts ? with_all_closed(d.mechanism) : d.mechanism);
    Program program = lowered(d, request).program;
    Start start = start_of(d.mechanism);
    const std::vector<std::string> moved = assemble(start, d.mechanism, lower_constraints(d.mechanism), {});
    const State<double> first = state_of(start, d.mechanism, d.equations);
    const MethodChoice choice = method_for(request, d, program, start);
    Options options = options_of(request, choice, start);
    std::optional<ContactView> view;
    std::optional<KickView> kicks;
    Contacts contacts;
    if (has_jumps(d.mechanism)) {
        view.emplace(d.mechanism);
        kicks.emplace(d.mechanism);
        contacts = contacts_of(d, start, *view, *kicks);
        if (has_contacts) check_gaps(d.scene, d.mechanism, *view, start.state(), std::max(options.tolerance, 1e-9));
    }
    const bool work = !energy.conserved;
    const int n = d.mechanism.size();
    Account account{.drift = Drift(n, static_cast<int>(first.qdot.size()), work), .seconds = {.derive = d.seconds, .emit = process_seconds() - begin, .compile = 0}, .why_method = choice.why};
    Progress progress("integrating");
    Modes modes(request, d, start, first, work ? Work::integrated : Work::left_out, choice,
                [&](LoadedMode& mode, double t, std::span<const double> state, std::span<const double> rate) {
                    if (account.closed) return;
                    account.drift(mode.module.table(), mode.par, t, state, rate);
                    if (request.estimate) account.poses(t, state, start.q.size(), first.qdot.size());
                    if (mode.contact.project)
                        account.constraint_drift =
                            std::max(account.constraint_drift, mode.projection.residual(t, state.data()));
                    progress.at((t - options.start) / options.duration);
                });
    modes.take_free(std::move(program));
    const LoadedMode& free = modes({});
    options.quick_times = quick_times(free.program, start.parameters, options.start, options.start + options.duration);
    contacts.on_jump = [&](double t, const double* before, const double* after, double jump) {
        if (account.closed) return;
        const std::vector<double> a = as_integrated(contacts.kicks, t, {before, before + 2 * n}), b = as_integrated(contacts.kicks, t, {after, after + 2 * n});
        account.drift.jump(free.module.table(), free.par, t, a.data(), b.data(), jump);
    };

    std::vector<double> initial = start.q;
    initial.insert(initial.end(), first.qdot.begin(), first.qdot.end());
    if (work) initial.push_back(0);
    const Modes::Seconds before = modes.seconds();
    const double integrate_begin = process_seconds();
    const auto run = [&](const Options& with, const std::vector<double>& from) {
        modes.forget();
        return follow(contacts, [&](const std::vector<int>& closed) -> const ContactMode& { return modes(closed).contact; }, from, with);
    };
    const PhasedMotion motion = run(options, initial);
    const Modes::Seconds& spent = modes.seconds();
    account.integrate_seconds = process_seconds() - integrate_begin - (spent.derive + spent.emit + spent.compile) +
                                (before.derive + before.emit + before.compile);
    account.seconds.derive += spent.derive;
    account.seconds.emit += spent.emit;
    account.seconds.compile += spent.compile;
    account.conserved = energy.conserved && !is_lossy(motion, contacts);
    account.jacobi_conserved = !energy.conserved && energy.jacobi_conserved && !has_contacts;
    for (const ContactEvent& event : motion.contacts) account.impact_loss += event.energy_loss;
    for (const EventRecord& event : motion.events) account.impulse_work += event.energy_gain;
    account.closed = true;
    if (request.estimate && !motion.failure && options.duration > 0) {
        const double again = process_seconds();
        const std::size_t coordinates = start.q.size(), speeds = first.qdot.size();
        account.estimate = error_estimate(motion, run, options, initial, components_of(free.program, coordinates, speeds));
        const bool fixed = has_fixed_step(options.method) && choice.foreign.empty();
        const double size = size_of(motion, coordinates + speeds);
        account.reasons = doubts({.error = *account.estimate,
                                  .energy = account.conserved ? std::optional(account.drift.energy_of_motion()) : std::nullopt,
                                  .balance = account.conserved ? std::nullopt : std::optional(account.drift.balance_of_motion()),
                                  .jacobi = account.jacobi_conserved ? std::optional(account.drift.jacobi_of_motion()) : std::nullopt,
                                  .constraints = account.constraint_drift > 0 ? account.constraint_drift / size : 0,
                                  .singular = most_singular(motion, free, account.poses),
                                  .precision = fixed ? account.estimate->value.value_or(0) : options.tolerance,
                                  .fixed_step = fixed ? options.step : 0,
                                  .inputs = options.quick_times});
        account.estimate_seconds = process_seconds() - again;
    }

    std::optional<JointReactions> reactions;
    if (request.reactions && !request.output.empty() && !d.mechanism.joints.empty()) reactions = joint_reactions(d.scene, d.mechanism);
    if (!request.output.empty()) write_file(request.output, csv(motion, d, modes, reactions ? &*reactions : nullptr, first));
    if (request.json)
        std::cout << as_json(motion, contacts, d, free, account, moved).dump(2) << "\n";
    else
        print(motion, contacts, d, free, account, moved);
    if (!request.json && !request.output.empty()) fmt::print("wrote {}\n", request.output);
    if (motion.failure) {
        const auto reason = motion.failure->kind == FailureKind::no_contact_mode || motion.failure->kind == FailureKind::endless_kicks
                                ? std::nullopt
                                : failure_at(modes(motion.phases.back().closed).derived, state_at(first, *motion.failure));
        throw IntegrationError(motion.failure->message + (reason ? "\n  there: " + *reason : ""), motion.failure->time,
                               motion.failure->state);
    }
    return 0;
}

}  // namespace alembert
