// SPDX-License-Identifier: MIT
#pragma once

/// Gauss collocation with three stages: order 6, symmetric, symplectic for every Hamiltonian, A-stable.
///
///     Z_i = h Σ_j a_ij f(t + c_j h, y + Z_j),   y₁ = y + h Σ_j b_j f(t + c_j h, y + Z_j)
///
/// solved by fixed-point iteration until the changes no longer shrink, that is, to rounding: an error left in the
/// equations would make the energy drift (Hairer, Lubich, Wanner, Geometric Numerical Integration, §VIII.6). The
/// iteration contracts for h‖∂f/∂y‖ below about 2. Where it contracts by less than a half, or not at all, the
/// simplified Newton method replaces it for the rest of the run, (I − h A ⊗ J) ΔZ = h (A ⊗ I) F − Z with J = ∂f/∂y
/// at the start of the step (newton.hpp), as one dense system of size 3n. The iteration starts from the polynomial
/// of the step before (§VIII.6.1).
///
/// Each coefficient is a number of ten binary digits and a rest. Coefficients that are rounded once do not obey
/// the condition of symplecticity, b_i a_ij + b_j a_ji = b_i b_j, by some 1e-17, which makes the energy drift in
/// proportion to the time; with the rests its error grows as random rounding does, with the square root of the
/// number of steps, if these are short beside the periods. In steps of a sixth of a period a third of the drift
/// is left (Hairer, McLachlan, Razakarivony, Achieving Brouwer's law with implicit Runge-Kutta methods, BIT
/// 48 (2008) 231-243).
///
/// Source: Hairer, Lubich, Wanner, §II.1.3, table 1.2 (Kuntzmann & Butcher, order 6).

#include <array>
#include <numbers>
#include <optional>

#include "alembert/dense.hpp"
#include "alembert/newton.hpp"

namespace alembert {

/// A coefficient as a number of ten binary digits after the point and a rest.
struct SplitCoefficient {
    double high, low;
    constexpr SplitCoefficient(long double value)  // NOLINT: a number is a number
        : high(static_cast<double>(static_cast<long>(value * 1024 + (value < 0 ? -0.5L : 0.5L))) / 1024),
          low(static_cast<double>(value - high)) {}
    constexpr operator double() const { return high + low; }  // NOLINT
};

class Gauss {
public:
    static constexpr bool has_fixed_step = true;
    static constexpr Between between = Between::shorter_step;
    static constexpr int stages = 3;

    Gauss(const Ends& ends, double /*tolerance*/)
        : size_(ends.y.size()),
          rates_(stages * size_),
          kept_(rates_),
          last_(rates_),
          state_(size_),
          z_(rates_),
          start_(rates_) {}

    int most_evaluations() const { return stages * (most_rounds + most_newton_rounds) + static_cast<int>(size_); }

    bool increment(Ends& ends, double h, double* change, double*) {
        forecast(ends, h);
        start_ = z_;
        bool solved = !by_newton_ && iterate(ends, h);
        if (!solved) {
            z_ = start_;
            solved = solve(ends, h);
            by_newton_ = by_newton_ || solved;
        }
        for (std::size_t k = 0; k < size_; ++k) change[k] = h * weighted(b, k);
        return solved;
    }

    /// Keeps the polynomial of the step, because dense output would overwrite it.
    void finished(const Ends&) { std::copy(rates_.begin(), rates_.end(), kept_.begin()); }
    void advance(const Ends& ends) {
        increment_of_ = ends.h;
        std::swap(last_, kept_);
    }

private:
    static constexpr int most_rounds = 60, most_newton_rounds = 60;
    static constexpr double rounding = 1e-12;  ///< changes below this that no longer shrink are rounding

    using Coefficients = std::array<SplitCoefficient, 3>;

    static constexpr long double root = 3.872983346207416885179265399782400L;  // √15
    static constexpr std::array<double, 3> c = {0.5 - root / 10, 0.5, 0.5 + root / 10};
    static constexpr Coefficients b = {5.L / 18, 4.L / 9, 5.L / 18};
    static constexpr std::array<Coefficients, 3> a = {
        Coefficients{5.L / 36, 2.L / 9 - root / 15, 5.L / 36 - root / 30},
        Coefficients{5.L / 36 + root / 24, 2.L / 9, 5.L / 36 - root / 24},
        Coefficients{5.L / 36 + root / 30, 2.L / 9 + root / 15, 5.L / 36}};

