// SPDX-License-Identifier: MIT
#pragma once

/// Gauss collocation with three stages: order 6, symmetric, symplectic for every Hamiltonian, A-stable.
///
///     Z_i = h Σ_j a_ij f(t + c_j h, y + Z_j),   y₁ = y + h Σ_j b_j f(t + c_j h, y + Z_j)
///
/// solved by fixed-point iteration until the changes no longer shrink, that is, to rounding: an error left in the
/// equations would make the energy drift (Hairer, Lubich, Wanner, Geometric Numerical Integration, §VIII.6). The
/// iteration contracts for h‖∂f/∂y‖ below about 2. It ends where its changes are lost in rounding, always on the
/// side from which it comes; the energy of an oscillator drifts by 8e-18 of itself in a step of a sixth of a
/// period. Therefore, and where it contracts too little, the simplified Newton method replaces it for the rest of
/// the run, (I − h A ⊗ J) ΔZ = h (A ⊗ I) F − Z as one dense system of size 3n, whose last change has either sign.
/// It takes over where changes shrink to more than a twentieth, in systems of more than 8 components to more than
/// a half. J = ∂f/∂y at the start of a step (newton_iteration.hpp) is kept until more rounds than usual are
/// needed. The iteration starts from the polynomial of the step before (§VIII.6.1).
///
/// Each coefficient is a number of ten binary digits and a rest. Coefficients that are rounded once do not obey
/// the condition of symplecticity, b_i a_ij + b_j a_ji = b_i b_j, by some 1e-17, which makes the energy drift in
/// proportion to the time; with the rests its error grows as random rounding does, with the square root of the
/// number of steps (Hairer, McLachlan, Razakarivony, Achieving Brouwer's law with implicit Runge-Kutta methods,
/// BIT 48 (2008) 231-243).
///
/// Source: Hairer, Lubich, Wanner, §II.1.3, table 1.2 (Kuntzmann & Butcher, order 6).

#include <array>
#include <numbers>
#include <optional>

#include "alembert/base/dense.hpp"
#include "alembert/ode/newton_iteration.hpp"

namespace alembert {

/// A coefficient as a number of ten binary digits after the point and a rest.
struct SplitCoefficient {
    double high, low;
    constexpr SplitCoefficient(long double value)  // NOLINT: a number is a number
        : high(static_cast<double>(static_cast<long>(value * 1024 + (value < 0 ? -0.5L : 0.5L))) / 1024),
          low(static_cast<double>(value - high)) {}
    constexpr operator double() const { return high + low; }  // NOLINT
};

/// The method of three stages.
struct GaussTable {
    using Row = std::array<SplitCoefficient, 3>;
    using Numbers = std::array<std::array<long double, 3>, 3>;

    static constexpr long double root = 3.872983346207416885179265399782400L;  // √15
    static constexpr std::array<double, 3> c = {0.5 - root / 10, 0.5, 0.5 + root / 10};
    static constexpr Row b = {5.L / 18, 4.L / 9, 5.L / 18};
    static constexpr Numbers matrix = {{{5.L / 36, 2.L / 9 - root / 15, 5.L / 36 - root / 30},
                                        {5.L / 36 + root / 24, 2.L / 9, 5.L / 36 - root / 24},
                                        {5.L / 36 + root / 30, 2.L / 9 + root / 15, 5.L / 36}}};

    std::array<Row, 3> a = {row(matrix[0]), row(matrix[1]), row(matrix[2])};
    std::array<Row, 3> inverse = {row(row_of_inverse(0)), row(row_of_inverse(1)), row(row_of_inverse(2))};

private:
    static constexpr Row row(const std::array<long double, 3>& numbers) {
        return {numbers[0], numbers[1], numbers[2]};
    }
    static constexpr long double cofactor(std::size_t i, std::size_t j) {
        const auto &p = matrix[(i + 1) % 3], &q = matrix[(i + 2) % 3];
        const std::size_t r = (j + 1) % 3, s = (j + 2) % 3;
        return p[r] * q[s] - p[s] * q[r];
    }
    /// Row i of A⁻¹, which has the cofactors of column i of A.
    static constexpr std::array<long double, 3> row_of_inverse(std::size_t i) {
        long double determinant = 0;
        for (std::size_t j = 0; j < 3; ++j) determinant += matrix[0][j] * cofactor(0, j);
        return {cofactor(0, i) / determinant, cofactor(1, i) / determinant, cofactor(2, i) / determinant};
    }
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
        for (std::size_t k = 0; k < size_; ++k) change[k] = h * weighted(GaussTable::b, k);
        return solved;
    }

