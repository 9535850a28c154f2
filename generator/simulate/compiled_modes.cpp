// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/compiled_modes.hpp"

#include <algorithm>
#include <utility>

#include "alembert/base/process_time.hpp"
#include "analysis/contact/contacts.hpp"
#include "model/formalism/needs.hpp"
#include "model/friction.hpp"
#include "program/differentiate.hpp"
#include "program/in_pieces.hpp"
#include "simulate/canonical.hpp"
#include "simulate/first_accelerations.hpp"
#include "simulate/sides.hpp"

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

/// Processor time of this thread and of compilers that have ended.
double own_seconds() {
    return thread_seconds() + children_seconds();
}

}  // namespace

Program with_jacobian(Program program, Method method, bool with_power) {
    if (program.singular || !uses_jacobian(method)) return program;
    std::optional<Differentiated> found =
        affordable_derivatives(program, with_power ? Work::integrated : Work::left_out);
    return found ? std::move(found->program) : program;
}

CompiledModes::CompiledModes(const RunOptions& wishes, const Derived& derived, Work work,
                             const MethodChoice& method)
    : wishes_(wishes),
      derived_(derived),
      work_(work),
      method_(method),
      may_go_over_(alembert::may_go_over(wishes) && !needs_canonical(method.method)) {}

void CompiledModes::take_free(Program program) {
    free_ = std::move(program);
}

int CompiledModes::operations() const {
    int most = 0;
    for (const auto& [closed, mode] : made_) most = std::max(most, mode->operations.total());
    return most;
}

CompiledMode& CompiledModes::own(const CompiledMode& mode) {
    return *std::find_if(made_.begin(), made_.end(), [&](const auto& entry) {
                return entry.second.get() == &mode;
            })->second;
}

bool CompiledModes::may_go_over(const CompiledMode& mode, Part part) const {
    return may_go_over_ && !is_shared &&
           (part == Part::series ? mode.series.go_over != nullptr : mode.code.go_over != nullptr);
}

void CompiledModes::go_over(const CompiledMode& asked, Part part, const TimedPlace& place) {
    CompiledMode& mode = own(asked);
    const double begin = own_seconds();
    try {
        if (part == Part::series) {
            const auto go_over = std::exchange(mode.series.go_over, {});
            const SeriesModule compiled = compiled_series(mode.run(), work_ == Work::integrated, wishes_);
            if (is_faster(compiled, mode.series.module, place)) go_over(compiled), mode.kind = CodeKind::both;
        } else {
            const auto go_over = std::exchange(mode.code.go_over, {});
            const SolverCode compiled = compiled_code(mode.run(), mode.program.name, wishes_);
            mode.code.from_cache = compiled.from_cache;
            if (is_faster(compiled.module, mode.code.module, place))
                go_over(compiled.module), mode.kind = CodeKind::both;
        }
    } catch (const CompileError&) {
    }
    seconds_.compile += own_seconds() - begin;
}

const CompiledMode& CompiledModes::operator()(const std::vector<int>& closed, const State<double>& first) {
    const std::lock_guard lock(symbols);
    auto mode = made_.find(closed);
    if (mode == made_.end()) mode = made_.emplace(closed, made(closed, first)).first;
    return *mode->second;
}

const Module* CompiledModes::jacobian_of(const CompiledMode& asked) {
    const std::lock_guard lock(symbols);
    CompiledMode& mode = own(asked);
    if (!mode.was_asked_for_jacobian) {
        mode.was_asked_for_jacobian = true;
        double clock = own_seconds();
        if (const auto derivatives = affordable_derivatives(mode.program, work_)) {
            seconds_.emit += own_seconds() - clock;
            clock = own_seconds();
            mode.with_jacobian =
                solver_code(derivatives->program, mode.program.name + "_jacobian", wishes_).module;
            mode.jacobian_operations = derivatives->operations.total();
            seconds_.compile += own_seconds() - clock;
        }
    }
    return mode.with_jacobian ? &*mode.with_jacobian : nullptr;
}

SeriesModule CompiledModes::series_of(const CompiledMode& asked) {
    const std::lock_guard lock(symbols);
    CompiledMode& mode = own(asked);
    if (!std::exchange(mode.was_asked_for_series, true) && !mode.series.module) {
        const double clock = own_seconds();
        if (has_short_series(mode.run(), mode.derived))
            mode.series = series_code(mode.run(), work_ == Work::integrated, wishes_);
        seconds_.compile += own_seconds() - clock;
    }
    return mode.series.module;
}

std::unique_ptr<CompiledMode> CompiledModes::made(const std::vector<int>& closed, const State<double>& first) {
    double clock = own_seconds();
    const auto lap = [&clock] {
        const double before = clock;
        clock = own_seconds();
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
                               closed.empty() ? derived_.by : formalism_for(Need::multipliers).name);
    seconds_.derive += lap();
    std::vector<QuotientSign> signs;  // told already
    Program program = free_ && is_own ? *std::move(free_) : with_quotient_signs(lowered(derived).program, signs);
    if (program.singular) need_accelerations(derived, program, first);
    if (needs_series(method_.method)) program = in_pieces(program);
    std::optional<Switched> jumps;
    // rattle calculates with momenta, in which signs are not held constant.
    if (!needs_canonical(method_.method)) jumps = switched(program, SecondRates::wanted);
    const Program& smooth = jumps ? jumps->program : program;
    std::optional<Differentiated> derivatives =
        uses_jacobian(method_.method) ? affordable_derivatives(smooth, work_) : std::nullopt;
    std::optional<Program> form;
    if (needs_canonical(method_.method)) form = canonical_form(derived);
    seconds_.emit += lap();
    SolverCode code = solver_code(derivatives ? derivatives->program : smooth, program.name, wishes_);
    CodeOfSeries series;
    if (needs_series(method_.method)) series = series_code(smooth, work_ == Work::integrated, wishes_);
    std::optional<Module> canonical;
    if (form) canonical = solver_code(*form, program.name + "_canonical", wishes_).module;
    seconds_.compile += lap();
    const bool is_series_compiled = series.module && !series.go_over;
    const CodeKind kind = !code.go_over        ? CodeKind::compiled
                          : is_series_compiled ? CodeKind::both
                                               : CodeKind::memory;
    std::optional<Program> running;
    if (derivatives)
        running = std::move(derivatives->program);
    else if (jumps)
        running = smooth;
    std::vector<std::string> sides = jumps ? names_of_sides(program, *jumps) : std::vector<std::string>();
    const double effort = effort_of(program);
    std::shared_ptr<const Corners> corners = Corners::of(derived.mechanism);
    auto mode = std::make_unique<CompiledMode>(CompiledMode{
        .derived = std::move(derived),
        .program = std::move(program),
        .jumps = std::move(jumps),
        .sides = std::move(sides),
        .corners = std::move(corners),
        .running = std::move(running),
        .code = std::move(code),
        .kind = kind,
        .series = std::move(series),
        .canonical = canonical,
        .jacobian_operations = derivatives ? std::optional(derivatives->operations.total()) : std::nullopt,
        .effort = effort});
    mode->event_code = event_code(mode->run());
    mode->place_code =  // without signs that are held
        quick_places_code(mode->program, mode->jumps ? Kinks::followed : Kinks::watched);
    mode->operations = mode->run().count(mode->run().right_hand_side());
    return mode;
}

}  // namespace alembert
