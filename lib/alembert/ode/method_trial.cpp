// SPDX-License-Identifier: MIT
#include "alembert/ode/method_trial.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "alembert/base/process_time.hpp"
#include "alembert/ode/cost_model.hpp"
#include "alembert/ode/integrate.hpp"
#include "alembert/ode/step_size.hpp"
#include "alembert/ode/taylor.hpp"

namespace alembert {

namespace {

constexpr double rounding = 1e-15;       // below it errors are alike
constexpr double clearly_faster = 0.87;  // of the time of the usual method
constexpr double stretch_of_run = 1.0 / 300, shortest_stretch = 1e5, longest_stretch = 3e6;  // the latter in ns
constexpr double fewest_steps = 12, most_of_run = 0.01;                                      // of a stretch
constexpr double making_of_run = 0.02;  // the part of the run in which a series may be made

double seconds_to(const MethodAttempt& attempt, double error) {
    return attempt.seconds *
           std::pow(std::max(attempt.error, rounding) / std::max(error, rounding), 1.0 / attempt.order);
}

class Trying {
public:
    Trying(const System& system, const std::vector<double>& initial, const Options& options,
           const TrialSettings& settings)
        : system_(system), initial_(initial), options_(options), settings_(settings) {
        system_.on_method = {};
        options_.on_step = {};
        options_.when_stiff = options_.when_stuck = options_.when_cheaper = {};
        options_.sample = options.duration;
    }

    std::optional<MethodTrial> among(const std::vector<Method>& rivals) {
        // First steps may be longer than later ones; what is looked at more closely costs a hundredth of the run.
        if (!(8 * predicted_by_first_step() > shortest_run_with_trial)) return std::nullopt;
        const double fewest = fewest_steps * work_of_step(),
                     most = most_of_run * static_cast<double>(options_.budget);
        if (fewest > most || !follow(fewest / 2)) return std::nullopt;
        const double wished = std::clamp(stretch_of_run * whole_, shortest_stretch, longest_stretch);
        const double stretch = std::clamp(wished / effort_of_work(), fewest, most);
        if (stretch * effort_of_work() > most_of_run * whole_ || !follow(stretch)) return std::nullopt;
        options_.duration = until_ - options_.start;
        options_.budget = 40 * work_ + 1000;  // a method that needs so much is no rival
        return compared(rivals);
    }

private:
    /// Of what Statistics::work counts.
    double effort_of_work() const { return effort_of_evaluation(system_.rhs, false); }

    /// How much of it a usual step of the given method is.
    double work_of_step() {
        constexpr double evaluations = 16;
        if (!needs_series(options_.method)) return evaluations;
        const Rhs& rhs = with_series(options_.method).rhs;
        if (!rhs.series) return evaluations;
        const alembert_series_table& costs = *rhs.series.module;
        const double step =
            taylor_effort(costs.order_cost, costs.product_cost, order_of(options_.method), rhs.dimension);
        return std::max(2.0, rhs.slowness.series * step / effort_of_work());
    }

    /// The effort of the whole run if all steps were as long as a first one, which is rarely much longer than the
    /// others.
    double predicted_by_first_step() const {
        constexpr double evaluations = 16;
        const int order = needs_series(options_.method) ? 8 : std::max(8, traits(options_.method).order - 1);
        std::vector<double> rate(initial_.size());
        system_.rhs(options_.start, initial_.data(), rate.data());
        const double longest = options_.longest_step > 0 ? options_.longest_step : options_.duration;
        const double first = starting_step(system_.rhs, {options_.start, initial_.data(), rate.data()},
                                           std::max(options_.tolerance, 1e-15), order, longest);
        return options_.duration / first * evaluations * effort_of_work();
    }

    /// Follows the motion from where it has come until `work` evaluations have been made in all, piece by piece,
    /// and predicts the effort of the whole run after each, by what that piece took for its time. False as soon as
    /// that is too little for a trial, as that of an orbit which begins where it is quickest, or of one whose
    /// first steps are too careful; or if the run ends before, or fails.
    bool follow(double work) {
        if (state_.empty()) {
            begin();
            state_ = initial_;
            until_ = options_.start;
        }
        while (static_cast<double>(work_) < work) {
            Options part = options_;
            part.start = until_;
            part.duration = options_.start + options_.duration - until_;
            const double piece = std::max(fewest_steps / 2 * work_of_step(), static_cast<double>(work_) / 3);
            part.budget = static_cast<long>(std::min(piece, 1e9));
            if (!needs_series(part.method)) part.step = usual_step_;
            const Trajectory motion = integrate(with_series(part.method), state_, part);
            if (!motion.failure || motion.failure->kind != FailureKind::budget_used_up) return false;
            const double time = motion.times.back() - until_;
            if (!(time > 0)) return false;
            until_ = motion.times.back();
            state_.assign(motion.final_state().begin(), motion.final_state().end());
            work_ += motion.statistics.work;
            usual_step_ = time / static_cast<double>(std::max(1L, motion.statistics.steps));
            const double left = options_.start + options_.duration - until_;
            whole_ = effort_of_work() *
                     (static_cast<double>(work_) + static_cast<double>(motion.statistics.work) * (left / time));
            if (!(whole_ > shortest_run_with_trial)) return false;
        }
        return true;
    }

