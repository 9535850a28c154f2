// SPDX-License-Identifier: MIT
#pragma once

/// How long the next step should be.
///
///     StepSize control(8);                        // the error estimate goes with h⁸
///     h = control.after_accepted(h, error_norm / tolerance);
///     h = control.after_rejected(h, error_norm / tolerance);
///
/// PI control (Gustafsson, ACM Trans. Math. Softw. 17 (1991) 533-554; Hairer & Wanner, Solving ODEs II, §IV.2;
/// Hairer, Nørsett, Wanner, Solving ODEs I, §II.4):
///
///     h_{n+1} = h_n · 0.8 · ε_n^(−α) · ε_{n−1}^β,   ε = error_norm / tolerance,   β = 0.2/k,   α = 1/k − 0.75 β
///
/// limited to between 0.2 and 6 times h, and to at most h after a rejection. k is the order of the estimate: β =
/// 0.04 for dopri5, as in these books. The factors 0.8 (there 0.9) and 0.2 (there 0 for dop853) were chosen by the
/// product of evaluations and error^(1/k) on the double pendulum, Kepler's orbits of eccentricity 0.6 and 0.95 and
/// van der Pol's oscillator, over tolerances from 1e-6 to 1e-12: they reject 7 % of dop853's steps instead of 29
/// %. With `predicts`, what the last two steps changed is expected of the next one, too, if that makes it shorter
/// (Gustafsson, ACM Trans. Math. Softw. 20 (1994) 496-517; Hairer & Wanner II, §IV.8):
///
///     h_{n+1} ≤ h_n · 0.8 · ε_n^(−1/k) · (h_n/h_{n−1}) · (ε_{n−1}/ε_n)^(1/k)
///
/// rkn1210 takes few long steps, into a near collision as well as out of it: on Kepler's orbit of e = 0.99 it
/// needs 0.73 of the evaluations for the same error with this, on the Pleiades 0.90, on the outer solar system
/// 0.99 (rkn86 0.89, 0.96 and 0.99). Throws nothing.

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "alembert/ode/rhs.hpp"

namespace alembert {

class StepSize {
public:
    /// The error estimate behaves like h^order.
    explicit StepSize(int order, bool predicts = false)
        : order_(order), predicts_(predicts), beta_(0.2 / order), alpha_(1. / order - 0.75 * beta_) {}

    double after_accepted(double h, double ratio) {
        const double log_ratio = std::log(std::max(ratio, 1e-10));
        double log_factor = log_safety - alpha_ * log_ratio + beta_ * previous_;
        if (predicts_ && last_length_ > 0 && log_ratio > log_floor)
            log_factor = std::min(
                log_factor, log_safety + std::log(h / last_length_) + (last_ratio_ - 2 * log_ratio) / order_);
        const double factor = std::exp(log_factor);
        previous_ = std::max(log_ratio, log_floor);
        last_ratio_ = log_ratio;
        last_length_ = h;
        const double most = rejected_ ? 1 : largest_factor;
        rejected_ = false;
        return h * std::clamp(factor, smallest_factor, most);
    }

    double after_rejected(double h, double ratio) {
        rejected_ = true;
        if (!std::isfinite(ratio)) return h / 2;
        return h * std::max(smallest_factor, std::exp(log_safety - std::log(ratio) / order_));
    }

private:
    static constexpr double smallest_factor = 0.2, largest_factor = 6;
    static constexpr double log_safety = -0.22314355131420976;  ///< ln 0.8
    /// ln 1e-4: a very small error does not predict the next one.
    static constexpr double log_floor = -9.210340371976182;
    int order_;
    bool predicts_;
    double beta_, alpha_;
    double previous_ = log_floor;
    double last_length_ = 0, last_ratio_ = 0;  ///< of the last accepted step
    bool rejected_ = false;
};

/// Where a first step begins.
struct StepStart {
    double t;
    const double *state, *rate;
};

/// A first step so short that the rate changes little over an Euler step of that length: the algorithm of Hairer,
/// Nørsett, Wanner I, §II.4, "Starting step size", with the maximum norm of explicit_rk.hpp. It takes one
/// evaluation. `order` is as above. They try 1e-6 s where the state or the rate is zero, take 100 times that at
/// most, and shorten the step for the rate alone too. Here a state at rest, which knows no time but that of the
/// run, tries a part of it that is no period of a load, and takes a tenth of it if the rate there would not move
/// it beyond the tolerance in the whole run; and a state of zeros may move as long as its rate takes to change by
/// itself.
inline double starting_step(const Rhs& rhs, const StepStart& at, double tolerance, int order, double longest) {
    const double t = at.t, *const state = at.state, *const rate = at.rate;
    const int controlled = rhs.dimension - rhs.extra;
    const auto norm = [&](auto&& component) {
        double largest = 0;
        for (int i = 0; i < controlled; ++i)
            largest = std::max(largest, std::abs(component(i)) / std::max(1.0, std::abs(state[i])));
        return largest / tolerance;
    };
    const double size = norm([&](int i) { return state[i]; });
    const double slope = norm([&](int i) { return rate[i]; });
    const bool rests = slope < 1e-5, is_zero = size < 1e-5;
    const double first = std::min(longest, rests ? 0.618e-3 * longest : is_zero ? 1e-6 : 0.01 * (size / slope));

    std::vector<double> ahead(static_cast<std::size_t>(rhs.dimension));
    std::vector<double> rate_ahead(ahead.size());
    for (std::size_t i = 0; i < ahead.size(); ++i) ahead[i] = state[i] + first * rate[i];
    rhs(t + first, ahead.data(), rate_ahead.data());
    const double bend = norm([&](int i) { return rate_ahead[static_cast<std::size_t>(i)] - rate[i]; }) / first;

    const bool stays = rests && bend * longest * longest < 1;
    const double second = std::pow(0.01 / std::max(slope, bend), 1.0 / order);
    const double reach = is_zero && bend > 0 ? std::max(100 * first, slope / bend) : 100 * first;
    const double step = stays ? std::max(first, 0.1 * longest) : std::min({reach, second, longest});
    const double told_apart = 64 * std::numeric_limits<double>::epsilon() *
                              std::abs(t);  // a state that is zero to rounding would suggest less
    return std::min(longest, std::max(std::isfinite(step) && step > 0 ? step : first, told_apart));
}

}  // namespace alembert
