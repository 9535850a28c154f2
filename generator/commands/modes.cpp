// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/modes.hpp"

#include <fmt/format.h>

#include "alembert/compile.hpp"
#include "analysis/contacts.hpp"
#include "analysis/diagnose.hpp"
#include "emit/taylor.hpp"

namespace alembert {

Modes::Modes(const Request& request, const Derived& derived, const Start& start, const State<double>& first, Work work,
             OnModeStep on_step)
    : request_(request), derived_(derived), start_(start), first_(first), work_(work), on_step_(std::move(on_step)) {}

void Modes::take_free(Program program) { free_ = std::move(program); }

const LoadedMode& Modes::operator()(const std::vector<int>& closed) {
    std::unique_ptr<LoadedMode>& mode = loaded_[closed];
    if (!mode) mode = made(closed);
    return *mode;
}

std::unique_ptr<LoadedMode> Modes::made(const std::vector<int>& closed) {
    double clock = process_seconds();
    const auto lap = [&clock] {
        const double before = clock;
        clock = process_seconds();
        return clock - before;
    };
    const bool has_contacts = !derived_.mechanism.unilateral.empty();
    Derived derived = has_contacts ? derived_again(derived_, with_contacts_watched(with_closed(derived_.mechanism, closed), closed),
                                                   closed.empty() ? request_.by : "routh")
                                   : derived_;
    seconds_.derive += lap();
    Program program = free_ && !has_contacts ? *std::move(free_) : lowered(derived, request_).program;
    if (program.singular || (loaded_.size() == 1 && massless_combination(program, first_)))
        throw IntegrationError(fmt::format("there are no finite accelerations at t = {:.6g}: {}", start_.t,
                                           failure_at(derived, first_).value_or("the mass matrix is singular")),
                               start_.t, start_.q);
    const bool wants_series = request_.method.empty() ? derived.mechanism.run.method == "taylor" : request_.method == "taylor";
    std::optional<Source> series;
    if (wants_series) series = emit_taylor(program, work_ == Work::integrated);
    Source source = emit(program);
    seconds_.emit += lap();
    const Compiled compiled =
        compile(source.text, program.name, {.compiler = {}, .extra_flags = {}, .fast_math = request_.fast_math, .cache = {}});
    const Module module = load(compiled.object);
    SeriesModule series_module;
    if (series) series_module = load_series(compile(series->text, program.name + "_taylor", {.fast_math = request_.fast_math}).object);
    seconds_.compile += lap();

    const std::vector<double>& values = start_.parameters;
    const std::vector<bool> stops = derived.mechanism.event_stops;
    const bool constrained = !derived.mechanism.constraints.empty();
    auto mode = std::make_unique<LoadedMode>(LoadedMode{.derived = std::move(derived),
                                                        .program = std::move(program),
                                                        .source = std::move(source),
                                                        .module = module,
                                                        .par = prepared(module, values),
                                                        .projection = Projection(module, values),
                                                        .contact = {.rhs = make_rhs(module, values, work_),
                                                                    .events = make_events(module, values, stops)},
                                                        .from_cache = compiled.from_cache});
    if (series_module) mode->contact.rhs.series = make_series(series_module, values);
    LoadedMode* const self = mode.get();
    if (constrained) mode->contact.project = std::ref(self->projection);
    mode->contact.on_step = [this, self](double t, std::span<const double> state, std::span<const double> rate) {
        on_step_(*self, t, state, rate);
    };
    return mode;
}

}  // namespace alembert
