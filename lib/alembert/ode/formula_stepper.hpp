// SPDX-License-Identifier: MIT
#pragma once

/// One step of a method without a tableau: all that a stepper needs (stepper.hpp), around a formula that gives the
/// change of the state. `StepFormula` below says what a formula is.
///
///     FormulaStepper<Gauss> step(rhs, t, state, tolerance);
///
/// The state is the sum of two doubles as in explicit_rk.hpp, and errors are measured as in that file.

#include <algorithm>
#include <cmath>
#include <concepts>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "alembert/ode/end_sums.hpp"
#include "alembert/ode/rhs.hpp"
#include "alembert/ode/stepper.hpp"

namespace alembert {

/// How states within a step are found: by the cubic Hermite polynomial; by a shorter step of the method to that
/// time (with its full order, at its full cost); or by the method's own polynomial.
enum class Between { hermite, shorter_step, own };

/// The two ends of a step.
struct Ends {
    Ends(const Rhs& system, double time, std::span<const double> state)
        : rhs(system),
          size(system.dimension),
          controlled(system.dimension - system.extra),
          t(time),
          y(state.begin(), state.end()),
          rest(y.size()),
          next(y.size()),
          next_rest(y.size()),
          rate(y.size()),
          end_rate(y.size()),
          error(y.size()) {
        evaluate(t, y.data(), rate.data());
    }

    void evaluate(double time, const double* state, double* out) {
        rhs(time, state, out);
        ++evaluations;
    }

    /// The size relative to which an error of component i is measured.
    double scale(int i) const {
        const auto k = static_cast<std::size_t>(i);
        return std::max({1.0, std::abs(y[k]), std::abs(next[k])});
    }

    /// The largest of |values_i| / max(1, |y_i|); infinite if one is not finite.
    double norm(const double* values) const {
        double largest = 0, zero = 0;
        for (int i = 0; i < controlled; ++i) {
            largest =
                std::max(largest, std::abs(values[i]) / std::max(1.0, std::abs(y[static_cast<std::size_t>(i)])));
            zero += values[i] * 0;
        }
        return zero == 0 ? largest : HUGE_VAL;
    }

    const Rhs& rhs;
    int size, controlled;
    double t, end = 0, h = 0;
    double end_of_run = HUGE_VAL;  ///< a step that reaches it is the last one
    double length_of_run = HUGE_VAL;
    std::vector<double> y, rest, next, next_rest, rate, end_rate, error;
    bool knows_end_rate = false;
    long evaluations = 0;
};

/// Throws std::invalid_argument for a state that is not (q, v) with q' = v, quadratures left out.
inline void need_coordinates_and_rates(const Ends& ends, const char* who, const char* instead) {
    const auto n = static_cast<std::size_t>(ends.controlled / 2);
    bool fits = ends.controlled % 2 == 0;
    for (std::size_t i = 0; fits && i < n; ++i)
        fits = ends.rate[i] == ends.y[n + i] || !std::isfinite(ends.rate[i]);
    if (!fits)
        throw std::invalid_argument(
            std::string(who) + " need a state of coordinates followed by their rates; this is another: take " +
            instead);
}

/// Writes the error of each component to Ends::error, for steps whose length is chosen.
template <class F>
concept EstimatesError = requires {
    { F::estimate_order } -> std::convertible_to<int>;
};

/// Has its own states within a step (Between::own).
template <class F>
concept Interpolates = requires(F& now, Ends& ends, double theta, double* out) {
    now.interpolate(ends, theta, out);
};

/// The change of the state in a step.
///
/// `increment` writes y(t + h) − y(t), free of the rounding of the sum y + change, and returns false if its
/// equations were not solved. A formula that obtains the rate at the end without further cost writes it to
/// `end_rate` and sets Ends::knows_end_rate. `most_evaluations` is that of an increment. `rounding`,
/// `largest_eigenvalue` and `stable_interval` (stepper.hpp) are those of its stepper too.
template <class F>
concept StepFormula = requires(F formula, const F& now, Ends& ends, double h, double* change, double* end_rate) {
    F(ends, h);  // with the tolerance
    { F::has_fixed_step } -> std::convertible_to<bool>;
    { F::between } -> std::convertible_to<Between>;
    { now.most_evaluations() } -> std::same_as<int>;
    { formula.increment(ends, h, change, end_rate) } -> std::same_as<bool>;
    requires F::has_fixed_step || EstimatesError<F>;
    requires F::between != Between::own || Interpolates<F>;
};

/// Finds the rate at the end, after projection, in its own way. For others the right-hand side is evaluated there.
template <class F>
concept FindsEndRate = requires(F formula, Ends& ends) {
    formula.evaluate_end(ends);
};

/// Remembers past steps: it looks at each whose end is known, also at one that is then rejected.
template <class F>
concept LooksAtEnd = requires(F formula, const Ends& ends) {
    formula.finished(ends);
};

/// Is told of each accepted step before its end becomes the start.
template <class F>
concept MovesOn = requires(F formula, const Ends& ends) {
    formula.advance(ends);
};

/// Chooses the length of the next step; `ends` is already past the step.
template <class F>
concept ChoosesNextLength = requires(F formula, Ends& ends, bool accepted, double ratio) {
    { formula.next_length(ends, accepted, ratio) } -> std::same_as<double>;
};

/// Knows the motion ahead as a power series (KnowsSeries of stepper.hpp).
template <class F>
concept ExpandsSeries = requires(F formula, const F& now, Ends& ends) {
    { formula.first_length(ends) } -> std::same_as<double>;
    { formula.foresees_end(ends) } -> std::same_as<bool>;
    { now.effort() } -> std::same_as<double>;
};

/// Its steps obey the constraints by themselves, and are not projected.
template <class F>
concept KeepsConstraints = requires {
    requires F::keeps_constraints;
};

template <StepFormula Formula>
class FormulaStepper {
public:
    static constexpr bool has_fixed_step = Formula::has_fixed_step;
    static constexpr bool predicts_length = PredictsLength<Formula>;
    static constexpr int estimate_order = [] {
        if constexpr (has_fixed_step)
            return 1;
        else
            return Formula::estimate_order;
    }();

