// SPDX-License-Identifier: MIT
#pragma once

/// One step of an explicit Runge-Kutta method for eight systems side by side: explicit_rk.hpp with a lane for each
/// system, which has its own time, step and parameters.
///
///     PackExplicitRK<dop853_tableau> step(module, dimension, extra);
///     step.put(lane, t, state, rate, par);     // for each lane
///     step.end = ...;                          // a time in each lane; where it is the lane's own t nothing moves
///     step.attempt();
///     step.error_norm[lane];                   // the largest error; infinite if something is not finite
///     // rates at the ends; step.error_norm becomes infinite where they are not finite
///     step.finish();
///     step.advance(accepted);                  // bit i: the end of lane i becomes its start
///
/// The arithmetic and its order are those of explicit_rk.hpp, sums of two doubles included. It is compiled for
/// AVX-512, for AVX2 and for any x86-64, and the version that suits the processor is chosen when a PackExplicitRK
/// is made.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "alembert/batch/pack_pieces.hpp"
#include "alembert/native/registers.hpp"
#include "alembert/ode/tableau.hpp"

namespace alembert {

template <const auto& tableau>
class PackExplicitRK {
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

    PackExplicitRK(const Module& module, int dimension, int extra)
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

    Lanes time, end, error_norm;

private:
    static constexpr bool last_stage_in_estimate() {
        for (const auto& row : tableau.e)
            if (row[stages] != 0) return true;
        return false;
    }

