// SPDX-License-Identifier: GPL-2.0-or-later
#include "run/loaded_modes.hpp"

#include <fmt/format.h>

#include "alembert/canonical.hpp"
#include "alembert/compile.hpp"
#include "alembert/process_time.hpp"
#include "contact/contacts.hpp"
#include "emit/taylor.hpp"
#include "language/say.hpp"
#include "model/friction.hpp"
#include "program/differentiate.hpp"
#include "run/canonical.hpp"
#include "run/first_accelerations.hpp"
#include "run/held_state.hpp"
#include "run/sides.hpp"
#include "run/sundials_methods.hpp"

namespace alembert {

namespace {

// Of a Jacobian that compiles in a second or two; for larger ones, differences are used.
constexpr int most_operations = 8000;

std::optional<Differentiated> affordable_derivatives(const Program& program, Work work) {
    if (program.count(program.right_hand_side()).total() > most_operations / 2) return std::nullopt;
    auto result = differentiated(program, {.power = work == Work::integrated, .budget = 100000});
    if (result && result->operations.total() > most_operations) return std::nullopt;
    return result;
}

/// The reason why a motion cannot go on with this friction, with the numbers that show it.
std::string refusal_of(const Mechanism::Friction& f, const Program& p, double t, const double* y) {
    std::string numbers;
    const auto list = [&](const std::vector<Quantity>& of, const auto& value) {
        for (std::size_t k = 0; k < of.size(); ++k)
            numbers += fmt::format("{}{} = {:.6g}", numbers.empty() ? "" : ", ", of[k].name, value(k));
    };
    list(p.coordinates, [&](std::size_t k) { return y[k]; });
    list(p.parameters, [&](std::size_t k) { return p.parameters[k].value; });
    if (!f.multiplier)
        return say(
            "the normal force of friction '{}' becomes negative at t = {:.15g}; give one that is never negative, "
            "such as max(0, …), or abs(…) where it acts on both sides (there {})",
            f.name, t, numbers);
    return say(
        "at t = {:.15g} no mode of friction '{}' is consistent, or more than one is: the determinant of the "
        "equation for {} is not positive there, so that friction makes the reaction grow faster than the "
        "reaction resists (Painlevé); a smaller coefficient has a motion there ({})",
        t, f.name, f.multiplier->get_name(), numbers);
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
    for (const Mechanism::EventAction& event : m.event_actions)
        contacts.kicks.events.push_back(!event.impulse.empty());
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

LoadedModes::LoadedModes(const RunOptions& options, const Derived& derived, const Start& start,
                         const State<double>& first, Work work, const MethodChoice& method, OnModeStep on_step)
    : wishes_(options),
      derived_(derived),
      start_(start),
      first_(first),
      work_(work),
      method_(method),
      on_step_(std::move(on_step)) {}

void LoadedModes::take_free(Program program) {
    free_ = std::move(program);
}

int LoadedModes::operations() const {
    int most = 0;
    for (const auto& [closed, mode] : loaded_) most = std::max(most, mode->source.operations.total());
    return most;
}

void LoadedModes::forget() {
    for (auto& entry : loaded_) entry.second->projection.forget();
}

LoadedMode& LoadedModes::operator()(const std::vector<int>& closed) {
    std::unique_ptr<LoadedMode>& mode = loaded_[closed];
    if (!mode) mode = made(closed);
    return *mode;
}

Rhs LoadedModes::with_jacobian(LoadedMode& mode) {
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
            mode.when_stiff->effort = mode.contact.rhs.effort;
            if (!mode.derived.mechanism.constraints.empty())
                mode.when_stiff = mode.projection.guarded(*std::move(mode.when_stiff));
            mode.jacobian_operations = derivatives->operations.total();
            seconds_.compile += process_seconds() - clock;
        }
    }
    return *mode.when_stiff;
}

CompileOptions LoadedModes::options_of_compiler() const {
    return {.compiler = {}, .extra_flags = {}, .fast_math = wishes_.fast_math, .cache = {}};
}

void LoadedMode::hold(const std::vector<double>& sigma) {
    const auto first = par.begin() + module.table().parameters - static_cast<std::ptrdiff_t>(sigma.size());
    if (std::equal(sigma.begin(), sigma.end(), first)) return;
    std::copy(sigma.begin(), sigma.end(), first);
    module.table().prepare(par.data());
}

void LoadedMode::hold_sides(double t, const double* state) {
    if (contact.switching) hold(sides_at(*contact.switching, t, state, contact.rhs.dimension, side_sizes));
}

void LoadedMode::measure_sides(const Trajectory& motion) {
    if (!contact.switching) return;
    const std::size_t count = side_sizes.size();
    const std::vector<double> sigma = contact.switching->sigma(contact.switching->start());
    std::vector<double> rate(static_cast<std::size_t>(contact.rhs.dimension)), g(2 * count);
    for (std::size_t row = 0; row < motion.rows(); ++row) {
        contact.switching->values(motion.times[row], motion.state(row).data(), sigma.data(), rate.data(),
                                  g.data());
        for (std::size_t k = 0; k < count; ++k) side_sizes[k] = std::max(side_sizes[k], std::abs(g[k]));
    }
}

void LoadedModes::hold_signs(LoadedMode& mode, const Switched& jumps, std::size_t events,
                             const SeriesModule& series) {
    LoadedMode* const self = &mode;
    Switching system = switching_of(
        mode.module, start_.parameters, jumps, names_of_sides(mode.program, jumps), work_,
        [this, self, series](const std::vector<double>& values) {
            Rhs rhs = make_rhs(self->module, values, work_);
            rhs.extra = self->contact.rhs.extra;
            rhs.effort = self->contact.rhs.effort;
            if (needs_series(method_.method)) rhs.series = make_series(series, values);
            return self->derived.mechanism.constraints.empty() ? rhs : self->projection.guarded(std::move(rhs));
        });
    mode.side_sizes.assign(system.names.size(), 0);
    system.before_step = [self](const std::vector<double>& sigma) { self->hold(sigma); };
    system.on_change = [this, self, frictions = jumps.frictions](const SideChange& change) {
        const auto k = static_cast<std::size_t>(change.index);
        if (on_side_change) on_side_change(change, self->contact.switching->names[k], frictions[k]);
    };
    system.refusal = [self, frictions = jumps.frictions](int k, double t, const double* y) {
        return refusal_of(
            self->derived.mechanism
                .frictions[static_cast<std::size_t>(frictions[static_cast<std::size_t>(k)][0].friction)],
            self->program, t, y);
    };
    mode.contact.events = first_events(std::move(mode.contact.events), events);
    mode.contact.switching = std::make_shared<const Switching>(std::move(system));
    const int dimension = mode.contact.rhs.dimension;
    Rhs& rhs = mode.contact.rhs;
    rhs.context = std::make_shared<LoadedMode* const>(self);
    rhs.call = [](const void* context, double t, const double* state, double* rate) {
        const LoadedMode& own = **static_cast<LoadedMode* const*>(context);
        const std::vector<double> sigma =
            sides_at(*own.contact.switching, t, state, own.contact.rhs.dimension, own.side_sizes);
        own.contact.switching->rates(t, state, sigma.data(), rate);
    };
    rhs.jacobian = nullptr;
    rhs.energies = nullptr;
    rhs.series = {};
    rhs.dimension = dimension;
}

std::unique_ptr<LoadedMode> LoadedModes::made(const std::vector<int>& closed) {
    double clock = process_seconds();
    const auto lap = [&clock] {
        const double before = clock;
        clock = process_seconds();
        return clock - before;
    };
    const bool has_contacts = !derived_.mechanism.unilateral.empty();
    const std::vector<int> planes = frictions_in_planes(derived_.mechanism, closed);
    const bool is_own = !has_contacts && planes.empty();
    Derived derived =
        is_own ? derived_
               : derived_again(derived_,
                               with_directions_held(
                                   with_contacts_watched(with_closed(derived_.mechanism, closed), closed), planes),
                               closed.empty() ? derived_.by : "routh");
    seconds_.derive += lap();
    Program program = free_ && is_own ? *std::move(free_) : lowered(derived).program;
    if (program.singular || loaded_.size() == 1) need_accelerations(derived, program, first_);
    std::optional<Switched> jumps;
    if (method_.sundials.empty() && !needs_canonical(method_.method)) jumps = switched(program);
    const Program& smooth = jumps ? jumps->program : program;
    const std::optional<Differentiated> derivatives =
        uses_jacobian(method_.method) ? affordable_derivatives(smooth, work_) : std::nullopt;
    std::optional<Source> series;
    if (needs_series(method_.method)) series = emit_taylor(smooth, work_ == Work::integrated);
    std::optional<Source> form;
    if (needs_canonical(method_.method)) form = emit(canonical_form(derived));
    Source source = emit(derivatives ? derivatives->program : smooth);
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

    const std::size_t sides = jumps ? jumps->functions.size() : 0;
    const std::size_t watched = jumps && jumps->has_frictions() ? 4 * sides : 2 * sides;
    std::vector<double> values = with_held_parameters(start_.parameters, program);
    if (jumps) values.resize(start_.parameters.size() + static_cast<std::size_t>(jumps->held()), 1.0);
    std::vector<bool> stops;
    std::vector<int> directions;
    for (const Mechanism::EventAction& event : derived.mechanism.event_actions) {
        stops.push_back(event.stop);
        directions.push_back(event.direction);
    }
    const std::size_t events = stops.size();
    stops.resize(events + watched);
    directions.resize(events + watched);
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
    if (method_.when_stiff) mode->contact.rhs.effort = effort_of(mode->program);
    if (derivatives) mode->jacobian_operations = derivatives->operations.total();
    if (series_module) mode->contact.rhs.series = make_series(series_module, values);
    mode->contact.rhs.canonical = canonical;
    if (method_.when_stiff)
        mode->contact.rhs_when_stiff = [this, self = mode.get()] { return with_jacobian(*self); };
    // The work must balance the energy, so it is integrated with the same tolerance as the state, if there is one.
    if (!has_contacts && !has_fixed_step(method_.method)) mode->contact.rhs.extra = 0;
    if (!method_.sundials.empty()) mode->contact.by = sundials_integrator(method_.sundials, module, values);
    LoadedMode* const self = mode.get();
    if (jumps) hold_signs(*self, *jumps, events, series_module);
    if (constrained) {
        mode->contact.project = self->projection.after_steps();
        if (!jumps) mode->contact.rhs = self->projection.guarded(std::move(mode->contact.rhs));
    }
    mode->contact.on_step = [this, self](double t, std::span<const double> state, std::span<const double> rate) {
        on_step_(*self, t, state, rate);
    };
    return mode;
}

}  // namespace alembert
