// SPDX-License-Identifier: MIT
#pragma once

/// Moves a state onto its constraints, by the least change in the metric of the mass matrix. It also computes
/// accelerations where the constraints nearly lose rank.
///
///     Projection project(module, values);
///     project(t, state);                     // state: q, u, and quadratures, which stay as they are
///     const Rhs rhs = project.guarded(make_rhs(module, values), values);
///     const Trajectory motion = integrate(System{.rhs = rhs, .project = project.after_steps()}, start, options);
///
/// Positions: δq = −M⁻¹Aᵀ (A M⁻¹Aᵀ)⁺ f, repeated until f stops shrinking; then rates: δq' follows from A q' + b in
/// the same way (Hairer & Wanner, Solving ODEs II, §VII.2). The mass-weighted norm leaves the motion along the
/// constraints alone. Where the speeds are not the rates, q' = S u + …, M and A S belong to the speeds: speeds are
/// moved as above, and positions along S. Where the speeds have eliminated the holonomic constraints, Aₑ S = 0,
/// any speeds obey these; positions are moved by −Aₑ⁺ f, the least change in the Euclidean metric. A step that
/// would not change the last bit of a number of size 1 is not taken.
///
/// If the emitted file has an unrolled step for this, that step is used, at the cost of one right-hand side. It
/// divides by the pivots of A M⁻¹Aᵀ, which vanish as the square of the distance to a pose where rows of A vanish
/// or depend on each other (linkages that lie flat). Where a pivot is less than 1e-5 of the largest value that it
/// has had, the projection and the guarded right-hand side solve (B Bᵀ + τ²) λ = r instead, with B = A L⁻ᵀ, M =
/// LLᵀ, and τ = 5e-5: directions that are held by a singular value σ below τ are not constrained, and inertia
/// carries the motion through the pose on its branch. Forces Bᵀλ do no work in motions that obey the constraints,
/// whatever λ is. In the moments where the constraints are not enforced the motion departs from them; the
/// projection then removes the departure and its energy, which is of second order. A smaller τ would gain nothing:
/// rounding of the positions, 1e-16, changes the rates that obey the constraints by 1e-16/σ².
///
/// Where M is singular, as with massless cranks, there is no L; the two are solved at once then, by
/// `SaddlePoint`. One object serves one thread, and one run after the other.

#include <Eigen/Dense>
#include <functional>
#include <vector>

#include "alembert/native/module.hpp"
#include "alembert/ode/rhs.hpp"
#include "alembert/ode/saddle_point.hpp"

namespace alembert {

/// C in M u' = f + Aᵀλ + C λ at a state: the forces that multipliers make besides those of the constraints, as dry
/// friction does. A row for each speed, a column for each constraint.
using ForcesOfMultipliers = std::function<Eigen::MatrixXd(double t, const double* state)>;

class Projection {
public:
    explicit Projection(const Module& module, const std::vector<double>& values = {});
    void operator()(double t, double* state);

    /// Takes other parameters, with what `prepare` makes of them: those of signs that a run holds may stand in
    /// rows.
    void hold(const std::vector<double>& par) { par_ = par; }

    /// This object as a function for System::project; empty if the speeds have eliminated all constraints and
    /// none is holonomic.
    std::function<void(double t, double* state)> after_steps();

    /// To be called before each run with its first state: the largest pivots of the last run, which may have
    /// failed, are no measure for the next. Because the run may begin in a singular pose, or near one, they begin
    /// with those of a pose beside the start, along its rates.
    void begin(double t, const double* start);

    /// The largest |f| and |A q' + b| at a state.
    double residual(double t, const double* state);

    /// The emitted right-hand side `rhs`, which has the parameters `values`; from states that were projected near
    /// a singular pose it takes the regularized solution above, with (B Bᵀ + B L⁻¹C + τ²) λ = r where multipliers
    /// make other forces. This object must outlive it and must not be moved.
    Rhs guarded(Rhs rhs, const std::vector<double>& values, ForcesOfMultipliers others = {});
    /// Writes this solution for u' if the state that was projected last is near a singular pose; false if it is
    /// not, or M is not positive definite. par: as the file's functions take it.
    bool accelerations(double t, const double* state, const double* par, const ForcesOfMultipliers& others,
                       double* acceleration);
    bool is_near_singular() const { return is_near_singular_; }

private:
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

    bool unrolled(double t, double* state);
    bool own_speeds() const { return module_.table().speed_names != nullptr; }
    Eigen::Map<const Rows> in_rates() const { return {rows_.data(), m_, n_}; }
    Eigen::Map<const Rows> in_speeds() const { return {rows_.data() + (own_speeds() ? all_ * n_ : 0), m_, s_}; }
    void evaluate(double t, const double* state) { evaluate(t, state, par_.data()); }
    void evaluate(double t, const double* state, const double* par);
    bool pivots_are_small();
    void forget();
    Eigen::VectorXd least(Eigen::MatrixXd B, Eigen::VectorXd r) const;
    Eigen::VectorXd multipliers(Eigen::MatrixXd across, Eigen::MatrixXd others, Eigen::VectorXd r) const;
    Eigen::VectorXd along_speeds(const Eigen::VectorXd& violation) const;
    Eigen::VectorXd in_positions(double t, const double* state) const;
    struct Guard;
    static void careful(const void* context, double t, const double* state, double* rate);

    Module module_;
    std::vector<double> par_;
    int n_, s_, m_, all_;  ///< coordinates, speeds, independent constraints, all of them
    Eigen::VectorXd position_, velocity_, forcing_, gamma_;
    Rows mass_;
    std::vector<double> rows_;  ///< A, followed, if the speeds are not the rates, by A in terms of the speeds
    std::vector<double> off_;   ///< f of all constraints, then A q' + b
    std::vector<double> moved_, violation_, pivots_,
        largest_pivots_;  // one for each constraint in the file's order
    SaddlePoint saddle_;  ///< measured where a pivot has grown
    bool is_near_singular_ = false, have_grown_ = false;
};

}  // namespace alembert
