// SPDX-License-Identifier: MIT
#pragma once

/// Radau IIA of 3, 5 and 7 stages (orders 5, 9 and 13), for stiff systems; the last stage is the end; L-stable.
///
///     Z_i = h Σ_j a_ij f(t + c_j h, y + Z_j),   y₁ = y + Z_s
///
/// The equations are solved by the simplified Newton method with one ∂f/∂y, the emitted one if there is one
/// (newton.hpp). In the basis of the eigenvectors of A⁻¹ the s n equations decouple into one real and (s − 1)/2
/// complex systems of n, (λ_k/h − J) ΔW_k = … (collocation.hpp).
///
/// The error estimate is (I − hγ₀J)⁻¹ (γ₀ h f(t, y) + Σ e_i Z_i), of order h^{s+1}; in the first step and after a
/// rejection it is filtered once more. Dense output is the collocation polynomial, whose error is of order h^{s+1}
/// too, so that the tolerance also holds within a step; at its ends the error is smaller. The factorizations are
/// used again while h grows by less than a fifth, and ∂f/∂y while the iteration contracts well.
///
/// `Radau<3, 7>` changes between 3, 5 and 7 stages: to more stages where Newton's iteration contracts so well (Θ <
/// 0.002) that longer steps could be solved and the step length is steady, to fewer where it hardly contracts (Θ >
/// 0.8) or has failed. Each number of stages is kept for at least ten steps.
///
/// Source: Hairer & Wanner, Solving Ordinary Differential Equations II, 2nd ed. 1996, §IV.8; the same, Stiff
/// differential equations solved by Radau methods, J. Comput. Appl. Math. 111 (1999) 93-111, §4.

#include "alembert/ode/collocation.hpp"
#include "alembert/ode/newton.hpp"
#include "alembert/ode/shifted_linear_solver.hpp"
#include "alembert/ode/step_size.hpp"

namespace alembert {

template <int fewest, int most>
class Radau {
public:
    static constexpr bool has_fixed_step = false;
    static constexpr Between between = Between::own;
    static constexpr int estimate_order = fewest + 1;

    Radau(const Ends& ends, double tolerance)
        : n_(ends.size),
          enough_(std::max(1e-2 * tolerance, least_rounding)),
          jacobian_(n_),
          real_(n_),
          complex_((most - 1) / 2, Shifted<std::complex<double>>(n_)),
          real_side_(n_),
          real_solution_(n_),
          complex_side_(n_),
          state_(static_cast<std::size_t>(n_)),
          rate_(state_.size()),
          delta_(state_.size()),
          control_(estimate_order) {
        complex_solution_.assign(complex_.size(), Eigen::VectorXcd(n_));
        take(fewest);
        poly_ = Eigen::MatrixXd::Zero(n_, fewest);
        power_ = Eigen::VectorXd::Ones(n_) / std::sqrt(static_cast<double>(n_));
    }

    /// The estimate of the error may consist of rounding up to this size.
    double rounding() const { return 20 * rounding_; }
    /// The modulus of the largest eigenvalue of ∂f/∂y at its last evaluation, about.
    double largest_eigenvalue() const { return largest_eigenvalue_; }

    int most_evaluations() const { return n_ + most * most_rounds + 1; }
    int stages() const { return s_; }

    bool increment(Ends& ends, double h, double* change, double*) {
        if (wanted_ != s_) take(wanted_);
        if (!has_jacobian_) {
            jacobian_.evaluate(ends);
            pairs_ = second_order(jacobian_.values);
            find_largest_eigenvalue();
            has_jacobian_ = is_fresh_ = true;
            factored_for_ = 0;
        }
        if (!(std::abs(h - factored_for_) <= 1e-9 * h)) {
            factorize(h);
            find_rounding(ends);
        }
        forecast(h);
        if (!solve(ends, h)) {
            has_jacobian_ = has_jacobian_ && is_fresh_;
            was_rejected_ = true;
            step_down();
            return false;
        }
        for (int i = 0; i < n_; ++i) change[i] = z_(i, s_ - 1);
        estimate(ends, h);
        return true;
    }

    void finished(const Ends& ends) {
        // The end of the step is where a projection has moved it.
        for (int i = 0; i < n_; ++i) {
            const auto k = static_cast<std::size_t>(i);
            z_(i, s_ - 1) = (ends.next[k] - ends.y[k]) + (ends.next_rest[k] - ends.rest[k]);
        }
        kept_.noalias() = z_ * table_->to_polynomial.transpose();
    }

