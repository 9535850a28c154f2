// SPDX-License-Identifier: MIT
#include "alembert/ode/integrate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "alembert/base/argument.hpp"
#include "alembert/base/error.hpp"
#include "alembert/base/process_time.hpp"
#include "alembert/hybrid/automaton.hpp"
#include "alembert/ode/driver.hpp"
#include "alembert/ode/hamiltonian_system.hpp"
#include "alembert/ode/method_table.hpp"
#include "alembert/ode/time_transformation.hpp"

namespace alembert {
namespace {

constexpr double most_rows = 1e8;
constexpr double most_steps = 1e15;  // more steps could not be distinguished in t

void check(bool good, const std::string& message) {
    if (!good) throw std::invalid_argument(message);
}

}  // namespace

void check_options(const Rhs& rhs, const std::vector<double>& initial, const Options& options) {
    using namespace argument;
    check(rhs.call != nullptr, "the right-hand side has no function");
    check(initial.size() == static_cast<std::size_t>(rhs.dimension),
          fmt::format("the state has {} components, {} initial values were given", rhs.dimension, initial.size()));
    for (std::size_t k = 0; k < initial.size(); ++k)
        if (!std::isfinite(initial[k]))
            need_finite(k < rhs.names.size() ? rhs.names[k] : fmt::format("initial[{}]", k), initial[k]);
    need_finite("start", options.start);
    need_nonnegative("duration", options.duration);
    need_finite("start + duration", options.start + options.duration);
    need_positive("tolerance", options.tolerance);
    need_positive_if_given("step", options.step);
    need_positive_if_given("max_step", options.longest_step);
    need_positive_if_given("sample", options.sample);
    need_positive("budget", static_cast<double>(options.budget));
    check(!needs_series(options.method) || rhs.series.width == rhs.dimension,
          fmt::format("{} needs the Taylor series of the system (emit_taylor, make_series), which this right-hand "
                      "side does not have",
                      name(options.method)));
    check(
        !needs_canonical(options.method) || (rhs.canonical && 2 * rhs.canonical->coordinates <= rhs.dimension),
        fmt::format("{} needs the momenta and constraints of the system (hamiltonian.hpp), which this right-hand "
                    "side does not have",
                    name(options.method)));
    check(!has_fixed_step(options.method) || options.step > 0 || options.duration == 0,
          fmt::format("{} has a fixed step: give it, for example step = {:g}", name(options.method),
                      options.duration / 1000));
    check(!has_fixed_step(options.method) || options.duration == 0 || options.duration / options.step < most_steps,
          fmt::format("step = {}: more than {:g} steps", options.step, most_steps));
    check(has_fixed_step(options.method) || options.longest_step == 0 ||
              options.duration / options.longest_step < most_steps,
          fmt::format("longest_step (max_step of a scene) = {}: more than {:g} steps", options.longest_step,
                      most_steps));
    check(options.duration == 0 || options.duration / sample_interval(options) < most_rows,
          fmt::format("sample = {}: more than {:g} rows", options.sample, most_rows));
}

namespace {

template <class AnyStep>
Trajectory run(const System& system, const std::vector<double>& initial, const Options& options,
               const Events& events, const RunPiece& piece) {
    return Driver<AnyStep>(system, initial, options, events, piece).go();
}

constexpr std::array by_method =
    for_each_method([](const auto& row) { return &run<typename std::remove_cvref_t<decltype(row)>::Steps>; });

/// The methods of a run as modes (automaton.hpp), from where the first has given way to another: if the run was
/// found to be stiff, both take turns. The longer a run has come back in vain, the longer it does not look for
/// stiffness.
class MethodsInTurn {
public:
    MethodsInTurn(Trajectory& whole, const System& system, const Options& options, const Events& events)
        : whole_(whole),
          system_(system),
          options_(options),
          events_(events),
          now_{.t = whole.times.back(), .state = {whole.final_state().begin(), whole.final_state().end()}},
          next_(whole.statistics.switched),
          usual_(options.method),
          when_stuck_(options.when_stuck),
          when_cheaper_(options.when_cheaper) {}

