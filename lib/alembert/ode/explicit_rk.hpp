// SPDX-License-Identifier: MIT
#pragma once

/// One step of an explicit Runge-Kutta method given by a tableau: stages, new state, error estimate, dense output.
///
///     Step<dop853_tableau> step(rhs, t, state);
///     step.attempt(t + h);                     // stages and y₁
///     const double misfit = step.misfit();     // the largest error; infinite if something is not finite
///     if (step.finish())                       // the rate at the end; false: not finite
///         step.interpolate(0.5, middle);       // anywhere in the step, θ = 0…1
///     step.advance();                          // the end becomes the start
///
/// If the misfit is too large or `finish` fails, `worst_component` gives the component responsible.
///
/// Arrays are padded to whole lanes of two numbers, which every x86-64 has (lanes of four cost 10 % more without
/// AVX). The weights are compile-time constants, so that zeros cost nothing. Nothing is allocated after
/// construction. The state is kept as a sum of two doubles, y + rest (Kahan 1965; Hairer, Lubich, Wanner,
/// Geometric Numerical Integration, §VIII.5): a small step then loses nothing of what it adds to a large state,
/// and the stages start from both numbers.
///
/// The error is measured component by component as |error_i| / max(1, |y_i|). The largest value is the misfit,
/// which is compared with the tolerance. With two rows of error weights (dop853) the error is that of Hairer,
/// Nørsett, Wanner I, §II.10, e₅² / √(e₅² + 0.01 e₃²), of order h⁸; they take e₅ and e₃ as norms of the whole
/// vector, while here each component has its own (on the problems of step_size.hpp this needs up to 15 % fewer
/// evaluations for the same error). Quadratures (Rhs::extra) are left out.

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "alembert/ode/rhs.hpp"
#include "alembert/ode/tableau.hpp"

namespace alembert {

/// Calls function<0>, function<1>, … function<count − 1>, one after the other.
template <int count, class Function>
void repeat(Function function) {
    const auto all = [&]<int... i>(std::integer_sequence<int, i...>) {
        (function.template operator()<i>(), ...);
    };
    all(std::make_integer_sequence<int, count>());
}

template <const auto& tableau>
class Step {
    using Lane [[gnu::vector_size(16)]] = double;
    static constexpr int width = 2;
    static constexpr int stages = tableau.stages;

public:
    static constexpr bool has_fixed_step = tableau.error_rows == 0;
    static constexpr int estimate_order = tableau.estimate_order;
    static constexpr int most_evaluations() { return tableau.all_stages; }

    /// The tolerance is for methods that solve equations in a step; this one does not.
    Step(const Rhs& rhs, double t, std::span<const double> state, double /*tolerance*/ = 0)
        : rhs_(rhs),
          controlled_(rhs.dimension - rhs.extra),
          blocks_((rhs.dimension + width - 1) / width),
          stride_(std::max(blocks_, short_stride)),
          memory_(static_cast<std::size_t>(stride_) * (arrays + tableau.all_stages + tableau.dense_rows)),
          t_(t) {
        std::copy(state.begin(), state.end(), real(y_));
        rate_into(0, t, real(y_));
    }

    double time() const { return t_; }
    double end_time() const { return end_; }
    double length() const { return h_; }
    const double* state() const { return real(y_); }
    const double* rate() const { return real(stage(0)); }
    const double* end_state() const { return real(next_); }
    const double* end_rate() const { return real(stage(stages)); }
    long evaluations() const { return evaluations_; }
    const Rhs& rhs() const { return rhs_; }

    /// The stages of a step to `end` and the state there.
    void attempt(double end) {
        end_ = end;
        h_ = end - t_;
        looked_into_ = false;
        repeat<stages - 1>([&]<int i>() { this->template evaluate<i + 1>(); });
        add_up();
        if constexpr (last_stage_in_estimate()) rate_into(stages, end_, real(next_));
    }

    double misfit() {
        with_stride([&](auto stride) {
            for (int b = 0; b < blocks_; ++b) lanes(error_)[b] = squared_error(stride, b);
        });
        double largest = 0;
        double zero = 0;
        for (int i = 0; i < controlled_; ++i) {
            const double square = real(error_)[i];
            largest = std::max(largest, square);
            zero += (square + end_state()[i]) * 0;
        }
        return zero == 0 ? std::sqrt(largest) : HUGE_VAL;
    }

    /// Moves the end of an attempted step onto its constraints and evaluates the rate again. A component that does
    /// not move keeps its compensation of rounding.
    void correct(const std::function<void(double t, double* state)>& project) {
        std::copy_n(real(next_), rhs_.dimension, real(trial_));
        project(end_, real(next_));
        bool moved = false;
        for (int i = 0; i < rhs_.dimension; ++i) {
            if (real(next_)[i] == real(trial_)[i]) continue;
            real(next_rest_)[i] = 0;
            moved = true;
        }
        if (!moved) return;
        if constexpr (last_stage_in_estimate()) rate_into(stages, end_, real(next_));
    }