    void interpolate(const Ends& ends, double theta, double* out) const {
        for (int i = 0; i < n_; ++i) {
            const auto k = static_cast<std::size_t>(i);
            out[i] = ends.y[k] + (value(kept_, i, theta) + ends.rest[k]);
        }
    }

    void advance(const Ends& ends) {
        poly_ = kept_;
        step_of_poly_ = ends.h;
        is_fresh_ = false;
        if (ratio_ > 1e-3) has_jacobian_ = false;
        was_rejected_ = is_first_ = false;
        ++steps_of_order_;
    }

    double next_length(const Ends& ends, bool accepted, double ratio) {
        const double h = ends.h;
        if (!accepted) {
            was_rejected_ = true;
            if (!is_fresh_) has_jacobian_ = false;
            return control_.after_rejected(h, ratio);
        }
        const double next = control_.after_accepted(h, ratio);
        if (steps_of_order_ >= 10 && ratio_ < 0.002 && s_ < most && next > 0.8 * h && next < 1.2 * h)
            wanted_ = s_ + 2;
        if (steps_of_order_ >= 10 && ratio_ > 0.8) step_down();
        return has_jacobian_ && next >= h && next <= 1.2 * h ? h : next;
    }

private:
    static constexpr int most_rounds = most + 7;
    static constexpr double least_rounding = 4e-16;  ///< of a stage, in units of max(1, |y|)
    using Complex = std::complex<double>;

    void take(int stages) {
        s_ = wanted_ = stages;
        table_ = &radau_table(stages);
        z_.resize(n_, s_);
        f_.resize(n_, s_);
        side_.resize(n_, s_);
        kept_.resize(n_, s_);
        control_ = StepSize(s_ + 1);
        factored_for_ = 0;
        steps_of_order_ = 0;
    }

    void step_down() {
        if (s_ > fewest && wanted_ == s_) wanted_ = s_ - 2;
    }

    void factorize(double h) {
        real_.factor(jacobian_.values, pairs_, table_->lambda / h);
        for (std::size_t k = 0; k < table_->mu.size(); ++k)
            complex_[k].factor(jacobian_.values, pairs_, table_->mu[k] / h);
        factored_for_ = h;
    }

    /// The changes of a stage that roundings of f make: (λ/h − J)⁻¹ r with |r_i| = ½ ε Σ |J_ij y_j|, for two
    /// choices of signs. Newton's iteration cannot become more exact than that, nor can the estimate of the error.
    void find_rounding(const Ends& ends) {
        constexpr double half_epsilon = 1.1102230246251565e-16;
        rounding_ = 0;
        for (const int period : {2, 3}) {
            for (int i = 0; i < n_; ++i) {
                double sum = 0;
                for (int j = 0; j < n_; ++j)
                    sum += std::abs(jacobian_.values(i, j) * ends.y[static_cast<std::size_t>(j)]);
                real_side_[i] = (i % period == 0 ? half_epsilon : -half_epsilon) * sum;
            }
            real_.solve(real_side_, real_solution_);
            rounding_ = std::max(rounding_, ends.norm(real_solution_.data()));
        }
        if (!std::isfinite(rounding_)) rounding_ = 0;
    }

    /// The fourth root of ‖J⁴v‖/‖v‖, v being what is left of the last vectors.
    void find_largest_eigenvalue() {
        double growth = 1;
        for (int round = 0; round < 4; ++round) {
            real_solution_.noalias() = jacobian_.values * power_;
            const double size = real_solution_.norm();
            if (!(size > 0) || !std::isfinite(size)) {
                power_.setOnes();
                power_ /= power_.norm();
                break;
            }
            growth *= size;
            power_ = real_solution_ / size;
        }
        largest_eigenvalue_ = std::sqrt(std::sqrt(growth));
    }

    /// θ (p₀ + p₁θ + …)
    static double value(const Eigen::MatrixXd& polynomial, int i, double theta) {
        double sum = 0;
        for (Eigen::Index k = polynomial.cols(); k-- > 0;) sum = theta * (polynomial(i, k) + sum);
        return sum;
    }

