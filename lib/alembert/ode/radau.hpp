// SPDX-License-Identifier: MIT
#pragma once

/// Radau IIA of 3, 5 and 7 stages (orders 5, 9 and 13), for stiff systems; the last stage is the end; L-stable.
///
///     Z_i = h Σ_j a_ij f(t + c_j h, y + Z_j),   y₁ = y + Z_s
///
/// The equations are solved by the simplified Newton method with one ∂f/∂y, the emitted one if there is one
/// (newton_iteration.hpp). In the basis of the eigenvectors of A⁻¹ the s n equations decouple into one real and (s
/// − 1)/2 complex systems of n, (λ_k/h − J) ΔW_k = … (radau_table.hpp).
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

#include "alembert/ode/newton_iteration.hpp"
#include "alembert/ode/radau_stages.hpp"
#include "alembert/ode/radau_table.hpp"
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
          complex_((most - 1) / 2, ShiftedLinearSolver<std::complex<double>>(n_)),
          stages_(n_),
          side_(n_),
          solution_(n_),
          complex_side_(static_cast<std::size_t>(n_)),
          complex_solution_(complex_side_.size()),
          state_(complex_side_.size()),
          rate_(state_.size()),
          control_(estimate_order) {
        take(fewest);
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
        stages_.forecast(h / step_of_polynomial_);
        if (!solve(ends, h)) {
            has_jacobian_ = has_jacobian_ && is_fresh_;
            was_rejected_ = true;
            step_down();
            return false;
        }
        std::copy_n(stages_.change(s_ - 1), n_, change);
        estimate(ends, h);
        return true;
    }

    void finished(const Ends& ends) {
        // The end of the step is where a projection has moved it.
        double* const last = stages_.change(s_ - 1);
        for (std::size_t k = 0; k < state_.size(); ++k)
            last[k] = (ends.next[k] - ends.y[k]) + (ends.next_rest[k] - ends.rest[k]);
        stages_.find_polynomial();
    }

    void interpolate(const Ends& ends, double theta, double* out) const {
        for (int i = 0; i < n_; ++i) {
            const auto k = static_cast<std::size_t>(i);
            out[i] = ends.y[k] + (stages_.between(i, theta) + ends.rest[k]);
        }
    }

    void advance(const Ends& ends) {
        stages_.advance();
        step_of_polynomial_ = ends.h;
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
        stages_.take(*table_);
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
                side_[i] = (i % period == 0 ? half_epsilon : -half_epsilon) * sum;
            }
            real_.solve(side_.data(), solution_.data());
            rounding_ = std::max(rounding_, ends.norm(solution_.data()));
        }
        if (!std::isfinite(rounding_)) rounding_ = 0;
    }

    /// The fourth root of ‖J⁴v‖/‖v‖, v being what is left of the last vectors.
    void find_largest_eigenvalue() {
        double growth = 1;
        for (int round = 0; round < 4; ++round) {
            solution_.noalias() = jacobian_.values * power_;
            const double size = solution_.norm();
            if (!(size > 0) || !std::isfinite(size)) {
                power_.setOnes();
                power_ /= power_.norm();
                break;
            }
            growth *= size;
            power_ = solution_ / size;
        }
        largest_eigenvalue_ = std::sqrt(std::sqrt(growth));
    }

    bool solve(Ends& ends, double h) {
        NewtonIteration iteration(std::max(enough_, rounding_), s_ + 7, std::max(rounding_, least_rounding));
        double* const scale = stages_.scale();
        for (int i = 0; i < ends.controlled; ++i)
            scale[i] = 1 / std::max(1.0, std::abs(ends.y[static_cast<std::size_t>(i)]));
        for (;;) {
            for (int k = 0; k < s_; ++k) {
                const double* const change = stages_.change(k);
                for (std::size_t i = 0; i < state_.size(); ++i) state_[i] = ends.y[i] + (change[i] + ends.rest[i]);
                ends.evaluate(ends.t + table_->c[k] * h, state_.data(), stages_.rate(k));
            }
            const auto verdict = iteration.after(correct(h));
            ratio_ = iteration.ratio();
            if (verdict == NewtonIteration::more) continue;
            return verdict == NewtonIteration::done;
        }
    }

    /// Changes all stages once and returns the size of the change.
    double correct(double h) {
        stages_.find_sides(1 / h);
        real_.solve(stages_.side(0), stages_.solution(0));
        for (int pair = 0; 2 * pair + 1 < s_; ++pair) {
            const double *const real = stages_.side(2 * pair + 1), *const imaginary = stages_.side(2 * pair + 2);
            for (std::size_t i = 0; i < complex_side_.size(); ++i) complex_side_[i] = {real[i], imaginary[i]};
            complex_[static_cast<std::size_t>(pair)].solve(complex_side_.data(), complex_solution_.data());
            double *const of_real = stages_.solution(2 * pair + 1), *const of_imaginary =
                                                                        stages_.solution(2 * pair + 2);
            for (std::size_t i = 0; i < complex_side_.size(); ++i) {
                of_real[i] = complex_solution_[i].real();
                of_imaginary[i] = complex_solution_[i].imag();
            }
        }
        return stages_.correct();
    }

    /// (I − hγ₀J)⁻¹ x = (λ/h − J)⁻¹ (λ/h) x.
    void estimate(Ends& ends, double h) {
        const auto filtered = [&](const std::vector<double>& rate) {
            stages_.find_error(side_.data());
            for (int i = 0; i < n_; ++i)
                side_[i] = table_->lambda / h * side_[i] + rate[static_cast<std::size_t>(i)];
            real_.solve(side_.data(), ends.error.data());
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
    ShiftedLinearSolver<double> real_;
    std::vector<ShiftedLinearSolver<std::complex<double>>> complex_;
    RadauStages stages_;
    Eigen::VectorXd side_, solution_;
    std::vector<std::complex<double>> complex_side_, complex_solution_;
    std::vector<double> state_, rate_;
    StepSize control_;
    Eigen::VectorXd power_;  ///< the direction that the last powers of ∂f/∂y have given
    double rounding_ = 0, largest_eigenvalue_ = 0;
    double factored_for_ = 0, step_of_polynomial_ = 0, ratio_ = 0;
    int steps_of_order_ = 0;
    bool has_jacobian_ = false, is_fresh_ = false, was_rejected_ = false, is_first_ = true;
};

using Radau5 = Radau<3, 3>;
using Radau9 = Radau<5, 5>;
using Radau13 = Radau<7, 7>;
using RadauOfAnyOrder = Radau<3, 7>;

}  // namespace alembert