    /// Keeps the polynomial of the step, because dense output would overwrite it.
    void finished(const Ends&) { std::copy(rates_.begin(), rates_.end(), kept_.begin()); }
    void advance(const Ends& ends) {
        increment_of_ = ends.h;
        std::swap(last_, kept_);
    }

private:
    static constexpr int most_rounds = 60, most_newton_rounds = 60, usual_newton_rounds = 6;
    static constexpr double stiff = 10;        ///< h‖J‖ from which rates are found from stages
    static constexpr double rounding = 1e-12;  ///< changes below this that no longer shrink are rounding

    using Coefficients = GaussTable::Row;
    static constexpr GaussTable table = {};

    /// Σ_j w_j x_j of component k.
    double sum(const Coefficients& w, const std::vector<double>& x, std::size_t k) const {
        double high = 0, low = 0;
        for (std::size_t j = 0; j < stages; ++j) {
            high += w[j].high * x[j * size_ + k];
            low += w[j].low * x[j * size_ + k];
        }
        return high + low;
    }
    double weighted(const Coefficients& w, std::size_t k) const { return sum(w, rates_, k); }

    void evaluate_stages(Ends& ends, double h) {
        for (std::size_t i = 0; i < stages; ++i) {
            for (std::size_t k = 0; k < size_; ++k) state_[k] = ends.y[k] + (z_[i * size_ + k] + ends.rest[k]);
            ends.evaluate(ends.t + GaussTable::c[i] * h, state_.data(), &rates_[i * size_]);
        }
    }

    /// How much a round may leave of a change: ρ for which the rest of the iteration, ρ/(1 − ρ) of a last change
    /// that is lost in rounding, is a twentieth of it. In large systems ρ for which the 53 bits of a double take
    /// fewer than `most_rounds`.
    static constexpr double leaves_little = 0.05, gains_a_bit = 0.5;
    /// The components up to which a system is small: one solution of the 3n equations of Newton's method, with 9n²
    /// = 576 multiplications, then costs about as much as the evaluations of a round. Beyond, its cost grows with
    /// n².
    static constexpr std::size_t small = 8;
    double slow() const { return size_ <= small ? leaves_little : gains_a_bit; }

    bool iterate(Ends& ends, double h) {
        double before = HUGE_VAL;
        for (int round = 0; round < most_rounds; ++round) {
            evaluate_stages(ends, h);
            double largest = 0;
            for (std::size_t i = 0; i < stages; ++i) {
                for (std::size_t k = 0; k < size_; ++k) {
                    const double value = h * weighted(table.a[i], k);
                    state_[k] = value - z_[i * size_ + k];
                    z_[i * size_ + k] = value;
                }
                largest = std::max(largest, ends.norm(state_.data()));
            }
            if (!(largest < HUGE_VAL)) return false;
            if (largest == 0 || (largest >= before && largest < rounding)) return true;
            if (round > 2 && largest > slow() * before && largest > rounding) return false;
            before = largest;
        }
        return false;
    }

    bool solve(Ends& ends, double h) {
        const bool kept = std::abs(h - factored_step_) <= 1e-9 * std::abs(h);
        if (kept && newton(ends, h)) return true;
        if (kept) z_ = start_;
        return factor(ends, h) && newton(ends, h);
    }

