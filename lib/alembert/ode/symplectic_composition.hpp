// SPDX-License-Identifier: MIT
#pragma once

/// Symplectic methods for H = T(p) + V(q,t): the Störmer-Verlet method, and its composition of order 8.
///
///     v½ = v + h/2 a(t, q),   q₁ = q + h v½,   v₁ = v½ + h/2 a(t + h, q₁)
///
/// for a state (q, v) with q' = v and accelerations a that do not depend on rates (M constant, forces that depend
/// on positions and time only). The caller must know this, because a right-hand side does not show it.
/// std::invalid_argument is thrown for a state that is not (q, v). Each substep takes one evaluation, or two if
/// there are quadratures: these need the rate at q₁, v₁, and are integrated by the trapezoidal rule, which keeps
/// the substep symmetric.
///
/// In a time of its own (time_transformation.hpp) q and t drift at rates that depend on v, and v is kicked at
/// rates that depend on q. The state is (q, v, t), and a substep is drift, kick, drift, because that one stays on
/// Kepler's ellipses.
///
/// The method has order 2 and is stable for the oscillator if hω < 2. The composition takes 17 such steps with
/// lengths γ_i h and has order 8.
///
/// Sources: Hairer, Lubich, Wanner, Geometric Numerical Integration, 2nd ed. 2006, §I.3.1 and §V.3.2; W. Kahan and
/// R.-C. Li, Composition constants for raising the orders of unconventional schemes for ordinary differential
/// equations, Math. Comp. 66 (1997) 1089-1099 (s17odr8a).

#include <array>
#include <numeric>
#include <stdexcept>

#include "alembert/ode/formula_stepper.hpp"

namespace alembert {

inline constexpr std::array<double, 1> verlet_lengths = {1};
inline constexpr std::array<double, 17> kahan_li_8_lengths = {
    0.13020248308889008087881763,  0.56116298177510838456196441,  -0.38947496264484728640807860,
    0.15884190655515560089621075,  -0.39590389413323757733623154, 0.18453964097831570709183254,
    0.25837438768632204729397911,  0.29501172360931029887096624,  -0.60550853383003451169892108,
    0.29501172360931029887096624,  0.25837438768632204729397911,  0.18453964097831570709183254,
    -0.39590389413323757733623154, 0.15884190655515560089621075,  -0.38947496264484728640807860,
    0.56116298177510838456196441,  0.13020248308889008087881763};

template <const auto& lengths>
class SymplecticComposition {
public:
    static constexpr bool has_fixed_step = true;
    static constexpr Between between = lengths.size() == 1 ? Between::hermite : Between::shorter_step;

    SymplecticComposition(const Ends& ends, double /*tolerance*/)
        : n_(static_cast<std::size_t>(ends.controlled / 2)), state_(ends.y.size()) {
        if (ends.rhs.drift != nullptr) {
            drift_.resize(state_.size());
            return;
        }
        need_coordinates_and_rates(ends, "verlet and kahanli8", "gauss or dop853");
    }

    int most_evaluations() const { return 2 * static_cast<int>(lengths.size()); }

    bool increment(Ends& ends, double h, double* change, double* end_rate) {
        const std::size_t size = ends.y.size();
        std::fill_n(change, size, 0.0);
        if (!drift_.empty()) return in_own_time(ends, h, change, end_rate);
        std::copy(ends.rate.begin(), ends.rate.end(), end_rate);
        double t = ends.t;
        for (const double length : lengths) {
            const double step = length * h;
            t += step;
            for (std::size_t i = 0; i < n_; ++i) {
                change[n_ + i] += step / 2 * end_rate[n_ + i];
                change[i] += step * velocity(ends, change, i);
            }
            for (std::size_t i = 2 * n_; i < size; ++i) change[i] += step / 2 * end_rate[i];
            rate_at(ends, t, change, end_rate);
            for (std::size_t i = 0; i < n_; ++i) change[n_ + i] += step / 2 * end_rate[n_ + i];
            if (size > 2 * n_) {
                rate_at(ends, t, change, end_rate);
                for (std::size_t i = 2 * n_; i < size; ++i) change[i] += step / 2 * end_rate[i];
            }
        }
        for (std::size_t i = 0; i < n_; ++i) end_rate[i] = velocity(ends, change, i);
        return true;
    }

private:
    /// The rates of kicks are written to `rate`.
    bool in_own_time(Ends& ends, double h, double* change, double* rate) {
        const auto drift = [&](double length) {
            for (std::size_t i = 0; i < n_; ++i) change[i] += length * drift_[i];
            change[2 * n_] += length * drift_[2 * n_];
        };
        drift_at(ends, change);
        for (const double length : lengths) {
            const double step = length * h;
            drift(step / 2);
            rate_at(ends, ends.t, change, rate);
            for (std::size_t i = n_; i < 2 * n_; ++i) change[i] += step * rate[i];
            drift_at(ends, change);
            drift(step / 2);
        }
        return true;
    }

    double velocity(const Ends& ends, const double* change, std::size_t i) const {
        return ends.y[n_ + i] + (change[n_ + i] + ends.rest[n_ + i]);
    }

    void rate_at(Ends& ends, double t, const double* change, double* rate) {
        reach(ends, change);
        ends.evaluate(t, state_.data(), rate);
    }

    void drift_at(const Ends& ends, const double* change) {
        reach(ends, change);
        ends.rhs.drift(ends.rhs.context.get(), ends.t, state_.data(), drift_.data());
    }

    void reach(const Ends& ends, const double* change) {
        for (std::size_t i = 0; i < state_.size(); ++i) state_[i] = ends.y[i] + (change[i] + ends.rest[i]);
    }

    std::size_t n_;
    std::vector<double> state_, drift_;  ///< drift_: rates of q and t; empty where q' = v
};

using Verlet = SymplecticComposition<verlet_lengths>;
using KahanLi8 = SymplecticComposition<kahan_li_8_lengths>;

}  // namespace alembert