    /// Σ_j w_j k_j of component k.
    double weighted(const Coefficients& w, std::size_t k) const {
        double high = 0, low = 0;
        for (std::size_t j = 0; j < stages; ++j) {
            high += w[j].high * rates_[j * size_ + k];
            low += w[j].low * rates_[j * size_ + k];
        }
        return high + low;
    }

    void evaluate_stages(Ends& ends, double h) {
        for (std::size_t i = 0; i < stages; ++i) {
            for (std::size_t k = 0; k < size_; ++k) state_[k] = ends.y[k] + (z_[i * size_ + k] + ends.rest[k]);
            ends.evaluate(ends.t + c[i] * h, state_.data(), &rates_[i * size_]);
        }
    }

    bool iterate(Ends& ends, double h) {
        double before = HUGE_VAL;
        for (int round = 0; round < most_rounds; ++round) {
            evaluate_stages(ends, h);
            double largest = 0;
            for (std::size_t i = 0; i < stages; ++i) {
                for (std::size_t k = 0; k < size_; ++k) {
                    const double value = h * weighted(a[i], k);
                    state_[k] = value - z_[i * size_ + k];
                    z_[i * size_ + k] = value;
                }
                largest = std::max(largest, ends.norm(state_.data()));
            }
            if (!(largest < HUGE_VAL)) return false;
            if (largest == 0 || (largest >= before && largest < rounding)) return true;
            if (round > 2 && largest > before / 2 && largest > rounding) return false;
            before = largest;
        }
        return false;
    }

    bool solve(Ends& ends, double h) {
        const auto n = static_cast<Eigen::Index>(size_);
        if (!jacobian_) jacobian_.emplace(static_cast<int>(size_));
        jacobian_->evaluate(ends);
        Eigen::MatrixXd matrix(stages * n, stages * n);
        for (int i = 0; i < stages; ++i)
            for (int j = 0; j < stages; ++j)
                matrix.block(i * n, j * n, n, n) =
                    (i == j ? 1. : 0.) * Eigen::MatrixXd::Identity(n, n) -
                    h * a[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] * jacobian_->values;
        if (!matrix.allFinite()) return false;
        Elimination lu;
        lu.factor(matrix);
        Eigen::VectorXd side(stages * n), delta(stages * n);
        double before = HUGE_VAL;
        for (int round = 0; round < most_newton_rounds; ++round) {
            evaluate_stages(ends, h);
            for (std::size_t i = 0; i < stages; ++i)
                for (std::size_t k = 0; k < size_; ++k)
                    side[static_cast<Eigen::Index>(i * size_ + k)] = h * weighted(a[i], k) - z_[i * size_ + k];
            lu.solve(side, delta);
            double largest = 0;
            for (std::size_t i = 0; i < stages; ++i)
                largest = std::max(largest, ends.norm(delta.data() + i * size_));
            if (!(largest < HUGE_VAL)) return false;
            for (std::size_t k = 0; k < z_.size(); ++k) z_[k] += delta[static_cast<Eigen::Index>(k)];
            if (largest == 0 || (largest >= before && largest < rounding)) {
                // h k_i = Σ_j (A⁻¹)_ij Z_j, which for a stiff system is free of the rounding errors of f.
                const Eigen::Matrix3d inverse = matrix_of_a().inverse();
                for (std::size_t k = 0; k < size_; ++k) {
                    const Eigen::Vector3d z(z_[k], z_[size_ + k], z_[2 * size_ + k]), rates = inverse * z / h;
                    for (std::size_t i = 0; i < stages; ++i)
                        rates_[i * size_ + k] = rates[static_cast<Eigen::Index>(i)];
                }
                return true;
            }
            if (round > 20 && largest >= before) return false;
            before = largest;
        }
        return false;
    }

    static Eigen::Matrix3d matrix_of_a() {
        Eigen::Matrix3d A;
        for (int i = 0; i < stages; ++i)
            for (int j = 0; j < stages; ++j) A(i, j) = a[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
        return A;
    }

    /// Z from the rates that the polynomial of the last step predicts; in the first step, from the rate at the
    /// start.
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
        const double x = (theta - 0.5) / static_cast<double>(root / 10);
        const double left = last_[k], middle = last_[size_ + k], right = last_[2 * size_ + k];
        return middle + x * ((right - left) / 2 + x * ((right + left) / 2 - middle));
    }

    std::size_t size_;
    std::vector<double> rates_, kept_, last_, state_, z_, start_;
    std::optional<Jacobian> jacobian_;
    bool by_newton_ = false;
    double increment_of_ = 0;
};

}  // namespace alembert
