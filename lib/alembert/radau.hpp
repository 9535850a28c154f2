// SPDX-License-Identifier: MIT
#pragma once

/// Radau IIA of order 5, for stiff systems: three stages, the last of which is the end; L-stable.
///
///     Z_i = h Σ_j a_ij f(t + c_j h, y + Z_j),   y₁ = y + Z₃,   c = (4 − √6)/10, (4 + √6)/10, 1
///
/// Simplified Newton with one ∂f/∂y (by differences): with A⁻¹ = V diag(λ) V⁻¹ and W = V⁻¹Z the 3n equations fall apart
/// into one real and one complex system of n, (λ_k/h − J) ΔW_k = …. A, its inverse and V are computed from c when the
/// step is made, so that no digits of them stand here.
///
/// Error: (I − hγ₀J)⁻¹ (γ₀ h f(t, y) + Σ e_i Z_i), the difference to a formula of order 3 whose weights follow from its
/// order conditions, γ₀ = 1/λ_real; after a first step or a rejection filtered once more. Dense output: the collocation
/// polynomial, order 3. The factorizations serve again while h grows by less than a fifth and ∂f/∂y while the iteration
/// contracts well.
///
/// Source: Hairer & Wanner, Solving Ordinary Differential Equations II, 2nd ed. 1996, §IV.5 and §IV.8.

#include <array>
#include <complex>

#include "alembert/newton.hpp"
#include "alembert/step_size.hpp"

namespace alembert {

class Radau {
public:
    static constexpr bool has_fixed_step = false;
    static constexpr Between between = Between::own;
    static constexpr int estimate_order = 4;

    Radau(const Ends& ends, double tolerance)
        : n_(ends.size),
          enough_(std::max(1e-2 * tolerance, 4e-16)),
          jacobian_(n_),
          real_(n_),
          complex_(n_),
          z_(n_, 3),
          f_(n_, 3),
          poly_(Eigen::MatrixXd::Zero(n_, 3)),
          kept_(poly_),
          side_(n_, 3),
          real_side_(n_),
          real_solution_(n_),
          complex_side_(n_),
          complex_solution_(n_),
          state_(static_cast<std::size_t>(n_)),
          rate_(state_.size()),
          control_(estimate_order) {
        const double root = std::sqrt(6.0);
        c_ << (4 - root) / 10, (4 + root) / 10, 1;
        Eigen::Matrix3d powers, integrals;
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k) {
                powers(i, k) = std::pow(c_[i], k);
                integrals(i, k) = std::pow(c_[i], k + 1) / (k + 1);
            }
        const Eigen::Matrix3d inverse = powers * integrals.inverse();
        const Eigen::EigenSolver<Eigen::Matrix3d> eigen(inverse);
        int real = 0;
        for (int k = 1; k < 3; ++k)
            if (std::abs(eigen.eigenvalues()[k].imag()) < std::abs(eigen.eigenvalues()[real].imag())) real = k;
        const int other = real == 0 ? 1 : 0;
        lambda_ = eigen.eigenvalues()[real].real();
        mu_ = eigen.eigenvalues()[other];
        const Eigen::Matrix3cd V = eigen.eigenvectors(), back = V.inverse();
        // Z = w v + 2 Re(u V_other), as the third is conjugate to the second.
        v_real_ = (V.col(real) / V(2, real)).real();
        back_real_ = (back.row(real) * V(2, real)).real().transpose();
        v_complex_ = V.col(other);
        back_complex_ = back.row(other).transpose();
        inverse_ = inverse;
        // Σ b̂_i c_i^k = 1/(k+1), less γ₀ for k = 0; h f_i = Σ (A⁻¹)_ij Z_j.
        const Eigen::Vector3d moments(1 - 1 / lambda_, 1. / 2, 1. / 3);
        const Eigen::Vector3d weights = powers.transpose().inverse() * moments;
        e_ = inverse.transpose() * weights - Eigen::Vector3d(0, 0, 1);
    }

    int most_evaluations() const { return n_ + 3 * most_rounds + 1; }

    bool increment(Ends& ends, double h, double* change, double*) {
        if (!has_jacobian_) {
            jacobian_.evaluate(ends);
            has_jacobian_ = is_fresh_ = true;
            factored_for_ = 0;
        }
        if (!(std::abs(h - factored_for_) <= 1e-9 * h)) factorize(h);
        forecast(h);
        if (!solve(ends, h)) {
            has_jacobian_ = has_jacobian_ && is_fresh_;
            was_rejected_ = true;
            return false;
        }
        for (int i = 0; i < n_; ++i) change[i] = z_(i, 2);
        estimate(ends, h);
        return true;
    }

    void finished(const Ends& ends) {
        // y + θ-polynomial through (c_i, Z_i), which is zero at θ = 0: Z = θ (p₀ + p₁θ + p₂θ²); its end is where a
        // projection has moved it.
        Eigen::Matrix3d at;
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k) at(i, k) = std::pow(c_[i], k + 1);
        for (int i = 0; i < n_; ++i) {
            const auto k = static_cast<std::size_t>(i);
            z_(i, 2) = (ends.next[k] - ends.y[k]) + (ends.next_rest[k] - ends.rest[k]);
        }
        kept_.noalias() = z_ * at.inverse().transpose();
    }

    void interpolate(const Ends& ends, double theta, double* out) const {
        for (int i = 0; i < n_; ++i) {
            const auto k = static_cast<std::size_t>(i);
            out[i] = ends.y[k] +
                     (theta * (kept_(i, 0) + theta * (kept_(i, 1) + theta * kept_(i, 2))) + ends.rest[k]);
        }
    }

    void advance(const Ends& ends) {
        poly_ = kept_;
        step_of_poly_ = ends.h;
        is_fresh_ = false;
        if (ratio_ > 1e-3) has_jacobian_ = false;
        was_rejected_ = is_first_ = false;
    }

    double next_length(const Ends& ends, bool accepted, double ratio) {
        const double h = ends.h;
        if (!accepted) {
            was_rejected_ = true;
            if (!is_fresh_) has_jacobian_ = false;
            return control_.after_rejected(h, ratio);
        }
        const double next = control_.after_accepted(h, ratio);
        return has_jacobian_ && next >= h && next <= 1.2 * h ? h : next;
    }