    /// Extrapolates the polynomial of the last step; zero in the first step.
    void forecast(double h) {
        z_.setZero();
        if (step_of_poly_ == 0) return;
        for (int i = 0; i < n_; ++i) {
            const double end = value(poly_, i, 1);
            for (int k = 0; k < s_; ++k) z_(i, k) = value(poly_, i, 1 + table_->c[k] * h / step_of_poly_) - end;
        }
    }

    bool solve(Ends& ends, double h) {
        Contraction contraction(std::max(enough_, rounding_), s_ + 7, std::max(rounding_, least_rounding));
        for (;;) {
            for (int k = 0; k < s_; ++k) {
                for (int i = 0; i < n_; ++i) {
                    const auto at = static_cast<std::size_t>(i);
                    state_[at] = ends.y[at] + (z_(i, k) + ends.rest[at]);
                }
                ends.evaluate(ends.t + table_->c[k] * h, state_.data(), f_.col(k).data());
            }
            const double largest = correct(ends, h);
            const auto verdict = contraction.after(largest);
            ratio_ = contraction.ratio();
            if (verdict == Contraction::more) continue;
            return verdict == Contraction::done;
        }
    }

    /// Changes all stages once and returns the size of the change.
    double correct(const Ends& ends, double h) {
        side_.noalias() = z_ * table_->inverse.transpose();
        side_ = f_ - side_ / h;
        real_side_.noalias() = side_ * table_->back_real;
        real_.solve(real_side_, real_solution_);
        for (std::size_t pair = 0; pair < table_->mu.size(); ++pair) {
            complex_side_.noalias() = side_.template cast<Complex>() * table_->back_complex[pair];
            complex_[pair].solve(complex_side_, complex_solution_[pair]);
        }
        double largest = 0;
        for (int k = 0; k < s_; ++k) {
            for (int i = 0; i < n_; ++i) {
                double delta = table_->v_real[k] * real_solution_[i];
                for (std::size_t pair = 0; pair < table_->mu.size(); ++pair)
                    delta += 2 * (table_->v_complex[pair][k] * complex_solution_[pair][i]).real();
                z_(i, k) += delta;
                delta_[static_cast<std::size_t>(i)] = delta;
            }
            largest = std::max(largest, ends.norm(delta_.data()));
        }
        return largest;
    }

    /// (I − hγ₀J)⁻¹ x = (λ/h − J)⁻¹ (λ/h) x.
    void estimate(Ends& ends, double h) {
        const auto filtered = [&](const std::vector<double>& rate) {
            real_side_.noalias() = table_->lambda / h * (z_ * table_->e);
            for (int i = 0; i < n_; ++i) real_side_[i] += rate[static_cast<std::size_t>(i)];
            real_.solve(real_side_, real_solution_);
            for (int i = 0; i < n_; ++i) ends.error[static_cast<std::size_t>(i)] = real_solution_[i];
        };
        filtered(ends.rate);
        if (!is_first_ && !was_rejected_) return;
        for (std::size_t i = 0; i < state_.size(); ++i) state_[i] = ends.y[i] + ends.error[i];
        ends.evaluate(ends.t, state_.data(), rate_.data());
        filtered(rate_);
    }

    int n_, s_ = fewest, wanted_ = fewest;
    double enough_;
    const RadauTable* table_ = nullptr;
    Jacobian jacobian_;
    int pairs_ = 0;  ///< of second_order(jacobian)
    Shifted<double> real_;
    std::vector<Shifted<std::complex<double>>> complex_;
    Eigen::MatrixXd z_, f_, poly_, kept_,
        side_;  ///< n × s: stages, rates, polynomials of the last and of this step
    Eigen::VectorXd real_side_, real_solution_;
    Eigen::VectorXcd complex_side_;
    std::vector<Eigen::VectorXcd> complex_solution_;
    std::vector<double> state_, rate_, delta_;
    StepSize control_;
    Eigen::VectorXd power_;  ///< the direction that the last powers of ∂f/∂y have given
    double rounding_ = 0, largest_eigenvalue_ = 0;
    double factored_for_ = 0, step_of_poly_ = 0, ratio_ = 0;
    int steps_of_order_ = 0;
    bool has_jacobian_ = false, is_fresh_ = false, was_rejected_ = false, is_first_ = true;
};

using Radau5 = Radau<3, 3>;
using Radau9 = Radau<5, 5>;
using Radau13 = Radau<7, 7>;
using RadauOfAnyOrder = Radau<3, 7>;

}  // namespace alembert
