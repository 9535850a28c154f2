// SPDX-License-Identifier: MIT
#include "alembert/ode/time_transformation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "alembert/ode/disturbance.hpp"
#include "alembert/ode/driver.hpp"

namespace alembert {
namespace {

/// The system in s, with states (y, t).
struct OwnTime {
    Rhs rhs;
    Regularization form;
    bool is_steep = false;         ///< γ is 3/2, not 1
    double unit = 0, binding = 0;  ///< U₀ and B

    std::size_t size() const { return static_cast<std::size_t>(rhs.dimension); }

    struct Energies {
        double kinetic, depth;  ///< T and U
    };
    Energies energies(const double* state) const {
        double values[2];
        rhs.energies(rhs.context.get(), state[size()], state, values);
        return {values[0], -values[1]};
    }

    /// (U₀/x)^γ; not a number where that has no meaning.
    double pace(double x) const {
        const double ratio = x > 0 ? unit / x : std::numeric_limits<double>::quiet_NaN();
        return is_steep ? ratio * std::sqrt(ratio) : ratio;
    }
    double drift_pace(const Energies& e) const {
        return pace(form == Regularization::canonical ? e.kinetic + binding : e.depth);
    }

    void operator()(double, const double* state, double* rate) const {
        rhs(state[size()], state, rate);
        const Energies e = energies(state);
        const double drift = drift_pace(e), kick = pace(e.depth);
        const std::size_t drifting = form == Regularization::canonical ? size() / 2 : 0;
        for (std::size_t i = 0; i < size(); ++i) rate[i] *= i < drifting ? drift : kick;
        rate[size()] = drift;
    }

    static void drift_of(const void* context, double, const double* state, double* rate) {
        const OwnTime& own = *static_cast<const OwnTime*>(context);
        const std::size_t n = own.size() / 2;
        const double drift = own.drift_pace(own.energies(state));
        for (std::size_t i = 0; i < n; ++i) rate[i] = drift * state[n + i];
        rate[2 * n] = drift;
    }
};

OwnTime own_time_of(const Rhs& rhs, const std::vector<double>& initial, const Options& options) {
    const auto need = [](bool good, const std::string& message) {
        if (!good) throw std::invalid_argument(message);
    };
    need(rhs.energies != nullptr && rhs.extra == 0,
         "a regularized run needs T and V of a system whose energy is conserved, without quadratures");
    need(
        !needs_series(options.method) && !needs_canonical(options.method) &&
            (!needs_separable(options.method) || has_fixed_step(options.method)),
        fmt::format("{} does not run in a time of its own; take kahanli8, gauss or dop853", name(options.method)));
    const bool canonical = options.regularization == Regularization::canonical;
    need(canonical || !needs_separable(options.method),
         fmt::format("{} needs the canonical form of a regularization", name(options.method)));
    OwnTime own{.rhs = rhs,
                .form = options.regularization,
                .is_steep = has_fixed_step(options.method) && options.method != Method::verlet};
    std::vector<double> state = initial, rate(own.size());
    state.push_back(options.start);
    rhs(options.start, state.data(), rate.data());
    const std::size_t n = own.size() / 2;
    const auto middle = static_cast<std::ptrdiff_t>(n);
    need(!canonical ||
             (own.size() % 2 == 0 && std::equal(rate.begin(), rate.begin() + middle, state.begin() + middle)),
         "the canonical form of a regularization needs a state of coordinates followed by their rates");
    const OwnTime::Energies e = own.energies(state.data());
    need(e.depth > 0, fmt::format("the potential energy is {:g} at the start; a regularized run needs one that is "
                                  "negative, as that of gravity between bodies",
                                  -e.depth));
    own.unit = e.depth;
    own.binding = e.depth - e.kinetic;
    if (options.disturbed.seed != 0)
        own.binding += Flutter(options.disturbed.seed, options.start)() * std::max(e.depth, e.kinetic);
    return own;
}

Rhs system_of(const OwnTime& own) {
    Rhs result = make_rhs(own.rhs.dimension + 1, own);
    result.names = own.rhs.names;
    if (!result.names.empty()) result.names.emplace_back("t");
    result.effort = 2 * own.rhs.effort;
    result.slowness = own.rhs.slowness;
    if (own.form == Regularization::canonical) result.drift = OwnTime::drift_of;
    return result;
}

/// The run in s, and what it tells in t.
class OwnTimeRun {
public:
    OwnTimeRun(const System& given, const std::vector<double>& initial, const Options& options,
               const Events& events, const RunPiece& piece)
        : own_(own_time_of(given.rhs, initial, options)),
          options_(options),
          piece_(piece),
          events_(events),
          system_{.rhs = system_of(own_), .on_method = given.on_method},
          end_(options.start + options.duration),
          interval_(sample_interval(options)),
          grid_(grid_of(options, piece)),
          step_start_(initial),
          row_(initial.size() + 1) {
        step_start_.push_back(options.start);
        rate_.resize(initial.size());
        result_.dimension = given.rhs.dimension;
        result_.names = given.rhs.names;
        if (given.project)
            system_.project = [this, project = given.project](double, double* state) {
                project(time_of(state), state);
            };
        add_row(step_start_);
        if (piece.grid) next_row_ += static_cast<long>(std::floor((options.start - grid_) / interval_ + 1e-9));
    }

