// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/loaded_modes.hpp"

#include <fmt/format.h>

#include "alembert/base/error.hpp"
#include "alembert/ode/cost_model.hpp"
#include "alembert/ode/hamiltonian_system.hpp"
#include "alembert/ode/taylor.hpp"
#include "base/language/say.hpp"
#include "model/event_actions.hpp"
#include "simulate/consistent_mode.hpp"
#include "simulate/first_accelerations.hpp"
#include "simulate/friction_of_multipliers.hpp"
#include "simulate/sides.hpp"
#include "simulate/sundials_methods.hpp"

namespace alembert {

namespace {

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

/// The events of the scene whose values hold multipliers.
std::vector<int> own_events_of_forces(const Mechanism& m) {
    const std::vector<bool> of_forces = events_of_forces(m);
    std::vector<int> result;
    const std::size_t own = m.events.size() - m.unilateral.size();  // then come contacts, which end a phase
    for (std::size_t k = 0; k < own; ++k)
        if (of_forces[k]) result.push_back(static_cast<int>(k));
    return result;
}

}  // namespace

LoadedModes::LoadedModes(CompiledModes& compiled, const Start& start, const State<double>& first,
                         OnModeStep on_step)
    : compiled_(compiled), start_(start), first_(first), on_step_(std::move(on_step)) {}

void LoadedModes::begin() {
    for (auto& entry : loaded_) begin_in(*entry.second);
}

void LoadedModes::begin_in(LoadedMode& mode) const {
    mode.last.reset();
    std::vector<double> first = first_.q;
    first.insert(first.end(), first_.qdot.begin(), first_.qdot.end());
    const alembert_solver_table& table = mode.module.table();
    const bool has_other_speeds = static_cast<int>(first.size()) != table.coordinates + table.speeds;
    mode.sides_are_known = false;
    if (has_other_speeds) return;
    if (mode.has_signs_in_rows) mode.hold_sides(first_.t, first.data());
    mode.projection.begin(first_.t, first.data());
}

LoadedMode& LoadedModes::operator()(const std::vector<int>& closed) {
    auto mode = loaded_.find(closed);
    if (mode == loaded_.end()) mode = loaded_.emplace(closed, bound(closed)).first;
    mode->second->sides_are_known = false;
    mode->second->last.reset();
    return *mode->second;
}

void LoadedModes::shorten_steps(const std::vector<InputTimeScale>& quick_times) {
    quick_times_ = quick_times;
    for (auto& entry : loaded_) entry.second->contact.system.quick_times = quick_times;
}

Rhs LoadedModes::with_jacobian(LoadedMode& mode) {
    if (!mode.when_stiff) {
        mode.when_stiff = mode.contact.system.rhs;
        if (const Module* const module = compiled_.jacobian_of(mode.compiled)) {
            mode.when_stiff = make_rhs(*module, start_.parameters, compiled_.work());
            mode.when_stiff->extra = mode.contact.system.rhs.extra;
            mode.when_stiff->effort = mode.contact.system.rhs.effort;
            mode.when_stiff->slowness = mode.contact.system.rhs.slowness;
            if (!mode.derived.mechanism.constraints.empty())
                mode.when_stiff = mode.projection.guarded(*std::move(mode.when_stiff), start_.parameters);
        }
    }
    return *mode.when_stiff;
}

Rhs LoadedModes::with_series(LoadedMode& mode) {
    Rhs rhs = mode.contact.system.rhs;
    if (const SeriesModule series = compiled_.series_of(mode.compiled))
        rhs.series = make_series(series, with_held_parameters(start_.parameters, mode.program));
    return rhs;
}

/// Goes over to compiled code where that is predicted to pay.
void LoadedModes::count_step(LoadedMode& mode, double t, std::span<const double> state) {
    using Part = CompiledModes::Part;
    const bool by_series = needs_series(mode.running) && mode.compiled.series.module;
    const Part part = by_series ? Part::series : Part::solver;
    if (mode.when_stiff || !compiled_.may_go_over(mode.compiled, part)) return;
    constexpr double evaluations = 16;  // of a usual step, between those of the explicit methods
    constexpr int order = 20;           // of a usual series
    const alembert_series_table* const series = mode.compiled.series.module.get();
    double& effort = by_series ? mode.effort_of_series : mode.effort;
    const Rhs& rhs = mode.contact.system.rhs;
    const double step = by_series ? rhs.slowness.series * taylor_effort(series->order_cost, series->product_cost,
                                                                        order, rhs.dimension)
                                  : evaluations * effort_of_evaluation(rhs, uses_jacobian(mode.running));
    effort += step / rhs.slowness.evaluation;  // compiling takes as many times as long
    if (by_series ? pays_to_compile(*series, effort) : pays_to_compile(mode.compiled.run(), effort)) {
        const std::vector<double> parameters(mode.par.begin(), mode.par.begin() + mode.module.table().parameters);
        compiled_.go_over(mode.compiled, part, {t, state, parameters});
    }
}

/// With the rates of the coordinates and the scene's states, whatever the speeds are.
State<double> LoadedModes::state_of(const LoadedMode& mode, double t, const double* y, const double* rate) const {
    const auto n = static_cast<std::size_t>(mode.module.table().coordinates),
               s = static_cast<std::size_t>(mode.module.table().speeds), z = mode.derived.mechanism.states.size();
    State<double> at{
        .parameters = start_.parameters, .t = t, .q = {y, y + n}, .qdot = {rate, rate + n}, .qddot = {}};
    at.qdot.insert(at.qdot.end(), y + n + s - z, y + n + s);
    return at;
}

/// Where no sign is held constant, steps do not end at corners.
void LoadedModes::look_for_corner(LoadedMode& mode, double t, const double* y, const double* rate) const {
    const std::lock_guard lock(compiled_.symbols);
    State<double> now = state_of(mode, t, y, rate);
    if (mode.last)
        if (const auto why = mode.compiled.corners->obstacle_between(*mode.last, now))
            throw IntegrationError(*why, t, now.q);
    mode.last = std::move(now);
}

void LoadedMode::hold(const std::vector<double>& sigma) {
    const auto first = par.begin() + module.table().parameters - static_cast<std::ptrdiff_t>(sigma.size());
    if (std::equal(sigma.begin(), sigma.end(), first)) return;
    std::copy(sigma.begin(), sigma.end(), first);
    module.table().prepare(par.data());
    if (has_signs_in_rows) projection.hold(par);
}

void LoadedMode::hold_sides(double t, const double* state) {
    if (contact.switching) hold(sides_at(*contact.switching, t, state, contact.system.rhs.dimension, side_sizes));
}

void LoadedMode::rates_on_sides(double t, const double* state, double* rate) {
    const std::vector<double> sigma =
        sides_at(*contact.switching, t, state, contact.system.rhs.dimension, side_sizes);
    hold(sigma);
    sides_are_known = false;
    contact.switching->rates(t, state, sigma.data(), rate);
}

void LoadedMode::measure_sides(const Trajectory& motion) {
    if (!contact.switching) return;
    const std::size_t count = side_sizes.size();
    const std::vector<double> sigma = contact.switching->sigma(contact.switching->start());
    std::vector<double> rate(static_cast<std::size_t>(contact.system.rhs.dimension)),
        g(contact.switching->numbers());
    for (std::size_t row = 0; row < motion.rows(); ++row) {
        contact.switching->values(motion.times[row], motion.state(row).data(), sigma.data(), rate.data(),
                                  g.data());
        for (std::size_t k = 0; k < count; ++k) side_sizes[k] = std::max(side_sizes[k], std::abs(g[k]));
    }
}

std::function<std::optional<std::string>(int, double, const double*, const double*)> LoadedModes::obstacle_of(
    const LoadedMode& mode) const {
    return [this, self = &mode](int, double t, const double* y, const double* rate) {
        const std::lock_guard lock(compiled_.symbols);
        return self->compiled.corners->obstacle(state_of(*self, t, y, rate));
    };
}

void LoadedModes::hold_signs(LoadedMode& mode, std::size_t events) {
    LoadedMode* const self = &mode;
    const Switched& jumps = *mode.compiled.jumps;
    const Work work = compiled_.work();
    const bool with_series = needs_series(compiled_.method().method);
    const FrictionAt friction = friction_of_multipliers(jumps.program, compiled_.symbols);
    const auto correct = [this, self, friction, held = jumps.held()](
                             double t, const double* y, const double* sigma, const double* par, double* rate) {
        if (!self->projection.is_near_singular()) return;
        std::vector<double> values = start_.parameters;
        values.insert(values.end(), sigma, sigma + held);
        self->projection.accelerations(t, y, par, friction(values), rate + self->program.coordinates.size());
    };
    const bool constrained = !mode.derived.mechanism.constraints.empty();
    const auto smooth = [self, work, with_series, constrained, friction](const std::vector<double>& values) {
        Rhs rhs = make_rhs(self->module, values, work);
        rhs.extra = self->contact.system.rhs.extra;
        rhs.effort = self->contact.system.rhs.effort;
        rhs.slowness = self->contact.system.rhs.slowness;
        if (with_series) rhs.series = make_series(self->compiled.series.module, values);
        return constrained ? self->projection.guarded(std::move(rhs), values, friction(values)) : rhs;
    };
    FilippovSystem system = switching_of(
        mode.module, start_.parameters, jumps, mode.compiled.sides,
        {.work = work, .correct = constrained ? Correction(correct) : Correction(), .smooth = smooth});
    mode.side_sizes.assign(system.names.size(), 0);
    system.before_step = [self](const std::vector<double>& sigma) {
        self->hold(sigma);
        self->sides_are_known = true;
    };
    system.on_change = [this, self](const ModeChange& change) {
        const auto k = static_cast<std::size_t>(change.index);
        const CompiledMode& of = self->compiled;
        const bool is_knot = of.program[of.jumps->functions[k]].op == Op::unspecified;
        if (on_side_change) on_side_change({change, of.sides[k], is_knot, of.jumps->frictions[k]});
    };
    system.on_begin = [this, self](const ModeChange& change) {
        if (on_side_begin)
            on_side_begin(change, self->compiled.jumps->frictions[static_cast<std::size_t>(change.index)]);
    };
    if (mode.compiled.corners) system.obstacle = obstacle_of(mode);
    system.events_of_forces = own_events_of_forces(mode.derived.mechanism);
    system.refusal = [self](int k, double t, const double* y) {
        const int friction = self->compiled.jumps->frictions[static_cast<std::size_t>(k)][0].friction;
        return refusal_of(self->derived.mechanism.frictions[static_cast<std::size_t>(friction)], self->program, t,
                          y);
    };
    const std::shared_ptr<const EventCode> code = mode.compiled.event_code;
    if (code) {
        const int first = mode.module.table().events - static_cast<int>(jumps.events());
        system.bounds_of_functions = {
            .exist = [=](int k) { return !code->events[static_cast<std::size_t>(first + k)].empty(); },
            .of =
                [=](int k, const MotionBounds& motion) {
                    return bounds_of(code->events[static_cast<std::size_t>(first + k)], self->par.data(), motion);
                }};
    }
    mode.contact.events = first_events(mode.contact.events, events, self->module, &self->par);
    if (code && events > 0)
        mode.contact.events.bounds = {
            .exist = [=](int k) { return !code->events[static_cast<std::size_t>(k)].empty(); },
            .of =
                [=](int k, const MotionBounds& motion) {
                    return bounds_of(code->events[static_cast<std::size_t>(k)], self->par.data(), motion);
                }};
    mode.contact.switching = std::make_shared<const FilippovSystem>(std::move(system));
    const int dimension = mode.contact.system.rhs.dimension;
    Rhs& rhs = mode.contact.system.rhs;
    rhs.context = std::make_shared<LoadedMode* const>(self);
    rhs.call = [](const void* context, double t, const double* state, double* rate) {
        (*static_cast<LoadedMode* const*>(context))->rates_on_sides(t, state, rate);
    };
    rhs.jacobian = nullptr;
    rhs.energies = nullptr;
    rhs.series = {};
    rhs.dimension = dimension;
}

namespace {

bool holds_signs_in_rows(const Switched& jumps) {
    const Program& p = jumps.program;
    std::vector<int> roots;
    for (const Root& root : p.roots)
        if (root.group == Group::projected || root.group == Group::row || root.group == Group::velocity)
            roots.push_back(root.node);
    const std::vector<int> needed = p.needed(roots);
    const int first = static_cast<int>(p.parameters.size()) - jumps.held();
    return std::any_of(needed.begin(), needed.end(), [&](int id) {
        return p[id].op == Op::variable && p[id].variable.kind == Variable::Kind::parameter &&
               p[id].variable.index >= first;
    });
}

}  // namespace

std::unique_ptr<LoadedMode> LoadedModes::bound(const std::vector<int>& closed) {
    const CompiledMode& made = compiled_(closed, first_);
    if (loaded_.empty()) {
        const std::lock_guard lock(compiled_.symbols);
        need_accelerations(made.derived, made.program, first_, FirstPose::may_be_singular);
    }
    const MethodChoice& method = compiled_.method();
    const Module& module = made.code.module;
    const std::optional<Switched>& jumps = made.jumps;
    const std::size_t watched = jumps ? jumps->events() : 0;
    std::vector<double> values = with_held_parameters(start_.parameters, made.program);
    if (jumps) values.resize(start_.parameters.size() + static_cast<std::size_t>(jumps->held()), 1.0);
    std::vector<bool> stops;
    std::vector<int> directions;
    for (const Mechanism::EventAction& event : made.derived.mechanism.event_actions) {
        stops.push_back(event.stop);
        directions.push_back(event.direction);
    }
    const std::size_t events = stops.size();
    stops.resize(events + watched);
    directions.resize(events + watched);
    const bool constrained = !made.derived.mechanism.constraints.empty();
    auto mode = std::make_unique<LoadedMode>(LoadedMode{
        .compiled = made,
        .derived = made.derived,
        .program = made.program,
        .module = module,
        .par = prepared(module, values),
        .projection = Projection(module, values),
        .contact = {.system = {.rhs = make_rhs(module, values, compiled_.work()), .quick_times = quick_times_},
                    .events = make_events(module, values, stops, directions)}});
    mode->contact.events.bounds = bounds_of(made.event_code, values);
    mode->contact.system.quick_places = {made.place_code, values};
    if (method.when_stiff || method.when_cheaper) {
        mode->contact.system.rhs.effort = made.effort;
        mode->contact.system.rhs.slowness = method.slowness;
    }
    if (made.series.module) mode->contact.system.rhs.series = make_series(made.series.module, values);
    if (made.canonical)
        mode->contact.system.rhs.canonical = make_canonical(module, *made.canonical, start_.parameters);
    if (method.when_stiff)
        mode->contact.system.with_jacobian = [this, self = mode.get()] { return with_jacobian(*self); };
    if ((method.when_cheaper || !method.rivals.empty()) && !jumps) {
        mode->contact.system.with_series = [this, self = mode.get()] { return with_series(*self); };
        mode->contact.system.effort_of_series = method.slowness.evaluation * effort_of_making_series(made.program);
    }
    mode->contact.system.on_method = [self = mode.get()](Method running) { self->running = running; };
    // The work must balance the energy, so it is integrated with the same tolerance as the state, if there is one.
    // Methods for positions and their rates alone know no other components.
    if (made.derived.mechanism.unilateral.empty() && !has_fixed_step(method.method) &&
        !needs_separable(method.method))
        mode->contact.system.rhs.extra = 0;
    if (!method.sundials.empty())
        mode->contact.system.by = sundials_integrator(method.sundials, module, values, jumps.has_value());
    LoadedMode* const self = mode.get();
    if (jumps) hold_signs(*self, events);
    mode->has_signs_in_rows = constrained && jumps && holds_signs_in_rows(*jumps);
    if (constrained) {
        begin_in(*self);
        mode->contact.system.project = self->projection.after_steps();
        if (mode->has_signs_in_rows && mode->contact.system.project)
            mode->contact.system.project = [self](double t, double* state) {
                if (!self->sides_are_known) self->hold_sides(t, state);
                self->projection(t, state);
            };
        if (!jumps)
            mode->contact.system.rhs = self->projection.guarded(std::move(mode->contact.system.rhs), values);
    }
    mode->contact.on_step = [this, self](double t, std::span<const double> state, std::span<const double> rate) {
        count_step(*self, t, state);
        if (self->compiled.corners && !self->contact.switching)
            look_for_corner(*self, t, state.data(), rate.data());
        on_step_(*self, t, state, rate);
    };
    return mode;
}

}  // namespace alembert
