// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/dense_output.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "alembert/base/tolerances.hpp"
#include "analysis/state/assemble.hpp"
#include "base/language/say.hpp"
#include "simulate/loaded_modes.hpp"

namespace alembert {

struct DenseOutput::Parts {
    RunOptions wishes;
    Start start;
    State<double> first;
    MethodChoice choice;
    Options options;
    std::size_t width = 0;  ///< of a state without the work
    std::unique_ptr<CompiledModes> compiled = {};
    std::unique_ptr<LoadedModes> modes = {};
};

namespace {

/// Steps of a fixed length do not end at every time, so a method that chooses its steps takes their place.
void choose_steps(Options& options) {
    if (!has_fixed_step(options.method)) return;
    options.method = Method::dop853;
    options.when_stiff = Method::radau;
    options.tolerance = 1e-12;
    options.step = 0;
}

/// The same system, in which sliding velocities (and other functions) that are zero at the start but for rounding
/// are zero: what sticks at a row goes on sticking.
FilippovSystem zero_at_start(FilippovSystem system, double start, std::vector<double> sizes) {
    system.values = [values = system.values, sizes = std::move(sizes), start](
                        double t, const double* y, const double* sigma, const double* rate, double* out) {
        values(t, y, sigma, rate, out);
        if (t != start) return;
        for (std::size_t k = 0; k < sizes.size(); ++k)
            if (std::abs(out[k]) <= 64 * tolerance::epsilon * sizes[k]) out[k] = 0;
    };
    return system;
}

bool is_before(double t, const Phase& phase) {
    return t < phase.motion.times.front();
}

}  // namespace

DenseOutput::DenseOutput(const Run& run, const RunOptions& wishes) : run_(run), parts_(std::make_unique<Parts>()) {
    Parts& p = *parts_;
    p.wishes = wishes;
    p.wishes.progress = {};
    Program program = lowered(run).program;
    p.start = start_of(run.mechanism);
    assemble(p.start, run.mechanism, lower_constraints(run.mechanism), {});
    p.first = state_of(p.start, run.mechanism, run.equations);
    p.width = p.first.q.size() + p.first.qdot.size();
    p.choice = method_for(p.wishes, run, program, p.start);
    p.options = options_of(p.wishes, p.choice, p.start);
    choose_steps(p.options);
    const bool has_work = static_cast<std::size_t>(run.motion.phases.front().motion.dimension) > p.width;
    p.compiled =
        std::make_unique<CompiledModes>(p.wishes, run, has_work ? Work::integrated : Work::left_out, p.choice);
    p.compiled->take_free(std::move(program));
    p.modes = std::make_unique<LoadedModes>(*p.compiled, p.start, p.first, LoadedModes::OnModeStep());
    for (const Phase& phase : run.motion.phases) (*p.modes)(phase.closed).measure_sides(phase.motion);
}

DenseOutput::~DenseOutput() = default;

int DenseOutput::dimension() const {
    return static_cast<int>(parts_->width);
}
double DenseOutput::first_time() const {
    return run_.motion.phases.front().motion.times.front();
}
double DenseOutput::last_time() const {
    return run_.motion.final_time();
}

void DenseOutput::state_at(double t, std::span<double> state) const {
    if (!(t >= first_time() && t <= last_time()))
        throw std::invalid_argument(
            say("the motion lasts from {} s to {} s; there is no state at {} s", first_time(), last_time(), t));
    const std::vector<Phase>& phases = run_.motion.phases;
    const Phase& phase = *(std::upper_bound(phases.begin(), phases.end(), t, is_before) - 1);
    const std::vector<double>& times = phase.motion.times;
    const auto row = static_cast<std::size_t>(std::upper_bound(times.begin(), times.end(), t) - times.begin()) - 1;
    const std::span<const double> from = phase.motion.state(row);
    if (t - times[row] <= 16 * tolerance::epsilon * std::abs(t)) {  // too near for a step
        std::copy_n(from.begin(), parts_->width, state.begin());
        return;
    }
    LoadedMode& mode = (*parts_->modes)(phase.closed);
    Options options = parts_->options;
    options.start = times[row];
    options.duration = t - times[row];
    options.sample = options.duration;
    options.on_step = {};
    const System& whole = mode.contact.system;
    const System system{.rhs = whole.rhs,
                        .with_jacobian = whole.with_jacobian,
                        .project = whole.project,
                        .quick_times = whole.quick_times,
                        .quick_places = whole.quick_places};
    const std::vector<double> initial(from.begin(), from.end());
    const Trajectory piece = mode.contact.switching
                                 ? integrate(zero_at_start(*mode.contact.switching, times[row], mode.side_sizes),
                                             system, initial, options, {})
                                 : integrate(system, initial, options);
    if (piece.failure) throw_failure(*piece.failure);
    std::copy_n(piece.final_state().begin(), parts_->width, state.begin());
}

}  // namespace alembert
