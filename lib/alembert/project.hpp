// SPDX-License-Identifier: MIT
#pragma once

/// Moves a state to its constraints, by the least change in the metric of the mass matrix; and accelerations where
/// the constraints nearly lose rank.
///
///     Projection project(module, values);
///     project(t, state);                     // state: q, u, and quadratures, which stay as they are
///     const Rhs rhs = project.guarded(make_rhs(module, values));
///
/// Positions: δq = −M⁻¹Aᵀ (A M⁻¹Aᵀ)⁺ f, repeated until f stops shrinking; then rates: δq' the same of A q' + b
/// (Hairer & Wanner, Solving ODEs II, §VII.2). The mass-weighted norm leaves the motion along the constraints
/// alone. Where the speeds are not the rates, q' = S u + …, M and A S belong to the speeds: these are moved as
/// above, and positions along S. Where the speeds have eliminated the holonomic constraints, Aₑ S = 0, these hold
/// in speeds by themselves; positions are moved by Aₑ⁺ f, the least change in the plain metric. A step that would
/// not change the last bit of a number of size 1 is not taken.
///
/// Where the file has it, its own unrolled step does that, for the price of a right-hand side. That divides by the
/// pivots of A M⁻¹Aᵀ, which vanish as the square of the distance to a pose where rows of A vanish or depend on
/// each other (linkages that lie flat). Where one is less than 1e-5 of the largest that it has been, projection
/// and guarded right-hand side solve (B Bᵀ + τ²) λ = r instead, with B = A L⁻ᵀ, M = LLᵀ, and τ = 5e-5: directions
/// that are held by less than τ are left to inertia, which carries the motion through on the branch that it is on.
/// Forces Bᵀλ of whatever λ do no work in motions that obey the constraints; what strays from these in the moments
/// where they do not hold is taken off, with its energy, which is of second order. Smaller τ would gain nothing:
/// rounding of the positions, 1e-16, moves the rates that obey them by 1e-16/σ². One object serves one thread, and
/// one run after the other.

#include <Eigen/Dense>
#include <functional>
#include <vector>

#include "alembert/module.hpp"
#include "alembert/rhs.hpp"

namespace alembert {

class Projection {
public:
    explicit Projection(const Module& module, const std::vector<double>& values = {});
    void operator()(double t, double* state);

    /// This object as Options::project wants it; nothing where the speeds have eliminated all constraints and none
    /// is holonomic.
    std::function<void(double t, double* state)> after_steps();

    /// Before another run: what was large in the last one, which may have gone astray, is no measure for this one.
    void forget();

    /// The largest |f| and |A q' + b| at a state.
    double residual(double t, const double* state);

    /// The emitted right-hand side `rhs`, by the careful way from states that were projected near a singular pose.
    /// This object must outlive it and stay where it is.
    Rhs guarded(Rhs rhs);
    bool is_near_singular() const { return is_near_singular_; }

private:
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

    bool unrolled(double t, double* state);
    bool own_speeds() const { return module_.table().speed_names != nullptr; }
    Eigen::Map<const Rows> in_rates() const { return {rows_.data(), m_, n_}; }
    Eigen::Map<const Rows> in_speeds() const { return {rows_.data() + (own_speeds() ? m_ * n_ : 0), m_, s_}; }
    void evaluate(double t, const double* state);
    bool pivots_are_small();
    Eigen::VectorXd least(Eigen::MatrixXd B, Eigen::VectorXd r) const;
    Eigen::VectorXd along_speeds(const Eigen::VectorXd& misfit) const;
    Eigen::VectorXd in_positions(double t, const double* state) const;
    bool accelerations(double t, const double* state, double* acceleration);
    static void careful(const void* context, double t, const double* state, double* rate);

    Module module_;
    std::vector<double> par_;
    int n_, s_, m_;  ///< coordinates, speeds, constraints
    Eigen::VectorXd position_, velocity_, forcing_, gamma_;
    Rows mass_;
    std::vector<double> rows_;  ///< A; where the speeds are not the rates, then A in speeds
    std::vector<double> moved_, misfit_, pivots_, largest_pivots_;  // of each constraint one, as the file has it
    bool is_near_singular_ = false;
};

}  // namespace alembert