    /// J at the start of the step, and the factors of I − h A ⊗ J.
    bool factor(Ends& ends, double h) {
        const auto n = static_cast<Eigen::Index>(size_);
        if (!jacobian_) jacobian_.emplace(static_cast<int>(size_));
        jacobian_->evaluate(ends);
        factored_step_ = 0;
        Eigen::MatrixXd matrix(stages * n, stages * n);
        for (int i = 0; i < stages; ++i)
            for (int j = 0; j < stages; ++j)
                matrix.block(i * n, j * n, n, n) =
                    (i == j ? 1. : 0.) * Eigen::MatrixXd::Identity(n, n) -
                    h * table.a[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] * jacobian_->values;
        if (!matrix.allFinite()) return false;
        lu_.factor(matrix);
        factored_step_ = h;
        is_stiff_ = std::abs(h) * size_of_jacobian(ends) > stiff;
        return true;
    }

    /// The largest |J_ij| max(1, |y_j|) / max(1, |y_i|), summed over j.
    double size_of_jacobian(const Ends& ends) const {
        double largest = 0;
        for (std::size_t i = 0; i < size_; ++i) {
            double sum = 0;
            for (std::size_t j = 0; j < size_; ++j)
                sum += std::abs(jacobian_->values(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j))) *
                       std::max(1.0, std::abs(ends.y[j]));
            largest = std::max(largest, sum / std::max(1.0, std::abs(ends.y[i])));
        }
        return largest;
    }

    bool newton(Ends& ends, double h) {
        const auto n = static_cast<Eigen::Index>(size_);
        side_.resize(stages * n);
        delta_.resize(stages * n);
        double before = HUGE_VAL;
        for (int round = 0; round < most_newton_rounds; ++round) {
            evaluate_stages(ends, h);
            for (std::size_t i = 0; i < stages; ++i)
                for (std::size_t k = 0; k < size_; ++k)
                    side_[static_cast<Eigen::Index>(i * size_ + k)] =
                        h * weighted(table.a[i], k) - z_[i * size_ + k];
            lu_.solve(side_, delta_);
            double largest = 0;
            for (std::size_t i = 0; i < stages; ++i)
                largest = std::max(largest, ends.norm(delta_.data() + i * size_));
            if (!(largest < HUGE_VAL)) return false;
            if (largest == 0 || (largest >= before && largest < rounding)) {
                if (is_stiff_) take_rates_from_stages(h);
                if (round > usual_newton_rounds) factored_step_ = 0;  // J has become old
                return true;
            }
            for (std::size_t k = 0; k < z_.size(); ++k) z_[k] += delta_[static_cast<Eigen::Index>(k)];
            if (round > 20 && largest >= before) return false;
            before = largest;
        }
        return false;
    }

    /// h k_i = Σ_j (A⁻¹)_ij Z_j, which for a stiff system is free of the rounding errors of f.
    void take_rates_from_stages(double h) {
        for (std::size_t i = 0; i < stages; ++i)
            for (std::size_t k = 0; k < size_; ++k) rates_[i * size_ + k] = sum(table.inverse[i], z_, k) / h;
    }

    /// Z from the rates that the polynomial of the last step predicts; in the first step, from the rate at the
    /// start.
    void forecast(const Ends& ends, double h) {
        for (std::size_t i = 0; i < stages; ++i)
            for (std::size_t k = 0; k < size_; ++k) {
                double sum = GaussTable::c[i] * ends.rate[k];
                if (increment_of_ != 0) {
                    sum = 0;
                    for (std::size_t j = 0; j < stages; ++j)
                        sum += table.a[i][j] * extrapolated(1 + GaussTable::c[j] * h / increment_of_, k);
                }
                z_[i * size_ + k] = h * sum;
            }
    }

    /// The quadratic through the last rates, at θ.
    double extrapolated(double theta, std::size_t k) const {
        const double x = (theta - 0.5) / static_cast<double>(GaussTable::root / 10);
        const double left = last_[k], middle = last_[size_ + k], right = last_[2 * size_ + k];
        return middle + x * ((right - left) / 2 + x * ((right + left) / 2 - middle));
    }

    std::size_t size_;
    std::vector<double> rates_, kept_, last_, state_, z_, start_;
    std::optional<Jacobian> jacobian_;
    Elimination lu_;
    Eigen::VectorXd side_, delta_;
    double factored_step_ = 0;  ///< the step for which `lu_` was made; 0: none, or an old one
    bool is_stiff_ = false;
    bool by_newton_ = false;
    double increment_of_ = 0;
};

}  // namespace alembert
