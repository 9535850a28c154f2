// SPDX-License-Identifier: MIT
#pragma once

/// One step of an explicit Runge-Kutta method given by a tableau: stages, new state, error estimate, dense output.
///
///     ExplicitRK<dop853_tableau> step(rhs, t, state);
///     step.attempt(t + h);                     // stages and y₁
///     step.error_norm();                       // the largest error; infinite if something is not finite
///     if (step.finish())                       // the rate at the end; false: not finite
///         step.interpolate(0.5, middle);       // anywhere in the step, θ = 0…1
///     step.advance();                          // the end becomes the start
///
/// If it is too large or `finish` fails, `worst_component` gives the component responsible.
///
/// The sums of stages are made in registers of four numbers where the processor has them (AVX2), else of two,
/// which every x86-64 has; the digits are the same, since each number has its own sum in the order of the weights,
/// and no product is added in one rounding. Arrays are padded to whole packs of eight numbers. The weights are
/// compile-time constants, so that zeros cost nothing. Nothing is allocated after construction. The state is kept
/// as a sum of two doubles, y + rest (Kahan 1965; Hairer, Lubich, Wanner, Geometric Numerical Integration,
/// §VIII.5): a small step then loses nothing of what it adds to a large state, and the stages start from both
/// numbers.
///
/// The error is measured component by component as |error_i| / max(1, |y_i|). The largest value is the error norm,
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

#include "alembert/native/registers.hpp"
#include "alembert/ode/rhs.hpp"
#include "alembert/ode/stage_sums.hpp"
#include "alembert/ode/tableau.hpp"

namespace alembert {

template <const auto& tableau>
class ExplicitRK {
    static constexpr int stages = tableau.stages;

public:
    static constexpr bool has_fixed_step = tableau.error_rows == 0;
    static constexpr int estimate_order = tableau.estimate_order;
    static constexpr int most_evaluations() { return tableau.all_stages; }

    /// The tolerance is for methods that solve equations in a step; this one does not.
    ExplicitRK(const Rhs& rhs, double t, std::span<const double> state, double /*tolerance*/ = 0)
        : rhs_(rhs),
          controlled_(rhs.dimension - rhs.extra),
          stride_(std::max((rhs.dimension + pack - 1) / pack * pack, short_stride)),
          memory_(static_cast<std::size_t>(stride_ / pack) * (arrays + tableau.all_stages + tableau.dense_rows)),
          t_(t) {
        if (rhs.dimension > least_for_wide && registers() != Registers::usual)
            kernel_ = {attempt_256, error_norm_256, finite_256};
        std::copy(state.begin(), state.end(), array(y_));
        rate_into(0, t, array(y_));
    }

    double time() const { return t_; }
    double end_time() const { return end_; }
    double length() const { return h_; }
    const double* state() const { return array(y_); }
    const double* rate() const { return stage(0); }
    const double* end_state() const { return array(next_); }
    const double* end_rate() const { return stage(stages); }
    long evaluations() const { return evaluations_; }
    const Rhs& rhs() const { return rhs_; }

    /// The stages of a step to `end` and the state there.
    void attempt(double end) {
        end_ = end;
        h_ = end - t_;
        looked_into_ = false;
        kernel_.attempt(*this);
    }

    double error_norm() { return kernel_.error_norm(*this); }

    /// Moves the end of an attempted step onto its constraints and evaluates the rate again. A component that does
    /// not move keeps its compensation of rounding.
    void correct(const std::function<void(double t, double* state)>& project) {
        std::copy_n(array(next_), rhs_.dimension, array(trial_));
        project(end_, array(next_));
        bool moved = false;
        for (int i = 0; i < rhs_.dimension; ++i) {
            if (array(next_)[i] == array(trial_)[i]) continue;
            array(next_rest_)[i] = 0;
            moved = true;
        }
        if (!moved) return;
        if constexpr (last_stage_in_estimate()) rate_into(stages, end_, array(next_));
    }

    /// Evaluates the rate at the end, unless the estimate has needed it already; false if it is not finite.
    bool finish() {
        if constexpr (!last_stage_in_estimate()) rate_into(stages, end_, array(next_));
        return kernel_.is_finite(*this, stage(stages)) && kernel_.is_finite(*this, array(next_));
    }

