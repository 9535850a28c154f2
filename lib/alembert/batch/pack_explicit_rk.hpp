// SPDX-License-Identifier: MIT
#pragma once

/// One step of an explicit Runge-Kutta method for eight systems side by side: explicit_rk.hpp with a lane for each
/// system, which has its own time, step and parameters.
///
///     PackStep<dop853_tableau> step(module, dimension, extra);
///     step.put(lane, t, state, rate, par);     // for each lane
///     step.end = ...;                          // a time in each lane; where it is the lane's own t nothing moves
///     step.attempt();
///     step.misfit[lane];                       // the largest error; infinite if something is not finite
///     // rates at the ends; step.misfit becomes infinite where they are not finite
///     step.finish();
///     step.advance(accepted);                  // bit i: the end of lane i becomes its start
///
/// The arithmetic and its order are those of explicit_rk.hpp, sums of two doubles included. It is compiled for
/// AVX-512, for AVX2 and for any x86-64, and the version that suits the processor is chosen when a PackStep is
/// made.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "alembert/batch/packs.hpp"
#include "alembert/native/cpu_features.hpp"
#include "alembert/ode/tableau.hpp"

namespace alembert {

template <const auto& tableau>
class PackStep {
    using Wide [[gnu::vector_size(lanes * sizeof(double)), gnu::may_alias]] = double;
    using Bits [[gnu::vector_size(lanes * sizeof(double)), gnu::may_alias]] = long long;
    static constexpr int stages = tableau.stages;

public:
    static constexpr bool has_fixed_step = tableau.error_rows == 0;
    static constexpr int estimate_order = tableau.estimate_order;
    static constexpr int most_evaluations = tableau.all_stages;
    /// Of an attempt, as in explicit_rk.hpp: the last stage counts only if the step is finished, unless the
    /// estimate needs it.
    static constexpr int evaluations(bool was_finished) {
        return tableau.stages - (was_finished || last_stage_in_estimate() ? 0 : 1);
    }

    PackStep(const Module& module, int dimension, int extra)
        : pack_(*module.pack()),
          dimension_(dimension),
          controlled_(dimension - extra),
          par_(static_cast<std::size_t>(module.table().parameters + module.table().constants)),
          memory_(static_cast<std::size_t>(dimension) * (arrays + stages + 1)) {
#if defined(__x86_64__)
        if (registers() == Registers::widest)
            kernel_ = {attempt_512, finish_512, advance_512};
        else if (registers() == Registers::wide)
            kernel_ = {attempt_256, finish_256, advance_256};
#endif
    }

    void put(int lane, double t, const double* state, const double* rate, const std::vector<double>& par) {
        time[lane] = end[lane] = t;
        for (int i = 0; i < dimension_; ++i) {
            array(y_)[i][lane] = state[i];
            array(rest_)[i][lane] = 0;
            stage(0)[i][lane] = rate[i];
        }
        for (std::size_t i = 0; i < par.size(); ++i) par_[i][lane] = par[i];
    }

    void attempt() {
        kernel_.attempt(*this);
    }
    void finish() {
        kernel_.finish(*this);
    }
    void advance(unsigned accepted) {
        kernel_.advance(*this, accepted);
    }

    double state(int component, int lane) const {
        return array(y_)[component][lane];
    }

    /// At the start of the lane's next step.
    double rate(int component, int lane) const {
        return stage(0)[component][lane];
    }

    /// T, V, E and power, then Jacobi's integral, at the start of every lane.
    void energies(Lanes (&energy)[5]) const {
        pack_.energy(reals(&time), reals(array(y_)), reals(stage(0)), reals(par_.data()), reals(energy),
                     reals(&energy[4]));
    }

    Lanes time, end, misfit;

private:
    static constexpr bool last_stage_in_estimate() {
        for (const auto& row : tableau.e)
            if (row[stages] != 0) return true;
        return false;
    }

    struct Kernel {
        void (*attempt)(PackStep&);
        void (*finish)(PackStep&);
        void (*advance)(PackStep&, unsigned accepted);
    };

    static constexpr int arrays = 5;
    static constexpr int y_ = 0, rest_ = 1, next_ = 2, next_rest_ = 3, trial_ = 4;
    Lanes* array(int which) {
        return memory_.data() + which * dimension_;
    }
    const Lanes* array(int which) const {
        return memory_.data() + which * dimension_;
    }
    Lanes* stage(int i) {
        return array(arrays + i);
    }
    const Lanes* stage(int i) const {
        return array(arrays + i);
    }
    Wide* wide(int which) {
        return reinterpret_cast<Wide*>(array(which));
    }
    static Wide& wide(Lanes& one) {
        return reinterpret_cast<Wide&>(one);
    }

    void rate_into(int i, const Lanes& t, int state) {
        pack_.rhs(reals(&t), reals(array(state)), reals(par_.data()), reals(stage(i)));
        if (dimension_ == controlled_) return;
        Lanes energy[5];  // the quadrature is the work of the power
        pack_.energy(reals(&t), reals(array(state)), reals(stage(i)), reals(par_.data()), reals(energy),
                     reals(&energy[4]));
        stage(i)[controlled_] = energy[3];
    }

    /// Σ_j row_j k_j of component b, over the weights that are not zero.
    template <const auto& row, int... j>
    [[gnu::always_inline]] static void weighted_sum(const Wide* k, int dimension, int b, Wide& sum,
                                                    std::integer_sequence<int, j...>) {
        sum = Wide{};
        ((row[j] != 0 ? void(sum += row[j] * k[j * dimension + b]) : void()), ...);
    }
    template <int i>
    struct Stage {
        static constexpr auto row = tableau.a[i];
    };
    template <int i>
    struct Error {
        static constexpr auto row = tableau.e[i];
    };
    using Solution = std::make_integer_sequence<int, stages>;
    using Estimate = std::make_integer_sequence<int, stages + 1>;

