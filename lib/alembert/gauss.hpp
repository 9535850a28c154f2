// SPDX-License-Identifier: MIT
#pragma once

/// Gauss collocation with three stages: order 6, symmetric, symplectic for every Hamiltonian, A-stable.
///
///     Z_i = h Σ_j a_ij f(t + c_j h, y + Z_j),   y₁ = y + h Σ_j b_j f(t + c_j h, y + Z_j)
///
/// by fixed-point iteration until the changes no longer shrink, which is at rounding: a tolerance left in the
/// equations would be a drift of the energy (Hairer, Lubich, Wanner, Geometric Numerical Integration, §VIII.6). The
/// iteration contracts for h‖∂f/∂y‖ below about 2, so that A-stability serves accuracy, not stiff systems: those are
/// radau's. It starts from the polynomial of the step before (§VIII.6.1).
///
/// Source: Hairer, Lubich, Wanner, §II.1.3, table 1.2 (Kuntzmann & Butcher, order 6).

#include <array>
#include <numbers>

#include "alembert/stepper.hpp"

namespace alembert {

class Gauss {
public:
    static constexpr bool has_fixed_step = true;
    static constexpr Between between = Between::shorter_step;
    static constexpr int stages = 3;

    Gauss(const Ends& ends, double /*tolerance*/)
        : size_(ends.y.size()), rates_(stages * size_), kept_(rates_), last_(rates_), state_(size_), z_(rates_) {}

    int most_evaluations() const { return stages * most_rounds; }

    bool increment(Ends& ends, double h, double* change, double*) {
        forecast(ends, h);
        double before = HUGE_VAL;
        bool solved = false;
        for (int round = 0; round < most_rounds; ++round) {
            for (std::size_t i = 0; i < stages; ++i) {
                for (std::size_t k = 0; k < size_; ++k)
                    state_[k] = ends.y[k] + (z_[i * size_ + k] + ends.rest[k]);
                ends.evaluate(ends.t + c[i] * h, state_.data(), &rates_[i * size_]);
            }
            double largest = 0;
            for (std::size_t i = 0; i < stages; ++i) {
                for (std::size_t k = 0; k < size_; ++k) {
                    double sum = 0;
                    for (std::size_t j = 0; j < stages; ++j) sum += a[i][j] * rates_[j * size_ + k];
                    state_[k] = h * sum - z_[i * size_ + k];
                    z_[i * size_ + k] = h * sum;
                }
                largest = std::max(largest, ends.norm(state_.data()));
            }
            if (!(largest < HUGE_VAL)) break;
            solved = largest == 0 || (largest >= before && largest < 1e-12);
            if (solved) break;
            before = largest;
        }
        for (std::size_t k = 0; k < size_; ++k)
            change[k] = h * (b[0] * (rates_[k] + rates_[2 * size_ + k]) + b[1] * rates_[size_ + k]);
        return solved;
    }

    /// Keeps the polynomial of the step, which looking into it would overwrite.
    void finished(const Ends&) { std::copy(rates_.begin(), rates_.end(), kept_.begin()); }
    void advance(const Ends& ends) {
        increment_of_ = ends.h;
        std::swap(last_, kept_);
    }

private:
    static constexpr int most_rounds = 60;
    static constexpr double root = 3.872983346207417;  // √15
    static constexpr std::array<double, 3> c = {0.5 - root / 10, 0.5, 0.5 + root / 10};
    static constexpr std::array<double, 3> b = {5. / 18, 4. / 9, 5. / 18};
    static constexpr std::array<std::array<double, 3>, 3> a = {
        {{5. / 36, 2. / 9 - root / 15, 5. / 36 - root / 30},
         {5. / 36 + root / 24, 2. / 9, 5. / 36 - root / 24},
         {5. / 36 + root / 30, 2. / 9 + root / 15, 5. / 36}}};

    /// Z from the rates that the polynomial of the last step has there; from the rate at the start in the first step.
    void forecast(const Ends& ends, double h) {
        for (std::size_t i = 0; i < stages; ++i)
            for (std::size_t k = 0; k < size_; ++k) {
                double sum = c[i] * ends.rate[k];
                if (increment_of_ != 0) {
                    sum = 0;
                    for (std::size_t j = 0; j < stages; ++j)
                        sum += a[i][j] * extrapolated(1 + c[j] * h / increment_of_, k);
                }
                z_[i * size_ + k] = h * sum;
            }
    }

    /// The quadratic through the last rates, at θ.
    double extrapolated(double theta, std::size_t k) const {
        const double x = (theta - 0.5) / (root / 10);
        const double left = last_[k], middle = last_[size_ + k], right = last_[2 * size_ + k];
        return middle + x * ((right - left) / 2 + x * ((right + left) / 2 - middle));
    }

    std::size_t size_;
    std::vector<double> rates_, kept_, last_, state_, z_;
    double increment_of_ = 0;
};

}  // namespace alembert