    std::optional<MethodTrial> compared(const std::vector<Method>& rivals) {
        constexpr double worth_another_look = 1.6;
        const Method usual = options_.method;
        std::vector<MethodAttempt> attempts;
        std::vector<std::vector<double>> ends;
        std::vector<Method> methods = {usual};
        for (const Method one : rivals)
            if (one != usual && can(one)) methods.push_back(one);
        double least = HUGE_VAL;
        for (const Method one : methods) {
            MethodAttempt attempt{.method = one, .seconds = HUGE_VAL, .error = 0, .order = order_of(one)};
            std::optional<std::vector<double>> end = timed(attempt);
            if (!end && one == usual) return std::nullopt;
            if (!end) continue;
            if (attempt.seconds < worth_another_look * least) timed(attempt);
            least = std::min(least, attempt.seconds);
            attempts.push_back(attempt);
            ends.push_back(*std::move(end));
        }
        const std::optional<std::vector<double>> reference = exact_end();
        if (!reference) return std::nullopt;
        for (std::size_t k = 0; k < attempts.size(); ++k) attempts[k].error = error_of(ends[k], *reference);
        const Method fastest = fastest_of(attempts, usual);
        return MethodTrial{.fastest = fastest, .until = until_, .attempts = std::move(attempts)};
    }

    bool can(Method method) const {
        if (!needs_series(method) || system_.rhs.series) return true;
        return system_.with_series && system_.effort_of_series < making_of_run * whole_;
    }

    const System& with_series(Method method) {
        if (!needs_series(method) || system_.rhs.series) return system_;
        if (!serial_) {
            serial_ = system_;
            if (system_.with_series) serial_->rhs = system_.with_series();
        }
        return *serial_;
    }

    int order_of(Method method) {
        if (!needs_series(method)) return traits(method).order;
        const Rhs& rhs = with_series(method).rhs;
        if (!rhs.series) return 1;
        return taylor_order(options_.tolerance, rhs.series.module->order_cost, rhs.series.module->product_cost);
    }

    void begin() const {
        if (settings_.begin) settings_.begin();
    }
    double now() const { return settings_.clock ? settings_.clock() : thread_seconds(); }

    std::optional<std::vector<double>> end_of(Method method, double tolerance) {
        const System& system = with_series(method);
        if (needs_series(method) && !system.rhs.series) return std::nullopt;
        Options options = options_;
        options.method = method;
        options.tolerance = tolerance;
        begin();
        const Trajectory motion = integrate(system, initial_, options);
        if (motion.failure || motion.times.back() != options.start + options.duration) return std::nullopt;
        const auto end = motion.final_state();
        return std::vector<double>(end.begin(), end.end());
    }

    /// Sets the time to the least so far.
    std::optional<std::vector<double>> timed(MethodAttempt& attempt) {
        const double before = now();
        std::optional<std::vector<double>> end = end_of(attempt.method, options_.tolerance);
        attempt.seconds = std::min(attempt.seconds, now() - before);
        return end;
    }

    /// By the series if there is one, since a much smaller error costs it little.
    std::optional<std::vector<double>> exact_end() {
        const auto at = [this](double part) { return std::max(part * options_.tolerance, rounding); };
        if (system_.rhs.series || (serial_ && serial_->rhs.series))
            if (auto end = end_of(Method::taylor, at(1e-3))) return end;
        return end_of(Method::verner98, at(1e-4));
    }

    double error_of(const std::vector<double>& end, const std::vector<double>& reference) const {
        double largest = 0;
        for (int i = 0; i < system_.rhs.dimension - system_.rhs.extra; ++i) {
            const auto k = static_cast<std::size_t>(i);
            largest = std::max(largest, std::abs(end[k] - reference[k]) / std::max(1.0, std::abs(reference[k])));
        }
        return largest;
    }

    System system_;
    std::optional<System> serial_ = {};
    const std::vector<double>& initial_;
    Options options_;
    const TrialSettings& settings_;
    std::vector<double> state_ = {};  ///< at until_, to where the motion has been followed
    double usual_step_ = 0;           ///< of the last piece
    double until_ = 0, whole_ = 0;    ///< the latter the predicted effort of the run
    long work_ = 0;                   ///< until then
};

}  // namespace

Method fastest_of(const std::vector<MethodAttempt>& attempts, Method usual) {
    const auto own = std::find_if(attempts.begin(), attempts.end(),
                                  [&](const MethodAttempt& attempt) { return attempt.method == usual; });
    Method fastest = usual;
    double least = clearly_faster * own->seconds;
    for (const MethodAttempt& attempt : attempts) {
        const double seconds = seconds_to(attempt, own->error);
        if (attempt.method == usual || !(seconds < least)) continue;
        least = seconds;
        fastest = attempt.method;
    }
    return fastest;
}

std::optional<MethodTrial> method_trial(const System& system, const std::vector<double>& initial,
                                        const Options& options, const std::vector<Method>& rivals,
                                        const TrialSettings& settings) {
    if (rivals.empty() || options.duration <= 0) return std::nullopt;
    return Trying(system, initial, options, settings).among(rivals);
}

}  // namespace alembert