    MotionState& now() { return now_; }

    Mode enter(Options rest, RunPiece piece) {
        const bool is_stiff = next_->why == Switch::Why::stiff, is_stuck = next_->why == Switch::Why::stuck;
        const bool is_cheaper = next_->why == Switch::Why::cheaper;
        if (is_cheaper) when_stuck_ = std::exchange(usual_, *when_cheaper_);
        may_leave_series_ = may_leave_series_ || is_cheaper;
        piece.switching.may_leave_series = may_leave_series_;
        if (is_stuck) usual_ = *std::exchange(when_stuck_, {});
        if (is_stuck || is_cheaper) when_cheaper_ = {};
        rest.method = usual_;
        rest.when_stuck = when_stuck_;
        rest.when_cheaper = when_cheaper_;
        rest.step = 0;
        if (is_stiff) {
            rest.method = *options_.when_stiff;
            rest.when_stiff = {};
            rest.step = next_->step;
            piece.switching.back = usual_;
            piece.switching.effort_per_time = next_->effort_per_time;
        } else if (!is_stuck && !is_cheaper) {
            piece.switching.patience = patience_;
            patience_ *= 4;
        }
        System system = system_;
        if (is_stiff)
            system.rhs = once(implicit_, system_.with_jacobian);
        else if (needs_series(rest.method) && !system_.rhs.series)
            system.rhs = once(series_, system_.with_series);
        if (system_.on_method) system_.on_method(rest.method);
        grid_ = *piece.grid;
        return {.system = std::move(system),
                .guards = events_,
                .options = rest,
                .piece = std::move(piece),
                .integrate = by_method[static_cast<std::size_t>(rest.method)]};
    }

    void collect(Trajectory part) {
        next_ = std::exchange(part.statistics.switched, {});
        if (next_) whole_.statistics.later_switches.push_back(*next_);
        append(whole_, std::move(part), grid_, sample_interval(options_));
    }

    bool next_mode(const Hit&) const { return next_ && whole_.ending == Ending::completed; }
    std::string changes() const { return {}; }

private:
    const Rhs& once(std::optional<Rhs>& made, const std::function<Rhs()>& make) const {
        if (!made) made = make ? make() : system_.rhs;
        return *made;
    }

    Trajectory& whole_;
    const System& system_;
    const Options& options_;
    const Events& events_;
    MotionState now_;
    std::optional<Switch> next_;
    Method usual_;  ///< the one that is left when the run is found to be stiff
    std::optional<Method> when_stuck_, when_cheaper_;
    bool may_leave_series_ = false;
    long patience_ = 50;
    double grid_ = 0;
    std::optional<Rhs> implicit_ = {}, series_ = {};
};

}  // namespace

Trajectory integrate(const System& system, const std::vector<double>& initial, const Options& options,
                     const Events& events, const RunPiece& piece) {
    check_options(system.rhs, initial, options);
    const double start = thread_seconds();
    if (system.on_method) system.on_method(options.method);
    Trajectory result;
    if (options.regularization != Regularization::none) {
        result = integrate_regularized(system, initial, options, events, piece);
    } else if (system.by) {
        result = system.by(system, initial, options, events, piece);
    } else {
        result = by_method[static_cast<std::size_t>(options.method)](system, initial, options, events, piece);
        if (result.statistics.switched && result.ending == Ending::completed) {
            MethodsInTurn modes(result, system, options, events);
            run_modes(modes, options, piece, result.statistics.work);
        }
    }
    result.statistics.seconds = thread_seconds() - start;
    return result;
}

Trajectory integrate(const Rhs& rhs, const std::vector<double>& initial, const Options& options,
                     const Events& events) {
    return integrate(System{.rhs = rhs}, initial, options, events);
}

void throw_failure(const Failure& failure) {
    throw IntegrationError(failure.message, failure.time, failure.state);
}

}  // namespace alembert
