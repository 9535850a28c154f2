// SPDX-License-Identifier: GPL-2.0-or-later
#include "run/modes.hpp"

#include <fmt/format.h>

#include "alembert/canonical.hpp"
#include "alembert/compile.hpp"
#include "alembert/process_time.hpp"
#include "contact/contacts.hpp"
#include "emit/taylor.hpp"
#include "program/differentiate.hpp"
#include "run/canonical.hpp"
#include "run/foreign.hpp"
#include "state/diagnose.hpp"

namespace alembert {

namespace {

constexpr int most_operations = 8000;  // of a Jacobian that compiles in a second or two; beyond, differences serve

std::optional<Differentiated> affordable_derivatives(const Program& program, Work work) {
    if (program.count(program.right_hand_side()).total() > most_operations / 2) return std::nullopt;
    auto result = differentiated(program, {.power = work == Work::integrated, .budget = 100000});
    if (result && result->operations.total() > most_operations) return std::nullopt;
    return result;
}

}  // namespace

bool has_jumps(const Mechanism& m) {
    return !m.unilateral.empty() || m.has_kicks();
}

Contacts contacts_of(const Derived& d, const Start& start, const ContactView& view, const KickView& kicks) {
    const Mechanism& m = d.mechanism;
    if (!m.unilateral.empty() || m.speeds.empty()) need_rates(d);
    const auto at = [state = start.state()](double t, const double* y) {
        State<double> result = state;
        result.t = t;
        std::copy_n(y, state.q.size(), result.q.begin());
        std::copy_n(y + state.q.size(), state.qdot.size(), result.qdot.begin());
        return result;
    };
    Contacts contacts{.names = view.names(),
                      .restitution = restitutions(m, start.parameters),
                      .situation = [&view, at](double t, const double* y) { return view.at(at(t, y)); },
                      .on_jump = {}};
    for (const Mechanism::Occasion& event : m.occasions) contacts.kicks.events.push_back(!event.impulse.empty());
    contacts.kicks.coordinates = m.size();
    contacts.kicks.impulse = [&kicks, at](int event, double t, const double* y) {
        return kicks.impulse(event, at(t, y));
    };
    contacts.kicks.passed = [&kicks, at](double t, const double* before, const double* after,
                                         const Eigen::VectorXd& acceleration) {
        State<double> a = at(t, before), b = at(t, after);
        a.qddot.assign(acceleration.begin(), acceleration.end());
        b.qddot = a.qddot;
        return kicks.passed(a, b);
    };
    if (!d.equations.speeds_are_rates())
        contacts.kicks.speeds = [&kicks, at](double t, const double* y) { return kicks.speeds(at(t, y)); };
    return contacts;
}

Program with_jacobian(Program program, Method method, bool with_power) {
    if (program.singular || !uses_jacobian(method)) return program;
    std::optional<Differentiated> found =
        affordable_derivatives(program, with_power ? Work::integrated : Work::left_out);
    return found ? std::move(found->program) : program;
}

Modes::Modes(const RunOptions& options, const Derived& derived, const Start& start, const State<double>& first,
             Work work, const MethodChoice& method, OnModeStep on_step)
    : wishes_(options),
      derived_(derived),
      start_(start),
      first_(first),
      work_(work),
      method_(method),
      on_step_(std::move(on_step)) {}

void Modes::take_free(Program program) {
    free_ = std::move(program);
}

int Modes::operations() const {
    int most = 0;
    for (const auto& [closed, mode] : loaded_) most = std::max(most, mode->source.operations.total());
    return most;
}

void Modes::forget() {
    for (auto& entry : loaded_) entry.second->projection.forget();
}

const LoadedMode& Modes::operator()(const std::vector<int>& closed) {
    std::unique_ptr<LoadedMode>& mode = loaded_[closed];
    if (!mode) mode = made(closed);
    return *mode;
}

Rhs Modes::with_jacobian(LoadedMode& mode) {
    if (!mode.when_stiff) {
        mode.when_stiff = mode.contact.rhs;
        double clock = process_seconds();
        if (const auto derivatives = affordable_derivatives(mode.program, work_)) {
            const Source source = emit(derivatives->program);
            seconds_.emit += process_seconds() - clock;
            clock = process_seconds();
            const Compiled compiled = compile(source.text, mode.program.name + "_jacobian", options_of_compiler());
            mode.when_stiff = make_rhs(load(compiled.object), start_.parameters, work_);
            mode.when_stiff->extra = mode.contact.rhs.extra;
            if (!mode.derived.mechanism.constraints.empty())
                mode.when_stiff = mode.projection.guarded(*std::move(mode.when_stiff));
            mode.jacobian_operations = derivatives->operations.total();
            seconds_.compile += process_seconds() - clock;
        }
    }
    return *mode.when_stiff;
}

CompileOptions Modes::options_of_compiler() const {
    return {.compiler = {}, .extra_flags = {}, .fast_math = wishes_.fast_math, .cache = {}};
}

std::unique_ptr<LoadedMode> Modes::made(const std::vector<int>& closed) {
    double clock = process_seconds();
    const auto lap = [&clock] {
        const double before = clock;
        clock = process_seconds();
        return clock - before;
    };
    const bool has_contacts = !derived_.mechanism.unilateral.empty();
    Derived derived =
        has_contacts
            ? derived_again(derived_, with_contacts_watched(with_closed(derived_.mechanism, closed), closed),
                            closed.empty() ? derived_.by : "routh")
            : derived_;
    seconds_.derive += lap();
    Program program = free_ && !has_contacts ? *std::move(free_) : lowered(derived).program;
    if (program.singular || (loaded_.size() == 1 && massless_combination(program, first_)))
        throw IntegrationError(fmt::format("there are no finite accelerations at t = {:.6g}: {}", start_.t,
                                           failure_at(derived, first_).value_or("the mass matrix is singular")),
                               start_.t, start_.q);
    const std::optional<Differentiated> derivatives =
        uses_jacobian(method_.method) ? affordable_derivatives(program, work_) : std::nullopt;
    std::optional<Source> series;
    if (needs_series(method_.method)) series = emit_taylor(program, work_ == Work::integrated);
    std::optional<Source> form;
    if (needs_canonical(method_.method)) form = emit(canonical_form(derived));
    Source source = emit(derivatives ? derivatives->program : program);
    seconds_.emit += lap();
    const Compiled compiled = compile(source.text, program.name, options_of_compiler());
    const Module module = load(compiled.object);
    SeriesModule series_module;
    if (series)
        series_module = load_series(compile(series->text, program.name + "_taylor", options_of_compiler()).object);
    std::shared_ptr<const Canonical> canonical;
    if (form)
        canonical = make_canonical(
            module, load(compile(form->text, program.name + "_canonical", options_of_compiler()).object),
            start_.parameters);
    seconds_.compile += lap();

    const std::vector<double>& values = start_.parameters;
    std::vector<bool> stops;
    std::vector<int> directions;
    for (const Mechanism::Occasion& event : derived.mechanism.occasions) {
        stops.push_back(event.stop);
        directions.push_back(event.direction);
    }
    const bool constrained = !derived.mechanism.constraints.empty();
    auto mode = std::make_unique<LoadedMode>(
        LoadedMode{.derived = std::move(derived),
                   .program = std::move(program),
                   .source = std::move(source),
                   .module = module,
                   .par = prepared(module, values),
                   .projection = Projection(module, values),
                   .contact = {.rhs = make_rhs(module, values, work_),
                               .events = make_events(module, values, stops, directions)},
                   .from_cache = compiled.from_cache});
    if (derivatives) mode->jacobian_operations = derivatives->operations.total();
    if (series_module) mode->contact.rhs.series = make_series(series_module, values);
    mode->contact.rhs.canonical = canonical;
    if (method_.when_stiff)
        mode->contact.rhs_when_stiff = [this, self = mode.get()] { return with_jacobian(*self); };
    // The work is to balance the energy: it has a tolerance like the rest, where there is one.
    if (!has_contacts && !has_fixed_step(method_.method)) mode->contact.rhs.extra = 0;
    if (!method_.foreign.empty()) mode->contact.by = foreign_integrator(method_.foreign, module, values);
    LoadedMode* const self = mode.get();
    if (constrained) {
        mode->contact.project = self->projection.after_steps();
        mode->contact.rhs = self->projection.guarded(std::move(mode->contact.rhs));
    }
    mode->contact.on_step = [this, self](double t, std::span<const double> state, std::span<const double> rate) {
        on_step_(*self, t, state, rate);
    };
    return mode;
}

}  // namespace alembert