    /// Evaluates the rate at the end, unless the estimate has needed it already; false if it is not finite.
    bool finish() {
        if constexpr (!last_stage_in_estimate()) rate_into(stages, end_, real(next_));
        return is_finite(end_rate()) && is_finite(end_state());
    }

    bool starts_finite() const { return is_finite(rate()); }

    /// The component responsible for a failure: the first that is not finite at the start or the attempted end,
    /// else the one with the largest error.
    int worst_component() const {
        int worst = 0;
        for (int i = 0; i < controlled_; ++i) {
            if (!std::isfinite(rate()[i] + end_state()[i] + end_rate()[i] + real(error_)[i])) return i;
            if (real(error_)[i] > real(error_)[worst]) worst = i;
        }
        return worst;
    }

    void advance() {
        std::swap(y_, next_);
        std::swap(rest_, next_rest_);
        std::copy_n(stage(stages), blocks_, stage(0));
        t_ = end_;
    }

    /// The state at t + θ h of a finished step; `out` has Rhs::dimension places.
    void interpolate(double theta, double* out) {
        if (!looked_into_) look_into();
        const double other = 1 - theta;
        const double* const r[2] = {real(difference_), real(stage(tableau.all_stages))};
        for (int i = 0; i < rhs_.dimension; ++i) {
            const double r1 = r[0][i];
            const double r2 = h_ * rate()[i] - r1;
            const double r3 = r1 - h_ * end_rate()[i] - r2;
            double tail = 0;
            for (int row = tableau.dense_rows - 1; row >= 0; --row)
                tail = r[1][row * stride_ * width + i] + (row % 2 == 0 ? theta : other) * tail;
            out[i] = state()[i] + theta * (r1 + other * (r2 + theta * (r3 + other * tail)));
        }
    }

private:
    static constexpr int short_stride = 8;  ///< in lanes; enough for up to 16 components
    static constexpr int arrays = 7;        ///< y, rest, next, next_rest, and the three below

    static constexpr bool last_stage_in_estimate() {
        for (const auto& row : tableau.e)
            if (row[stages] != 0) return true;
        return false;
    }

    Lane* lanes(int array) { return memory_.data() + array * stride_; }
    const Lane* lanes(int array) const { return memory_.data() + array * stride_; }
    double* real(int array) { return reinterpret_cast<double*>(lanes(array)); }
    const double* real(int array) const { return reinterpret_cast<const double*>(lanes(array)); }
    Lane* stage(int i) { return lanes(arrays + i); }
    const Lane* stage(int i) const { return lanes(arrays + i); }
    static double* real(Lane* lane) { return reinterpret_cast<double*>(lane); }
    static const double* real(const Lane* lane) { return reinterpret_cast<const double*>(lane); }

    void rate_into(int i, double t, const double* state) {
        rhs_(t, state, real(stage(i)));
        ++evaluations_;
    }

    /// Calls `function` with the number of lanes from one array to the next. For short states that is a constant,
    /// so that the distances of all stages from the first are constants, which saves 5 % of the time of a free
    /// body.
    template <class Function>
    void with_stride(Function function) const {
        if (stride_ == short_stride)
            function(std::integral_constant<int, short_stride>());
        else
            function(stride_);
    }

    /// Σ_j weight_j k_j, j running over the non-zero weights, `k` being the first stage; `Row` gives weight j as a
    /// constant.
    template <class Row>
    static Lane weighted_sum(const Lane* k, auto stride) {
        constexpr int count = terms_of<Row>();
        if constexpr (count == 0)
            return Lane{};
        else
            return sum_of_terms<Row>(k, stride, std::make_integer_sequence<int, count - 1>());
    }

    /// The terms in one expression, because a function for each would take long to compile.
    template <class Row, int... n>
    static Lane sum_of_terms(const Lane* k, auto stride, std::integer_sequence<int, n...>) {
        constexpr std::array<int, sizeof...(n) + 1> at = places_of<Row, sizeof...(n) + 1>();
        constexpr std::array<double, sizeof...(n) + 1> weight{Row::weight(at[0]), Row::weight(at[n + 1])...};
        Lane sum = weight[0] * k[at[0] * stride];
        (..., (sum += weight[n + 1] * k[at[n + 1] * stride]));
        return sum;
    }

    template <class Row>
    static constexpr int terms_of() {
        int count = 0;
        for (int j = 0; j < tableau.all_stages; ++j) count += Row::weight(j) != 0 ? 1 : 0;
        return count;
    }

    /// The stages whose weights are not zero.
    template <class Row, std::size_t count>
    static constexpr std::array<int, count> places_of() {
        std::array<int, count> places{};
        std::size_t next = 0;
        for (int j = 0; j < tableau.all_stages; ++j)
            if (Row::weight(j) != 0) places[next++] = j;
        return places;
    }