    Trajectory go() && {
        const Trajectory inner =
            integrate(system_, step_start_, inner_options(), events_in_own_time(),
                      {.late = piece_.late, .on_step_view = [this](const StepView& step) { return look(step); }});
        result_.statistics = inner.statistics;
        result_.statistics.evaluations += further_evaluations_;
        result_.statistics.work += further_evaluations_;
        if (inner.failure && !is_finished_)
            fail(*inner.failure);
        else
            end(inner);
        return std::move(result_);
    }

private:
    std::size_t size() const { return own_.size(); }
    double time_of(const double* state) const { return state[size()]; }

    Options inner_options() {
        // Of s nothing is known but that it runs like t at first; the end is that in t, found by `look`.
        constexpr double far = 1e14;
        Options inner = options_;
        inner.regularization = Regularization::none;
        inner.start = 0;
        inner.duration = far * (options_.step > 0 ? options_.step : options_.duration);
        inner.sample = inner.duration;
        inner.when_stiff = {};
        inner.when_stuck = {};
        inner.when_cheaper = {};
        if (options_.duration == 0) inner.duration = 0;
        inner.on_step = [this](double, std::span<const double> state, std::span<const double>) { tell(state); };
        return inner;
    }

    Events events_in_own_time() {
        if (events_.list.empty()) return {};
        Events own = make_events(events_.list, [this](double, const double* state, const double*, double* out) {
            own_.rhs(time_of(state), state, rate_.data());
            events_(time_of(state), state, rate_.data(), out);
        });
        if (!events_.bounds.exist) return own;
        own.bounds = {.exist = events_.bounds.exist, .of = [this](int k, const MotionBounds& motion) {
                          const auto t = static_cast<int>(size());
                          const auto in_t = [&](int component) {  // y' = dy/ds / dt/ds
                              return motion.rate(component) * inverse(motion.rate(t));
                          };
                          return events_.bounds.of(k,
                                                   {.time = motion.state(t), .state = motion.state, .rate = in_t});
                      }};
        return own;
    }

    void tell(std::span<const double> state) {
        std::copy(state.begin(), state.end(), step_start_.begin());
        if (is_finished_ || !options_.on_step) return;
        own_.rhs(time_of(state.data()), state.data(), rate_.data());
        options_.on_step(time_of(state.data()), state.first(size()), rate_);
    }

    /// Records the rows in a step; true if the end of the run is in it.
    bool look(const StepView& step) {
        const double begin = time_of(step_start_.data()), reached = time_of(step.end_state);
        for (;; ++next_row_) {
            const double t = grid_ + static_cast<double>(next_row_) * interval_;
            if (t > reached || t >= end_ - 1e-9 * interval_) break;
            place_of(step, begin, reached, t);
            row_[size()] = t;
            add_row(row_);
        }
        if (reached < end_) return false;
        is_finished_ = true;
        step_to_end((step.end - step.start) * place_of(step, begin, reached, end_));
        return true;
    }

    /// The place θ in a step at which its dense output reaches t, and the state there in `row_`, moved by what is
    /// left of the time. By Newton's method, within bounds that shrink.
    double place_of(const StepView& step, double begin, double reached, double t) {
        double low = 0, high = 1, theta = (t - begin) / (reached - begin), left = 0;
        const double h = step.end - step.start;
        std::vector<double>& rate = inner_rate_;
        rate.resize(size() + 1);
        for (int round = 0; round < most_rounds; ++round) {
            step.interpolate(theta, row_.data());
            own_(0, row_.data(), rate.data());
            ++further_evaluations_;
            left = t - time_of(row_.data());
            if (!(std::abs(left) > 2 * std::numeric_limits<double>::epsilon() * std::abs(t))) break;
            (left > 0 ? low : high) = theta;
            const double wish = theta + left / (h * rate[size()]);
            const double next = wish > low && wish < high ? wish : (low + high) / 2;
            if (next == theta) break;
            theta = next;
        }
        for (std::size_t i = 0; i < size(); ++i) row_[i] += left / rate[size()] * rate[i];
        return theta;
    }

