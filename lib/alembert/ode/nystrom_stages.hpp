// SPDX-License-Identifier: MIT
#pragma once

/// The stages of a Runge-Kutta-Nyström method (nystrom_tableau.hpp) and what they add up to.
///
///     NystromStages<rkn86_tableau> stages(n, size);
///     stages.reach(ends, {.t = t, .q = q, .v = v, .a = a, .rest = rest}, h);
///     stages.change()[i], stages.rate_change()[i]      // of position and rate i < n in h
///
/// Only positions are made for stages, so that these take half the sums of a method for first-order systems. The
/// rates of trial states are not those of the motion, and neither are those of quadratures, which stand behind
/// them.

#include <algorithm>
#include <type_traits>
#include <utility>
#include <vector>

#include "alembert/native/registers.hpp"
#include "alembert/ode/formula_stepper.hpp"
#include "alembert/ode/nystrom_tableau.hpp"
#include "alembert/ode/stage_sums.hpp"

namespace alembert {

/// Positions, rates and accelerations at a time; `rest` is added to the positions, and may be null.
struct NystromStart {
    double t;
    const double *q, *v, *a, *rest;
};

template <const auto& tableau>
class NystromStages {
    static constexpr int stages = tableau.stages;

public:
    /// `size`: of the state, quadratures included; `n`: positions.
    NystromStages(int n, int size)
        : n_(n),
          size_(size),
          room_(rounded_up(n)),
          stride_(rounded_up(size) + pack),
          first_((arrays + 1) * room_ + rounded_up(size) + pack),
          memory_(static_cast<std::size_t>((first_ + stages * stride_) / pack)) {
        if (registers() != Registers::usual && n > least_for_wide) kernel_ = reach_256;
    }

    /// Takes one evaluation for each stage but the first.
    void reach(Ends& ends, const NystromStart& from, double h) {
        t_ = from.t;
        std::copy_n(from.q, n_, array(q_));
        std::copy_n(from.v, n_, array(v_));
        std::copy_n(from.a, n_, accelerations(0));
        if (from.rest != nullptr)
            std::copy_n(from.rest, n_, array(rest_));
        else
            std::fill_n(array(rest_), n_, 0.0);
        kernel_(*this, ends, h);
    }

    const double* change() const { return array(change_); }
    const double* rate_change() const { return array(rate_change_); }
    const double* error() const { return array(error_); }
    const double* rate_error() const { return array(rate_error_); }
    /// The accelerations at the end, if the tableau ends with them.
    const double* last_accelerations() const { return accelerations(stages - 1); }

private:
    static constexpr int pack = 8;            ///< to so many numbers arrays are padded
    static constexpr int short_stride = 16;   ///< of up to 8 components
    static constexpr int least_for_wide = 4;  ///< with fewer what is fresh comes sooner from narrow registers
    struct alignas(pack * sizeof(double)) Pack {
        double of[pack] = {};
    };
    // The arrays of positions in memory: of the start, and what a step changes, with its estimated errors.
    static constexpr int q_ = 0, v_ = 1, rest_ = 2, change_ = 3, rate_change_ = 4, error_ = 5, rate_error_ = 6;
    static constexpr int arrays = 7;

    static constexpr int rounded_up(int count) { return (count + pack - 1) / pack * pack; }

    [[gnu::always_inline]] const double* array(int which) const {
        return reinterpret_cast<const double*>(memory_.data()) + which * room_;
    }
    [[gnu::always_inline]] double* array(int which) {
        return reinterpret_cast<double*>(memory_.data()) + which * room_;
    }
    [[gnu::always_inline]] double* trial() { return array(arrays); }
    /// Stages are rates as the right-hand side writes them, placed so that accelerations begin with a register.
    [[gnu::always_inline]] const double* accelerations(int stage) const {
        return array(0) + first_ + stage * stride_;
    }
    [[gnu::always_inline]] double* accelerations(int stage) { return array(0) + first_ + stage * stride_; }
    [[gnu::always_inline]] double* stage(int i) { return accelerations(i) - n_; }