    bool starts_finite() const { return kernel_.is_finite(*this, rate()); }

    /// The component responsible for a failure: the first that is not finite at the start or the attempted end,
    /// else the one with the largest error.
    int worst_component() const {
        int worst = 0;
        for (int i = 0; i < controlled_; ++i) {
            if (!std::isfinite(rate()[i] + end_state()[i] + end_rate()[i] + array(error_)[i])) return i;
            if (array(error_)[i] > array(error_)[worst]) worst = i;
        }
        return worst;
    }

    void advance() {
        std::swap(y_, next_);
        std::swap(rest_, next_rest_);
        std::copy_n(stage(stages), rhs_.dimension, stage(0));
        t_ = end_;
    }

    /// The state at t + θ h of a finished step; `out` has Rhs::dimension places.
    void interpolate(double theta, double* out) {
        if (!looked_into_) look_into();
        const double other = 1 - theta;
        const double* const r[2] = {array(difference_), stage(tableau.all_stages)};
        for (int i = 0; i < rhs_.dimension; ++i) {
            const double r1 = r[0][i];
            const double r2 = h_ * rate()[i] - r1;
            const double r3 = r1 - h_ * end_rate()[i] - r2;
            double tail = 0;
            for (int row = tableau.dense_rows - 1; row >= 0; --row)
                tail = r[1][row * stride_ + i] + (row % 2 == 0 ? theta : other) * tail;
            out[i] = state()[i] + theta * (r1 + other * (r2 + theta * (r3 + other * tail)));
        }
    }

private:
    static constexpr int pack = 8;           ///< to so many numbers arrays are padded
    static constexpr int short_stride = 16;  ///< enough for up to 16 components
    static constexpr int least_for_wide =
        8;                            ///< with fewer components what is fresh comes sooner from narrow ones
    static constexpr int arrays = 7;  ///< y, rest, next, next_rest, and the three below
    struct alignas(pack * sizeof(double)) Pack {
        double of[pack] = {};
    };

    /// What depends on the registers of the processor.
    struct Kernel {
        void (*attempt)(ExplicitRK&);
        double (*error_norm)(ExplicitRK&);
        bool (*is_finite)(const ExplicitRK&, const double* values);
    };

    static constexpr bool last_stage_in_estimate() {
        for (const auto& row : tableau.e)
            if (row[stages] != 0) return true;
        return false;
    }

    double* array(int which) { return reinterpret_cast<double*>(memory_.data()) + which * stride_; }
    const double* array(int which) const {
        return reinterpret_cast<const double*>(memory_.data()) + which * stride_;
    }
    double* stage(int i) { return array(arrays + i); }
    const double* stage(int i) const { return array(arrays + i); }

    void rate_into(int i, double t, const double* state) {
        rhs_(t, state, stage(i));
        ++evaluations_;
    }

    template <int i>
    struct StageRow {
        static constexpr int stages = tableau.all_stages;
        static constexpr double weight(int j) { return tableau.a[i][static_cast<std::size_t>(j)]; }
    };
    template <int i>
    struct ErrorRow {
        static constexpr int stages = tableau.all_stages;
        static constexpr double weight(int j) { return tableau.e[i][static_cast<std::size_t>(j)]; }
    };
    template <int i>
    struct DenseRow {
        static constexpr int stages = tableau.all_stages;
        static constexpr double weight(int j) { return tableau.d[i][static_cast<std::size_t>(j)]; }
    };

    /// The arithmetic on registers of so many numbers. No function returns one: how that is done depends on the
    /// processor. `stride`, from one array to the next, is counted in registers.
    template <int width>
    struct Work {
        using Lane = typename RegisterOf<width>::Lane;
        static Lane* lanes(ExplicitRK& s, int which) { return reinterpret_cast<Lane*>(s.array(which)); }
        static const Lane* lanes(const double* from) { return reinterpret_cast<const Lane*>(from); }
        static int blocks(const ExplicitRK& s) { return (s.rhs_.dimension + width - 1) / width; }