    template <int i>
    [[gnu::always_inline]] void evaluate(const Wide& t, const Wide& h) {
        const Wide *const k = wide(arrays), *const y = wide(y_), *const rest = wide(rest_);
        Wide* const trial = wide(trial_);
        for (int b = 0; b < dimension_; ++b) {
            Wide sum;
            weighted_sum<Stage<i>::row>(k, dimension_, b, sum, std::make_integer_sequence<int, i>());
            trial[b] = y[b] + (h * sum + rest[b]);
        }
        Lanes at;
        wide(at) = t + tableau.c[i] * h;
        rate_into(i, at, trial_);
    }

    template <int... i>
    [[gnu::always_inline]] void evaluate_all(const Wide& t, const Wide& h, std::integer_sequence<int, i...>) {
        (evaluate<i + 1>(t, h), ...);
    }

    [[gnu::always_inline]] void attempt_here() {
        const Wide t = wide(time), h = wide(end) - t;
        evaluate_all(t, h, std::make_integer_sequence<int, stages - 1>());
        const Wide *const k = wide(arrays), *const start = wide(y_), *const rest = wide(rest_);
        Wide *const ends = wide(next_), *const ends_rest = wide(next_rest_);
        for (int b = 0; b < dimension_; ++b) {
            Wide sum;
            weighted_sum<Stage<stages>::row>(k, dimension_, b, sum, Solution());
            const Wide y = start[b], change = h * sum + rest[b], next = y + change, taken = next - y;
            ends[b] = next;
            ends_rest[b] = (y - (next - taken)) + (change - taken);
        }
        if constexpr (last_stage_in_estimate()) rate_into(stages, end, next_);
        misfit = {};
        if constexpr (!has_fixed_step) measure(h);
    }

    /// The error is measured component by component as in explicit_rk.hpp; it is infinite if something is not
    /// finite.
    [[gnu::always_inline]] void measure(const Wide& h) {
        const Wide *const k = wide(arrays), *const y = wide(y_), *const next = wide(next_);
        const Wide none{}, one = none + 1;
        Wide largest{}, zero{};
        for (int b = 0; b < controlled_; ++b) {
            const Wide size0 = y[b] < 0 ? -y[b] : y[b], size1 = next[b] < 0 ? -next[b] : next[b];
            Wide scale = size0 > size1 ? size0 : size1;
            scale = h / (scale > 1 ? scale : one);
            Wide error, square;
            weighted_sum<Error<0>::row>(k, dimension_, b, error, Estimate());
            error *= scale;
            square = error * error;
            if constexpr (tableau.error_rows == 2) {
                Wide third;
                weighted_sum<Error<tableau.error_rows - 1>::row>(k, dimension_, b, third, Estimate());
                third *= scale;
                square *= square / (square + 0.01 * third * third + 1e-300);
            }
            largest = square > largest ? square : largest;
            zero += (square + next[b]) * 0;
        }
        wide(misfit) = zero == 0 ? largest : none + HUGE_VAL;
        for (int lane = 0; lane < lanes; ++lane) misfit[lane] = std::sqrt(misfit[lane]);
    }

    [[gnu::always_inline]] void finish_here() {
        if constexpr (!last_stage_in_estimate()) rate_into(stages, end, next_);
        const Wide *const rate = wide(arrays + stages), *const next = wide(next_);
        Wide zero{};
        for (int b = 0; b < controlled_; ++b) zero += (rate[b] + next[b]) * 0;
        wide(misfit) = zero == 0 ? wide(misfit) : Wide{} + HUGE_VAL;
    }

    [[gnu::always_inline]] void advance_here(unsigned accepted) {
        Bits take;
        for (int lane = 0; lane < lanes; ++lane) take[lane] = -static_cast<long long>(accepted >> lane & 1U);
        Wide *const y = wide(y_), *const rest = wide(rest_), *const first = wide(arrays);
        const Wide *const next = wide(next_), *const next_rest = wide(next_rest_),
                          *const last = wide(arrays + stages);
        for (int b = 0; b < dimension_; ++b) {
            y[b] = take ? next[b] : y[b];
            rest[b] = take ? next_rest[b] : rest[b];
            first[b] = take ? last[b] : first[b];
        }
        wide(time) = take ? wide(end) : wide(time);
    }

    static void attempt_any(PackStep& step) {
        step.attempt_here();
    }
    static void finish_any(PackStep& step) {
        step.finish_here();
    }
    static void advance_any(PackStep& step, unsigned accepted) {
        step.advance_here(accepted);
    }
#if defined(__x86_64__)
    ALEMBERT_WIDE static void attempt_256(PackStep& step) {
        step.attempt_here();
    }
    ALEMBERT_WIDE static void finish_256(PackStep& step) {
        step.finish_here();
    }
    ALEMBERT_WIDE static void advance_256(PackStep& step, unsigned accepted) {
        step.advance_here(accepted);
    }
    ALEMBERT_WIDEST static void attempt_512(PackStep& step) {
        step.attempt_here();
    }
    ALEMBERT_WIDEST static void finish_512(PackStep& step) {
        step.finish_here();
    }
    ALEMBERT_WIDEST static void advance_512(PackStep& step, unsigned accepted) {
        step.advance_here(accepted);
    }
#endif

    const alembert_pack_table& pack_;
    int dimension_, controlled_;
    std::vector<Lanes> par_, memory_;
    Kernel kernel_{attempt_any, finish_any, advance_any};
};

}  // namespace alembert