    template <int i>
    struct StageRow {
        static constexpr int stages = tableau.stages;
        static constexpr double weight(int j) {
            return tableau.a[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
        }
    };
    using Table = std::remove_cvref_t<decltype(tableau)>;
    template <typename Table::Row Table::*row>
    struct Weights {
        static constexpr int stages = tableau.stages;
        static constexpr double weight(int j) { return (tableau.*row)[static_cast<std::size_t>(j)]; }
    };

    /// The arithmetic on registers of so many numbers.
    template <int width>
    struct Work {
        using Sums = StageSums<width>;
        using Lane = typename Sums::Lane;
        static Lane* lanes(double* from) { return reinterpret_cast<Lane*>(from); }

        template <int i>
        [[gnu::always_inline]] static void evaluate(NystromStages& s, Ends& ends, double h, auto stride) {
            constexpr double c = tableau.c[static_cast<std::size_t>(i)];
            const Lane *const k = lanes(s.accelerations(0)), *const q = lanes(s.array(q_)),
                              *const v = lanes(s.array(v_)), *const rest = lanes(s.array(rest_));
            Lane* const trial = lanes(s.trial());
            for (int b = 0; b * width < s.n_; ++b) {
                Lane sum;
                Sums::template weighted_sum<Without<StageRow<i>, i - 1>>(k + b, stride, sum);
                sum = h * (c * v[b] + h * sum) + rest[b];
                Sums::template add_fresh<StageRow<i>, i - 1>(k + b, stride, h * h, sum);
                trial[b] = q[b] + sum;
            }
            ends.evaluate(s.t_ + c * h, s.trial(), s.stage(i));
        }

        [[gnu::always_inline]] static void add_up(NystromStages& s, double h, auto stride) {
            const Lane *const k = lanes(s.accelerations(0)), *const v = lanes(s.array(v_));
            for (int b = 0; b * width < s.n_; ++b) {
                Lane sum;
                Sums::template weighted_sum<Weights<&Table::b>>(k + b, stride, sum);
                lanes(s.array(change_))[b] = h * (v[b] + h * sum);
                Sums::template weighted_sum<Weights<&Table::b_rate>>(k + b, stride, sum);
                lanes(s.array(rate_change_))[b] = h * sum;
                Sums::template weighted_sum<Weights<&Table::e>>(k + b, stride, sum);
                lanes(s.array(error_))[b] = h * h * sum;
                Sums::template weighted_sum<Weights<&Table::e_rate>>(k + b, stride, sum);
                lanes(s.array(rate_error_))[b] = h * sum;
            }
        }

        template <int... i>
        [[gnu::always_inline]] static void all(NystromStages& s, Ends& ends, double h, auto stride,
                                               std::integer_sequence<int, i...>) {
            (evaluate<i + 1>(s, ends, h, stride), ...);
            add_up(s, h, stride);
        }

        /// For short states the distances of all stages are constants.
        [[gnu::always_inline]] static void reach(NystromStages& s, Ends& ends, double h) {
            constexpr auto each = std::make_integer_sequence<int, stages - 1>();
            if (s.stride_ == short_stride)
                all(s, ends, h, std::integral_constant<int, short_stride / width>(), each);
            else
                all(s, ends, h, s.stride_ / width, each);
        }
    };

    static void reach_any(NystromStages& s, Ends& ends, double h) { Work<2>::reach(s, ends, h); }
    ALEMBERT_WIDE_SAME_DIGITS static void reach_256(NystromStages& s, Ends& ends, double h) {
        Work<4>::reach(s, ends, h);
    }

    int n_, size_;
    int room_, stride_;  ///< of an array of positions; from one stage to the next
    int first_;          ///< where the accelerations of the first stage stand
    double t_ = 0;
    std::vector<Pack> memory_;
    void (*kernel_)(NystromStages&, Ends&, double) = reach_any;
};

}  // namespace alembert