    struct Kernel {
        void (*attempt)(PackExplicitRK&);
        void (*finish)(PackExplicitRK&);
        void (*advance)(PackExplicitRK&, unsigned accepted);
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
    void rate_into(int i, const Lanes& t, int state) {
        pack_.rhs(reals(&t), reals(array(state)), reals(par_.data()), reals(stage(i)));
        if (dimension_ == controlled_) return;
        Lanes energy[5];  // the quadrature is the work of the power
        pack_.energy(reals(&t), reals(array(state)), reals(stage(i)), reals(par_.data()), reals(energy),
                     reals(&energy[4]));
        stage(i)[controlled_] = energy[3];
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

    /// The arithmetic on vectors of so many lanes. A place is one of a component and of a piece of its lanes.
    template <int width>
    struct Work {
        using Pieces = PackPieces<width>;
        using Wide = typename Pieces::Reals;
        using Bits = typename Pieces::Bits;
        static constexpr int pieces = Pieces::pieces;
        static Wide* wide(PackExplicitRK& s, int which) { return Pieces::in(s.array(which)); }
        static Wide* wide(Lanes& one) { return Pieces::in(&one); }

        /// Σ_j row_j k_j at a place, over the weights that are not zero.
        template <const auto& row, int... j>
        [[gnu::always_inline]] static void weighted_sum(const Wide* k, int places, int at, Wide& sum,
                                                        std::integer_sequence<int, j...>) {
            sum = Wide{};
            ((row[j] != 0 ? void(sum += row[j] * k[j * places + at]) : void()), ...);
        }

        template <int i>
        [[gnu::always_inline]] static void evaluate(PackExplicitRK& s) {
            const Wide *const k = wide(s, arrays), *const y = wide(s, y_), *const rest = wide(s, rest_);
            Wide* const trial = wide(s, trial_);
            const int places = s.dimension_ * pieces;
            Lanes at;
            for (int piece = 0; piece < pieces; ++piece) {
                const Wide t = wide(s.time)[piece], h = wide(s.end)[piece] - t;
                wide(at)[piece] = t + tableau.c[i] * h;
                for (int b = piece; b < places; b += pieces) {
                    Wide sum;
                    weighted_sum<Stage<i>::row>(k, places, b, sum, std::make_integer_sequence<int, i>());
                    trial[b] = y[b] + (h * sum + rest[b]);
                }
            }
            s.rate_into(i, at, trial_);
        }

        template <int... i>
        [[gnu::always_inline]] static void evaluate_all(PackExplicitRK& s, std::integer_sequence<int, i...>) {
            (evaluate<i + 1>(s), ...);
        }

        [[gnu::always_inline]] static void attempt(PackExplicitRK& s) {
            evaluate_all(s, std::make_integer_sequence<int, stages - 1>());
            const Wide *const k = wide(s, arrays), *const start = wide(s, y_), *const rest = wide(s, rest_);
            Wide *const ends = wide(s, next_), *const ends_rest = wide(s, next_rest_);
            const int places = s.dimension_ * pieces;
            for (int piece = 0; piece < pieces; ++piece) {
                const Wide h = wide(s.end)[piece] - wide(s.time)[piece];
                for (int b = piece; b < places; b += pieces) {
                    Wide sum;
                    weighted_sum<Stage<stages>::row>(k, places, b, sum, Solution());
                    const Wide y = start[b], change = h * sum + rest[b], next = y + change, taken = next - y;
                    ends[b] = next;
                    ends_rest[b] = (y - (next - taken)) + (change - taken);
                }
            }
            if constexpr (last_stage_in_estimate()) s.rate_into(stages, s.end, next_);
            s.error_norm = {};
            if constexpr (!has_fixed_step)
                for (int piece = 0; piece < pieces; ++piece) measure(s, piece);
        }

        /// The error is measured component by component as in explicit_rk.hpp; it is infinite if something is not
        /// finite.
        [[gnu::always_inline]] static void measure(PackExplicitRK& s, int piece) {
            const Wide *const k = wide(s, arrays), *const y = wide(s, y_), *const next = wide(s, next_);
            const Wide h = wide(s.end)[piece] - wide(s.time)[piece], none{}, one = none + 1;
            const int places = s.dimension_ * pieces;
            Wide largest{}, zero{};
            for (int b = piece; b < s.controlled_ * pieces; b += pieces) {
                const Wide size0 = y[b] < 0 ? -y[b] : y[b], size1 = next[b] < 0 ? -next[b] : next[b];
                Wide scale = size0 > size1 ? size0 : size1;
                scale = h / (scale > 1 ? scale : one);
                Wide error, square;
                weighted_sum<Error<0>::row>(k, places, b, error, Estimate());
                error *= scale;
                square = error * error;
                if constexpr (tableau.error_rows == 2) {
                    Wide third;
                    weighted_sum<Error<tableau.error_rows - 1>::row>(k, places, b, third, Estimate());
                    third *= scale;
                    square *= square / (square + 0.01 * third * third + 1e-300);
                }
                largest = square > largest ? square : largest;
                zero += (square + next[b]) * 0;
            }
            wide(s.error_norm)[piece] = zero == 0 ? largest : none + HUGE_VAL;
            for (int lane = piece * width; lane < (piece + 1) * width; ++lane)
                s.error_norm[lane] = std::sqrt(s.error_norm[lane]);
        }

        [[gnu::always_inline]] static void finish(PackExplicitRK& s) {
            if constexpr (!last_stage_in_estimate()) s.rate_into(stages, s.end, next_);
            const Wide *const rate = wide(s, arrays + stages), *const next = wide(s, next_);
            for (int piece = 0; piece < pieces; ++piece) {
                Wide zero{};
                for (int b = piece; b < s.controlled_ * pieces; b += pieces) zero += (rate[b] + next[b]) * 0;
                Wide& error_norm = wide(s.error_norm)[piece];
                error_norm = zero == 0 ? error_norm : Wide{} + HUGE_VAL;
            }
        }

        [[gnu::always_inline]] static void advance(PackExplicitRK& s, unsigned accepted) {
            Wide *const y = wide(s, y_), *const rest = wide(s, rest_), *const first = wide(s, arrays);
            const Wide *const next = wide(s, next_), *const next_rest = wide(s, next_rest_),
                              *const last = wide(s, arrays + stages);
            for (int piece = 0; piece < pieces; ++piece) {
                Bits take;
                for (int lane = 0; lane < width; ++lane)
                    take[lane] = -static_cast<long long>(accepted >> (piece * width + lane) & 1U);
                for (int b = piece; b < s.dimension_ * pieces; b += pieces) {
                    y[b] = take ? next[b] : y[b];
                    rest[b] = take ? next_rest[b] : rest[b];
                    first[b] = take ? last[b] : first[b];
                }
                Wide& time = wide(s.time)[piece];
                time = take ? wide(s.end)[piece] : time;
            }
        }
    };

    static void attempt_any(PackExplicitRK& step) {
        Work<2>::attempt(step);
    }
    static void finish_any(PackExplicitRK& step) {
        Work<2>::finish(step);
    }
    static void advance_any(PackExplicitRK& step, unsigned accepted) {
        Work<2>::advance(step, accepted);
    }
#if defined(__x86_64__)
    ALEMBERT_WIDE static void attempt_256(PackExplicitRK& step) {
        Work<4>::attempt(step);
    }
    ALEMBERT_WIDE static void finish_256(PackExplicitRK& step) {
        Work<4>::finish(step);
    }
    ALEMBERT_WIDE static void advance_256(PackExplicitRK& step, unsigned accepted) {
        Work<4>::advance(step, accepted);
    }
    ALEMBERT_WIDEST static void attempt_512(PackExplicitRK& step) {
        Work<8>::attempt(step);
    }
    ALEMBERT_WIDEST static void finish_512(PackExplicitRK& step) {
        Work<8>::finish(step);
    }
    ALEMBERT_WIDEST static void advance_512(PackExplicitRK& step, unsigned accepted) {
        Work<8>::advance(step, accepted);
    }
#endif

    const alembert_pack_table& pack_;
    int dimension_, controlled_;
    std::vector<Lanes> par_, memory_;
    Kernel kernel_{attempt_any, finish_any, advance_any};
};

}  // namespace alembert
