// SPDX-License-Identifier: GPL-2.0-or-later
// The motion is that of `simulate`, and tangent vectors follow it from row to row: so they stay with it where
// neighbouring motions part.
#include <fmt/format.h>

#include <cmath>

#include "alembert/base/error.hpp"
#include "analysis/state/given_values.hpp"
#include "base/language/say.hpp"
#include "program/interpret.hpp"
#include "program/lower/lower.hpp"
#include "simulate/hybrid_variation.hpp"
#include "simulate/simulate.hpp"
#include "stability/stretching.hpp"

namespace alembert {

using Index = Eigen::Index;

namespace {

struct TimedState {
    double t;
    std::vector<double> state;
};

/// The rows of a motion on its grid, without those at which something jumps.
std::vector<TimedState> grid_of(const Run& run, std::size_t size, double interval) {
    constexpr double same = 1e-6;  // of the interval
    std::vector<TimedState> result;
    const double start = run.motion.phases.front().motion.times.front();
    const auto jumps = [&](double t) {
        return std::any_of(run.instants.list.begin(), run.instants.list.end(),
                           [&](const JumpInstant& one) { return std::abs(one.time - t) <= same * interval; });
    };
    for (const Phase& phase : run.motion.phases)
        for (std::size_t k = 0; k < phase.motion.rows(); ++k) {
            const double t = phase.motion.times[k], place = (t - start) / interval;
            const bool is_new = result.empty() || t - result.back().t > interval / 2;
            if (!is_new || std::abs(place - std::round(place)) > same || jumps(t)) continue;
            const auto state = phase.motion.state(k);
            result.push_back({t, {state.begin(), state.begin() + static_cast<std::ptrdiff_t>(size)}});
        }
    return result;
}

double size_of_jacobian(const Program& program, const std::vector<double>& parameters, const Start& start) {
    State<double> state = start.state();
    state.parameters = parameters;
    const std::vector<double> value = interpret(program, state);
    double sum = 0;
    for (const int node : program.nodes_of(Group::jacobian))
        sum += value[static_cast<std::size_t>(node)] * value[static_cast<std::size_t>(node)];
    return std::sqrt(sum);
}

}  // namespace

LyapunovExponents exponents_through_jumps(const Scene& scene, const ExponentOptions& options) {
    const Derived d = derived(scene, {.by = options.by, .use = Use::run});
    LyapunovExponents result{.title = scene.title, .warnings = d.warnings};
    if (!d.mechanism.constraints.empty())
        throw ModelError(
            say("Lyapunov exponents through impacts, events and jumps of forces are computed for scenes "
                "without constraints"));
    const Start start = start_of(d.mechanism);
    HybridVariation variation(d, lowered(d).program, {}, start, {});
    const std::size_t N = 2 * d.mechanism.q.size() + d.mechanism.states.size();
    result.size = static_cast<int>(N);
    if (options.count > result.size)
        throw ModelError(
            say("--exponents {}: the tangent space has {} dimensions; expected at most "
                "that many",
                options.count, result.size));
    const int columns = options.count > 0 ? options.count : result.size,
              intervals = intervals_of(options.duration,
                                       size_of_jacobian(variation.program(), variation.parameters(), start));
    result.duration = options.duration;
    result.interval = options.duration / intervals;
    const Run run = simulate(scene, {.by = options.by,
                                     .duration = options.duration,
                                     .tolerance = options.tolerance,
                                     .sample = result.interval,
                                     .budget = 1'000'000'000,
                                     .estimate = false,
                                     .progress = options.progress});
    if (run.failure) throw IntegrationError(*run.failure, run.motion.failure->time, run.motion.failure->state);
    const std::vector<TimedState> rows = grid_of(run, N, result.interval);
    Stretching stretching(Eigen::MatrixXd::Identity(static_cast<Index>(N), static_cast<Index>(N)), columns);
    const HybridVariation::Wishes wishes{.tolerance = options.tolerance, .finds_pulses = false};
    const auto with_vectors = [&](std::vector<double> y) {
        y.insert(y.end(), stretching.vectors.data(), stretching.vectors.data() + stretching.vectors.size());
        return y;
    };
    for (std::size_t k = 0; k + 1 < rows.size(); ++k) {
        if (options.progress)
            options.progress(say("the motion"), static_cast<double>(k) / static_cast<double>(rows.size()));
        std::vector<double> y = with_vectors(rows[k].state);
        if (k == 0) variation.begin(run.instants, rows[k].t, y, wishes);
        variation.go(rows[k].t, rows[k + 1].t, y, wishes);
        stretching.vectors =
            Eigen::Map<const Eigen::MatrixXd>(y.data() + N, static_cast<Index>(N), static_cast<Index>(columns));
        const double gone = rows[k + 1].t - rows.front().t;
        stretching.renew(gone, rows[k + 1].t - rows[k].t, gone > forgotten_part * options.duration);
    }
    stretching.finish(result, false);
    return result;
}

}  // namespace alembert