    /// Repeats the last step with a length close to h, so that the run ends with the end of a step.
    void step_to_end(double h) {
        std::vector<double> state = step_start_, rate(size() + 1);
        double left = 0;
        for (int round = 0; round < most_rounds && h > 0; ++round) {
            Options last = inner_options();
            last.on_step = {};
            last.start = 0;
            last.duration = last.sample = h;
            if (has_fixed_step(options_.method)) last.step = h;
            const Trajectory piece = integrate(system_, step_start_, last, {}, {.late = piece_.late});
            further_evaluations_ += piece.statistics.evaluations + 1;
            if (piece.failure) break;
            state.assign(piece.final_state().begin(), piece.final_state().end());
            own_(0, state.data(), rate.data());
            const double before = std::exchange(left, end_ - time_of(state.data()));
            if (std::abs(left) <= std::numeric_limits<double>::epsilon() * std::abs(end_)) break;
            if (round > 1 && std::abs(left) >= std::abs(before)) break;
            h += left / rate[size()];
        }
        for (std::size_t i = 0; i < size(); ++i) state[i] += left / rate[size()] * rate[i];
        state[size()] = end_;
        end_state_ = std::move(state);
    }

    void add_row(const std::vector<double>& state) {
        result_.times.push_back(state[size()]);
        result_.states.insert(result_.states.end(), state.begin(), state.end() - 1);
    }

    /// The end at `end_`, or at an event that stops the run before.
    void end(const Trajectory& inner) {
        const double last = is_finished_ ? end_ : time_of(inner.final_state().data());
        bool is_stopped = false;
        for (const EventRecord& event : inner.events) {
            const double t = time_of(event.state.data());
            if (t > end_) continue;
            result_.events.push_back(event);
            result_.events.back().time = t;
            result_.events.back().state.pop_back();
            is_stopped = is_stopped || events_.list[static_cast<std::size_t>(event.index)].stop;
        }
        std::vector<double> state(inner.final_state().begin(), inner.final_state().end());
        if (is_finished_ && !is_stopped) state = end_state_;
        while (result_.rows() > 1 &&
               result_.times.back() > std::min(last, time_of(state.data())) - 1e-9 * interval_)
            drop_row();
        if (is_stopped) {
            result_.ending = Ending::stopped_by_event;
            result_.last_zeros = inner.last_zeros;
        }
        if (options_.duration > 0) finish_with(state);
    }

    void finish_with(const std::vector<double>& state) {
        if (result_.times.back() < time_of(state.data())) add_row(state);
        if (std::exchange(is_finished_, false)) tell(state);  // the inner run has told of an event before the end
    }

    void drop_row() {
        result_.times.pop_back();
        result_.states.resize(result_.states.size() - size());
    }

    void fail(Failure failure) {
        failure.time = time_of(failure.state.data());
        if (failure.kind == FailureKind::budget_used_up)
            failure.message = budget_is_used_up(options_.budget, failure.time);
        else if (failure.kind == FailureKind::step_underflow)
            failure.message = fmt::format(
                "step size underflow at t = {}; there may be a singularity here, or the "
                "tolerance is beyond double precision",
                failure.time);
        else
            failure.message = fmt::format(
                "the regularized run found no step after t = {}, where the potential energy is {:g}: it has to "
                "stay "
                "negative, and steps short enough for their equations; take a shorter step, or no regularization",
                failure.time, -own_.energies(failure.state.data()).depth);
        if (result_.times.back() < failure.time) add_row(failure.state);
        failure.state.pop_back();
        result_.ending = Ending::failed;
        result_.failure = std::move(failure);
    }

    static constexpr int most_rounds = 60;

    OwnTime own_;
    const Options& options_;
    const RunPiece& piece_;
    const Events& events_;
    System system_;  ///< in s; quick times are in t
    double end_, interval_, grid_;
    std::vector<double> step_start_, end_state_, row_, rate_, inner_rate_;
    Trajectory result_;
    long next_row_ = 1, further_evaluations_ = 0;
    bool is_finished_ = false;  ///< the end of the run was reached
};

}  // namespace

Trajectory integrate_regularized(const System& system, const std::vector<double>& initial, const Options& options,
                                 const Events& events, const RunPiece& piece) {
    return OwnTimeRun(system, initial, options, events, piece).go();
}

}  // namespace alembert
