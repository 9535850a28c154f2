// SPDX-License-Identifier: MIT
#pragma once

/// Least and greatest value and mean over time of each component of a state, along one motion.
///
///     RunningExtrema along(coordinates, size);
///     along(t, state, rate);          // at the start and after each step
///     along.values();                 // the least of each, then the greatest, then the means
///
/// Between two steps a component is the polynomial that has its values and rates there: of third degree, and for a
/// coordinate whose rate is a speed, and whose second derivatives are known by this, of fifth degree. Its error
/// falls with the fourth or sixth power of the step. An extreme value inside a step is found if the rate changes
/// its sign there.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace alembert {

class RunningExtrema {
public:
    /// Into how many pieces a step of a power series is divided, which is several times as long as others.
    static constexpr int pieces_of_series = 16;

    RunningExtrema() = default;
    RunningExtrema(int coordinates, int size)
        : coordinates_(static_cast<std::size_t>(coordinates)),
          least_(static_cast<std::size_t>(size), HUGE_VAL),
          greatest_(static_cast<std::size_t>(size), -HUGE_VAL),
          integral_(static_cast<std::size_t>(size)) {}

    void operator()(double t, const double* state, const double* rate) {
        const std::size_t size = least_.size();
        if (!state_.empty() && t > t_)
            for (std::size_t i = 0; i < size; ++i) add_piece(i, t - t_, state, rate);
        for (std::size_t i = 0; i < size; ++i) note(i, state[i]);
        state_.assign(state, state + size);
        rate_.assign(rate, rate + size);
        if (!has_begun_) begin_ = t;
        has_begun_ = true;
        t_ = t;
    }

    std::vector<double> values() const {
        if (!has_begun_) return std::vector<double>(3 * least_.size(), NAN);
        std::vector<double> result = least_;
        result.insert(result.end(), greatest_.begin(), greatest_.end());
        for (std::size_t i = 0; i < integral_.size(); ++i)
            result.push_back(t_ > begin_ ? integral_[i] / (t_ - begin_) : state_[i]);
        return result;
    }

private:
    using Polynomial = std::array<double, 6>;  ///< in the part of the step, from 0 to 1

    void note(std::size_t i, double value) {
        least_[i] = std::min(least_[i], value);
        greatest_[i] = std::max(greatest_[i], value);
    }

    void add_piece(std::size_t i, double h, const double* state, const double* rate) {
        const Polynomial p = between(i, h, state, rate);
        double mean = 0;
        for (std::size_t k = p.size(); k-- > 0;) mean += p[k] / static_cast<double>(k + 1);
        integral_[i] += h * mean;
        if ((rate_[i] < 0) == (rate[i] < 0)) return;
        double low = 0, high = 1;  // the slope has the sign of the start at `low` and that of the end at `high`
        for (int halving = 0; halving < 50; ++halving) {
            const double middle = (low + high) / 2;
            ((slope(p, middle) < 0) == (rate_[i] < 0) ? low : high) = middle;
        }
        note(i, value(p, (low + high) / 2));
    }

    Polynomial between(std::size_t i, double h, const double* state, const double* rate) const {
        const std::size_t n = coordinates_;
        const bool has_second =
            i < n && 2 * n == least_.size() && rate_[i] == state_[n + i] && rate[i] == state[n + i];
        const double a = h * rate_[i];
        if (!has_second) {
            const double change = state[i] - state_[i] - a, turn = h * rate[i] - a;
            return {state_[i], a, 3 * change - turn, turn - 2 * change, 0, 0};
        }
        const double b = h * h * rate_[n + i] / 2, change = state[i] - state_[i] - a - b,
                     turn = h * rate[i] - a - 2 * b, bend = h * h * rate[n + i] - 2 * b;
        return {state_[i],
                a,
                b,
                10 * change - 4 * turn + bend / 2,
                -15 * change + 7 * turn - bend,
                6 * change - 3 * turn + bend / 2};
    }

    static double value(const Polynomial& p, double x) {
        double sum = 0;
        for (std::size_t k = p.size(); k-- > 0;) sum = sum * x + p[k];
        return sum;
    }
    static double slope(const Polynomial& p, double x) {
        double sum = 0;
        for (std::size_t k = p.size(); k-- > 1;) sum = sum * x + static_cast<double>(k) * p[k];
        return sum;
    }

    std::size_t coordinates_ = 0;
    std::vector<double> least_, greatest_, integral_, state_, rate_;
    double begin_ = 0, t_ = 0;
    bool has_begun_ = false;
};

}  // namespace alembert