        /// Calls `function` with the stride. For short states that is a constant, so that the distances of all
        /// stages from the first are constants, which saves 5 % of the time of a free body.
        template <class Function>
        [[gnu::always_inline]] static void with_stride(const ExplicitRK& s, Function function) {
            if (s.stride_ == short_stride)
                function(std::integral_constant<int, short_stride / width>());
            else
                function(s.stride_ / width);
        }

        template <class Row>
        [[gnu::always_inline]] static void weighted_sum(const Lane* k, auto stride, Lane& sum) {
            StageSums<width>::template weighted_sum<Row>(k, stride, sum);
        }

        /// rest + h Σ_j weight_j k_j, of which stage `fresh` has just been written.
        template <class Row, int fresh>
        [[gnu::always_inline]] static void change(const Lane* k, auto stride, double h, const Lane& rest,
                                                  Lane& sum) {
            weighted_sum<Without<Row, fresh>>(k, stride, sum);
            sum = h * sum + rest;
            StageSums<width>::template add_fresh<Row, fresh>(k, stride, h, sum);
        }

        template <int i>
        [[gnu::always_inline]] static void evaluate(ExplicitRK& s) {
            with_stride(
                s, [&](auto stride) __attribute__((always_inline)) {
                    const Lane *const k = lanes(s, arrays), *const y = lanes(s, s.y_),
                                      *const rest = lanes(s, s.rest_);
                    Lane* const trial = lanes(s, trial_);
                    const double h = s.h_;
                    for (int b = 0; b < blocks(s); ++b) {
                        Lane sum;
                        change<StageRow<i>, i - 1>(k + b, stride, h, rest[b], sum);
                        trial[b] = y[b] + sum;
                    }
                });
            s.rate_into(i, s.t_ + tableau.c[i] * s.h_, s.array(trial_));
        }

        template <int... i>
        [[gnu::always_inline]] static void evaluate_all(ExplicitRK& s, std::integer_sequence<int, i...>) {
            (evaluate<i + 1>(s), ...);
        }

        [[gnu::always_inline]] static void attempt(ExplicitRK& s) {
            evaluate_all(s, std::make_integer_sequence<int, stages - 1>());
            add_up(s);
            if constexpr (last_stage_in_estimate()) s.rate_into(stages, s.end_, s.array(s.next_));
        }

        /// y₁ + rest₁ = y + (rest + h Σ b_j k_j), by Knuth's exact sum of two doubles.
        [[gnu::always_inline]] static void add_up(ExplicitRK& s) {
            with_stride(
                s, [&](auto stride) __attribute__((always_inline)) {
                    const Lane *const k = lanes(s, arrays), *const start = lanes(s, s.y_),
                                      *const rest = lanes(s, s.rest_);
                    Lane *const next = lanes(s, s.next_), *const next_rest = lanes(s, s.next_rest_);
                    for (int b = 0; b < blocks(s); ++b) {
                        Lane added;
                        change<StageRow<stages>, stages - 1>(k + b, stride, s.h_, rest[b], added);
                        const Lane y = start[b], sum = y + added, taken = sum - y;
                        next[b] = sum;
                        next_rest[b] = (y - (sum - taken)) + (added - taken);
                    }
                });
        }

        /// The squared errors of block b, in units of max(1, |y_i|).
        [[gnu::always_inline]] static void squared_error(ExplicitRK& s, auto stride, int b, Lane& square) {
            const Lane *const k = lanes(s, arrays) + b, y = lanes(s, s.y_)[b], next = lanes(s, s.next_)[b];
            const Lane size = y > -y ? y : -y, next_size = next > -next ? next : -next, one = Lane{} + 1;
            Lane scale = size > next_size ? size : next_size;
            scale = s.h_ / (scale > one ? scale : one);
            Lane error;
            weighted_sum<ErrorRow<0>>(k, stride, error);
            error = scale * error;
            square = error * error;
            if constexpr (tableau.error_rows == 2) {
                Lane third;
                weighted_sum<ErrorRow<tableau.error_rows - 1>>(k, stride, third);
                third = scale * third;
                constexpr double tiny = 1e-300;  // 0/0 is 0
                square = square * (square / (square + 0.01 * third * third + tiny));
            }
        }