private:
    static constexpr int most_rounds = 10;
    using Complex = std::complex<double>;

    void factorize(double h) {
        for (int j = 0; j < n_; ++j)
            for (int i = 0; i < n_; ++i) {
                real_.values(i, j) = (i == j ? lambda_ / h : 0) - jacobian_.values(i, j);
                complex_.values(i, j) = (i == j ? mu_ / h : Complex(0)) - jacobian_.values(i, j);
            }
        real_.lu.compute(real_.values);
        complex_.lu.compute(complex_.values);
        factored_for_ = h;
    }

    /// The polynomial of the last step goes on; zero before there is one.
    void forecast(double h) {
        z_.setZero();
        if (step_of_poly_ == 0) return;
        for (int k = 0; k < 3; ++k) {
            const double theta = 1 + c_[k] * h / step_of_poly_;
            for (int i = 0; i < n_; ++i) {
                const double end = poly_(i, 0) + poly_(i, 1) + poly_(i, 2);
                z_(i, k) = theta * (poly_(i, 0) + theta * (poly_(i, 1) + theta * poly_(i, 2))) - end;
            }
        }
    }

    bool solve(Ends& ends, double h) {
        Contraction contraction(enough_, most_rounds);
        for (;;) {
            for (int k = 0; k < 3; ++k) {
                for (int i = 0; i < n_; ++i) {
                    const auto at = static_cast<std::size_t>(i);
                    state_[at] = ends.y[at] + (z_(i, k) + ends.rest[at]);
                }
                ends.evaluate(ends.t + c_[k] * h, state_.data(), f_.col(k).data());
            }
            side_.noalias() = z_ * inverse_.transpose();
            side_ = f_ - side_ / h;
            for (int i = 0; i < n_; ++i) {
                real_side_[i] = 0;
                complex_side_[i] = 0;
                for (int k = 0; k < 3; ++k) {
                    real_side_[i] += side_(i, k) * back_real_[k];
                    complex_side_[i] += side_(i, k) * back_complex_[k];
                }
            }
            real_solution_ = real_.lu.solve(real_side_);
            complex_solution_ = complex_.lu.solve(complex_side_);
            double largest = 0;
            for (int k = 0; k < 3; ++k) {
                for (int i = 0; i < n_; ++i) {
                    const double delta =
                        v_real_[k] * real_solution_[i] + 2 * (v_complex_[k] * complex_solution_[i]).real();
                    z_(i, k) += delta;
                    state_[static_cast<std::size_t>(i)] = delta;
                }
                largest = std::max(largest, ends.norm(state_.data()));
            }
            const auto verdict = contraction.after(largest);
            ratio_ = contraction.rounds() > 1 ? contraction.ratio() : 0;
            if (verdict == Contraction::done) return true;
            if (verdict == Contraction::hopeless) return false;
        }
    }

    /// (I − hγ₀J)⁻¹ x = (λ/h − J)⁻¹ (λ/h) x.
    void estimate(Ends& ends, double h) {
        const auto filtered = [&](const std::vector<double>& rate) {
            for (int i = 0; i < n_; ++i)
                real_side_[i] = rate[static_cast<std::size_t>(i)] +
                                lambda_ / h * (e_[0] * z_(i, 0) + e_[1] * z_(i, 1) + e_[2] * z_(i, 2));
            real_solution_ = real_.lu.solve(real_side_);
            for (int i = 0; i < n_; ++i) ends.error[static_cast<std::size_t>(i)] = real_solution_[i];
        };
        filtered(ends.rate);
        if (!is_first_ && !was_rejected_) return;
        for (std::size_t i = 0; i < state_.size(); ++i) state_[i] = ends.y[i] + ends.error[i];
        ends.evaluate(ends.t, state_.data(), rate_.data());
        filtered(rate_);
    }

    template <class Matrix>
    struct Factored {
        explicit Factored(int n) : values(n, n), lu(n) {}
        Matrix values;
        Eigen::PartialPivLU<Matrix> lu;
    };

    int n_;
    double enough_;
    Jacobian jacobian_;
    Factored<Eigen::MatrixXd> real_;
    Factored<Eigen::MatrixXcd> complex_;
    Eigen::MatrixXd z_, f_, poly_, kept_, side_;  ///< n × 3: stages, rates, polynomials of the last and of this step
    Eigen::VectorXd real_side_, real_solution_;
    Eigen::VectorXcd complex_side_, complex_solution_;
    std::vector<double> state_, rate_;
    StepSize control_;
    double lambda_ = 0;
    Complex mu_;
    Eigen::Matrix3d inverse_;
    Eigen::Vector3d c_, v_real_, back_real_, e_;
    Eigen::Vector3cd v_complex_, back_complex_;
    double factored_for_ = 0, step_of_poly_ = 0, ratio_ = 0;
    bool has_jacobian_ = false, is_fresh_ = false, was_rejected_ = false, is_first_ = true;
};

}  // namespace alembert