    /// rest + h Σ_j weight_j k_j. Stage `fresh` has just been written, and everything else waits for it. Therefore
    /// it enters last and is loaded number by number: a load of two numbers would wait until both have reached the
    /// cache.
    template <class Row, int fresh>
    static Lane change(const Lane* k, auto stride, double h, const Lane& rest) {
        const Lane known = h * weighted_sum<Without<Row, fresh>>(k, stride) + rest;
        constexpr double weight = Row::weight(fresh);
        if constexpr (weight == 0) return known;
        return known + (h * weight) * loaded_singly(reinterpret_cast<const double*>(k + fresh * stride));
    }

    static Lane loaded_singly(const double* from) {
        double first = from[0], second = from[1];
#if defined(__x86_64__)
        __asm__("" : "+x"(first));
        __asm__("" : "+x"(second));
#endif
        return Lane{first, second};
    }

    template <int i>
    struct StageRow {
        static constexpr double weight(int j) { return tableau.a[i][static_cast<std::size_t>(j)]; }
    };
    template <class Row, int fresh>
    struct Without {
        static constexpr double weight(int j) { return j == fresh ? 0 : Row::weight(j); }
    };
    template <int i>
    struct ErrorRow {
        static constexpr double weight(int j) { return tableau.e[i][static_cast<std::size_t>(j)]; }
    };
    template <int i>
    struct DenseRow {
        static constexpr double weight(int j) { return tableau.d[i][static_cast<std::size_t>(j)]; }
    };

    template <int i>
    void evaluate() {
        with_stride([&](auto stride) {
            const Lane *const k = stage(0), *const y = lanes(y_), *const rest = lanes(rest_);
            Lane* const trial = lanes(trial_);
            const double h = h_;
            for (int b = 0; b < blocks_; ++b)
                trial[b] = y[b] + change<StageRow<i>, i - 1>(k + b, stride, h, rest[b]);
        });
        rate_into(i, t_ + tableau.c[i] * h_, real(trial_));
    }

    /// y₁ + rest₁ = y + (rest + h Σ b_j k_j), by Knuth's exact sum of two doubles.
    void add_up() {
        with_stride([&](auto stride) {
            for (int b = 0; b < blocks_; ++b) {
                const Lane y = lanes(y_)[b];
                const Lane added = change<StageRow<stages>, stages - 1>(stage(0) + b, stride, h_, lanes(rest_)[b]);
                const Lane next = y + added;
                const Lane taken = next - y;
                lanes(next_)[b] = next;
                lanes(next_rest_)[b] = (y - (next - taken)) + (added - taken);
            }
        });
    }

    static Lane larger(const Lane& a, const Lane& b) {
        return a > b ? a : b;
    }

    /// The squared errors of block b, in units of max(1, |y_i|).
    Lane squared_error(auto stride, int b) const {
        const Lane y = lanes(y_)[b], next = lanes(next_)[b];
        const Lane scale = h_ / larger(larger(larger(y, -y), larger(next, -next)), Lane{} + 1);
        const Lane error = scale * weighted_sum<ErrorRow<0>>(stage(0) + b, stride);
        const Lane square = error * error;
        if constexpr (tableau.error_rows == 1) {
            return square;
        } else {
            const Lane third = scale * weighted_sum<ErrorRow<1>>(stage(0) + b, stride);
            constexpr double tiny = 1e-300;  // 0/0 is 0
            return square * (square / (square + 0.01 * third * third + tiny));
        }
    }

    bool is_finite(const double* values) const {
        double zero = 0;
        for (int i = 0; i < controlled_; ++i) zero += values[i] * 0;
        return zero == 0;
    }

    /// Computes the additional stages and the rows of dense output.
    void look_into() {
        repeat<tableau.all_stages - stages - 1>([&]<int i>() { this->template evaluate<stages + 1 + i>(); });
        for (int b = 0; b < blocks_; ++b) {
            lanes(difference_)[b] = (lanes(next_)[b] - lanes(y_)[b]) + (lanes(next_rest_)[b] - lanes(rest_)[b]);
            repeat<tableau.dense_rows>([&]<int i>() { this->template dense_row<i>(b); });
        }
        looked_into_ = true;
    }

    template <int i>
    void dense_row(int b) {
        stage(tableau.all_stages + i)[b] = h_ * weighted_sum<DenseRow<i>>(stage(0) + b, stride_);
    }

    const Rhs& rhs_;
    int controlled_;  ///< number of components under error control
    int blocks_;
    int stride_;  ///< number of lanes from one array to the next
    std::vector<Lane> memory_;
    int y_ = 0, rest_ = 1, next_ = 2,
        next_rest_ = 3;  ///< places of the arrays in memory; those of y and next are exchanged after a step
    static constexpr int trial_ = 4, difference_ = 5, error_ = 6;
    double t_, end_ = 0, h_ = 0;
    long evaluations_ = 0;
    bool looked_into_ = false;
};

}  // namespace alembert