        [[gnu::always_inline]] static double error_norm(ExplicitRK& s) {
            Lane* const errors = lanes(s, error_);
            with_stride(
                s, [&](auto stride) __attribute__((always_inline)) {
                    for (int b = 0; b < blocks(s); ++b) squared_error(s, stride, b, errors[b]);
                });
            const Lane* const next = lanes(s, s.next_);
            Lane most{}, zeros{};
            int i = 0;
            for (; i + width <= s.controlled_; i += width) {
                const Lane square = errors[i / width];
                most = square > most ? square : most;
                zeros += (square + next[i / width]) * 0;
            }
            double largest = 0, zero = 0;
            for (int j = 0; j < width; ++j) largest = std::max(largest, most[j]), zero += zeros[j];
            for (; i < s.controlled_; ++i) {
                largest = std::max(largest, s.array(error_)[i]);
                zero += (s.array(error_)[i] + s.end_state()[i]) * 0;
            }
            return zero == 0 ? std::sqrt(largest) : HUGE_VAL;
        }

        [[gnu::always_inline]] static bool is_finite(const ExplicitRK& s, const double* values) {
            Lane zeros{};
            int i = 0;
            for (; i + width <= s.controlled_; i += width) zeros += lanes(values)[i / width] * 0;
            double zero = 0;
            for (int j = 0; j < width; ++j) zero += zeros[j];
            for (; i < s.controlled_; ++i) zero += values[i] * 0;
            return zero == 0;
        }
    };

    static void attempt_any(ExplicitRK& step) { Work<2>::attempt(step); }
    static double error_norm_any(ExplicitRK& step) {
        if constexpr (has_fixed_step)
            return 0;
        else
            return Work<2>::error_norm(step);
    }
    static bool finite_any(const ExplicitRK& step, const double* values) {
        return Work<2>::is_finite(step, values);
    }
    ALEMBERT_WIDE_SAME_DIGITS static void attempt_256(ExplicitRK& step) { Work<4>::attempt(step); }
    ALEMBERT_WIDE_SAME_DIGITS static double error_norm_256(ExplicitRK& step) {
        if constexpr (has_fixed_step)
            return 0;
        else
            return Work<4>::error_norm(step);
    }
    ALEMBERT_WIDE_SAME_DIGITS static bool finite_256(const ExplicitRK& step, const double* values) {
        return Work<4>::is_finite(step, values);
    }

    /// Computes the additional stages and the rows of dense output.
    void look_into() {
        using Narrow = Work<2>;
        repeat<tableau.all_stages - stages - 1>(
            [&]<int i>() { Narrow::template evaluate<stages + 1 + i>(*this); });
        for (int i = 0; i < rhs_.dimension; ++i)
            array(difference_)[i] = (array(next_)[i] - array(y_)[i]) + (array(next_rest_)[i] - array(rest_)[i]);
        repeat<tableau.dense_rows>([&]<int row>() {
            auto* const out = Narrow::lanes(*this, arrays + tableau.all_stages + row);
            for (int b = 0; b < Narrow::blocks(*this); ++b) {
                typename Narrow::Lane sum;
                Narrow::template weighted_sum<DenseRow<row>>(Narrow::lanes(*this, arrays) + b, stride_ / 2, sum);
                out[b] = h_ * sum;
            }
        });
        looked_into_ = true;
    }

    const Rhs& rhs_;
    int controlled_;  ///< number of components under error control
    int stride_;      ///< numbers from one array to the next
    std::vector<Pack> memory_;
    Kernel kernel_{attempt_any, error_norm_any, finite_any};
    int y_ = 0, rest_ = 1, next_ = 2,
        next_rest_ = 3;  ///< places of the arrays in memory; those of y and next are exchanged after a step
    static constexpr int trial_ = 4, difference_ = 5, error_ = 6;
    double t_, end_ = 0, h_ = 0;
    long evaluations_ = 0;
    bool looked_into_ = false;
};

}  // namespace alembert