    FormulaStepper(const Rhs& rhs, double t, std::span<const double> state, double tolerance)
        : ends_(rhs, t, state),
          formula_(ends_, tolerance),
          sums_(end_sums(ends_.size)),
          change_(state.size()),
          unused_(Formula::between == Between::shorter_step ? state.size() : 0) {}

    double time() const { return ends_.t; }
    double end_time() const { return ends_.end; }
    double length() const { return ends_.h; }
    const double* state() const { return ends_.y.data(); }
    const double* rate() const { return ends_.rate.data(); }
    const double* end_state() const { return ends_.next.data(); }
    const double* end_rate() const { return ends_.end_rate.data(); }
    long evaluations() const { return ends_.evaluations; }
    const Rhs& rhs() const { return ends_.rhs; }
    int most_evaluations() const { return formula_.most_evaluations() + 1; }
    bool solved() const { return solved_; }
    double stable_interval() const requires KnowsStableInterval<Formula> { return formula_.stable_interval(); }

    double rounding() const requires KnowsRounding<Formula> { return formula_.rounding(); }
    double largest_eigenvalue() const requires KnowsEigenvalue<Formula> { return formula_.largest_eigenvalue(); }
    double effort() const requires ExpandsSeries<Formula> { return formula_.effort(); }

    void end_run_at(double t) {
        ends_.end_of_run = t;
        ends_.length_of_run = t - ends_.t;
    }

    void attempt(double end) {
        ends_.end = end;
        ends_.h = end - ends_.t;
        ends_.knows_end_rate = false;
        solved_ = formula_.increment(ends_, ends_.h, change_.data(), ends_.end_rate.data());
        sums_.add(ends_.y.data(), ends_.rest.data(), change_.data(), ends_.size, ends_.next.data(),
                  ends_.next_rest.data());
    }

    double error_norm() {
        if (!solved_) return HUGE_VAL;
        return sums_.largest(ends_.error.data(), ends_.y.data(), ends_.next.data(), ends_.controlled);
    }

    void correct(const std::function<void(double t, double* state)>& project) {
        if constexpr (KeepsConstraints<Formula>) return;
        change_ = ends_.next;
        project(ends_.end, ends_.next.data());
        for (std::size_t i = 0; i < change_.size(); ++i) {
            if (ends_.next[i] == change_[i]) continue;
            ends_.next_rest[i] = 0;
            ends_.knows_end_rate = false;
        }
    }

    bool finish() {
        if constexpr (FindsEndRate<Formula>)
            formula_.evaluate_end(ends_);
        else if (!ends_.knows_end_rate)
            ends_.evaluate(ends_.end, ends_.next.data(), ends_.end_rate.data());
        if constexpr (LooksAtEnd<Formula>) formula_.finished(ends_);
        return solved_ && is_finite(ends_.end_rate) && is_finite(ends_.next);
    }

    bool foresees_end() requires ExpandsSeries<Formula> { return formula_.foresees_end(ends_); }

    bool starts_finite() const { return is_finite(ends_.rate); }

    int worst_component() const {
        int worst = 0;
        for (int i = 0; i < ends_.controlled; ++i) {
            const auto k = static_cast<std::size_t>(i);
            if (!std::isfinite(ends_.rate[k] + ends_.next[k] + ends_.end_rate[k] + ends_.error[k])) return i;
            if (ends_.error[k] > ends_.error[static_cast<std::size_t>(worst)]) worst = i;
        }
        return worst;
    }

    void advance() {
        if constexpr (MovesOn<Formula>) formula_.advance(ends_);
        std::swap(ends_.y, ends_.next);
        std::swap(ends_.rest, ends_.next_rest);
        std::swap(ends_.rate, ends_.end_rate);
        ends_.t = ends_.end;
    }

    double next_length(bool accepted, double ratio) requires ChoosesNextLength<Formula> {
        return formula_.next_length(ends_, accepted, ratio);
    }

    double first_length() requires ExpandsSeries<Formula> { return formula_.first_length(ends_); }

    void interpolate(double theta, double* out) {
        if constexpr (Formula::between == Between::own) {
            formula_.interpolate(ends_, theta, out);
        } else if constexpr (Formula::between == Between::shorter_step) {
            formula_.increment(ends_, theta * ends_.h, out, unused_.data());
            for (std::size_t i = 0; i < ends_.y.size(); ++i) out[i] = ends_.y[i] + (out[i] + ends_.rest[i]);
        } else {
            const double other = 1 - theta;
            for (std::size_t i = 0; i < ends_.y.size(); ++i) {
                const double r1 = (ends_.next[i] - ends_.y[i]) + (ends_.next_rest[i] - ends_.rest[i]);
                const double r2 = ends_.h * ends_.rate[i] - r1;
                const double r3 = r1 - ends_.h * ends_.end_rate[i] - r2;
                out[i] = ends_.y[i] + theta * (r1 + other * (r2 + theta * r3));
            }
        }
    }

private:
    bool is_finite(const std::vector<double>& values) const {
        return sums_.is_finite(values.data(), ends_.controlled);
    }

    Ends ends_;
    Formula formula_;
    EndSums sums_;
    std::vector<double> change_, unused_;
    bool solved_ = true;
};

}  // namespace alembert
