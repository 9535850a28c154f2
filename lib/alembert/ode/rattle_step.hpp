// SPDX-License-Identifier: MIT
#pragma once

/// RATTLE for holonomic constraints and any mass matrix: symplectic, symmetric, on the constraints at the end of
/// each step.
///
///     P  = p + h/2 (F(q, v) + A(q)ᵀλ),      M(q) v + p₀(q) = P           v: the rates that belong to (q, P)
///     q₁ = q + h/2 (v + w),                 M(q₁) w + p₀(q₁) = P         w: of (q₁, P); f(q₁) = 0 determines λ
///     p₁ = P + h/2 (F(q₁, w) + A(q₁)ᵀμ),    M(q₁) u₁ + p₀(q₁) = p₁       A(q₁) u₁ + ∂f/∂t = 0 determines μ
///
/// with p, F and A of hamiltonian_system.hpp at t (first line) and t + h. This is the two-stage Lobatto IIIA-IIIB
/// pair for q' = H_p(p, q), p' = −H_q(p, q) − Aᵀλ, of order 2 (Jay); for constant M and forces that do not depend
/// on rates it is Andersen's RATTLE; without constraints it is the Störmer-Verlet method. Loads outside V enter as
/// in a forced discrete Lagrangian. The equations of a step are solved until the changes no longer shrink:
/// Newton's method for λ, with A(q₁) (M(q)⁻¹ + M(q₁)⁻¹) A(q)ᵀ h²/4, together with a fixed-point iteration for what
/// depends on rates through M and F, which contracts as long as M and F change little in a step.
///
/// `rattle8` composes 17 such steps, with the lengths of Kahan and Li (symplectic_composition.hpp), to a method of
/// order 8.
///
/// Quadratures are integrated by the trapezoidal rule, with one evaluation of the right-hand side for each
/// substep. A state within a step is the end of a shorter step, so that it too obeys the constraints.
///
/// Sources: Hairer, Lubich, Wanner, Geometric Numerical Integration, 2nd ed. 2006, §VII.1.4, (1.26)-(1.27); L.
/// Jay, SIAM J. Numer. Anal. 33 (1996) 368-387; H. C. Andersen, J. Comput. Phys. 52 (1983) 24-34.

#include <Eigen/Dense>

#include "alembert/ode/formula_stepper.hpp"
#include "alembert/ode/hamiltonian_system.hpp"
#include "alembert/ode/symplectic_composition.hpp"

namespace alembert {

/// One step of length h from (q, q') in `state`, which it replaces; false if its equations were not solved.
class RattleStep {
public:
    explicit RattleStep(const HamiltonianSystem& system);
    bool operator()(double t, double h, double* state);
    long evaluations() const { return evaluations_; }
    static constexpr int most_evaluations = 2 * 50 + 2;

private:
    using Vector = Eigen::VectorXd;
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

    /// The values at one end of the step.
    struct Side {
        Eigen::MatrixXd M;
        Eigen::LLT<Eigen::MatrixXd> factors;
        Vector p, free, F, position, velocity;  ///< free: p₀
        Rows A;
    };

    bool evaluate(Side& side, double t, const Vector& q, const Vector& v);
    void hold(Side& side, double t, const Vector& q, const Vector& v);

    const HamiltonianSystem& system_;
    Eigen::Index n_, m_;
    Side here_, there_;
    Vector q_, u_, v_, w_, end_, before_, lambda_, impulse_;
    std::vector<double> state_, form_;
    double longest_ = 0;
    long evaluations_ = 0;
};

template <const auto& lengths>
class RattleComposition {
public:
    static constexpr bool has_fixed_step = true, keeps_constraints = true;
    static constexpr Between between = Between::shorter_step;

    RattleComposition(const Ends& ends, double /*tolerance*/)
        : step_(*ends.rhs.canonical),
          n_(static_cast<std::size_t>(ends.rhs.canonical->coordinates)),
          state_(ends.y.size()) {}

    int most_evaluations() const { return (RattleStep::most_evaluations + 1) * static_cast<int>(lengths.size()); }

    bool increment(Ends& ends, double h, double* change, double* end_rate) {
        const std::size_t size = ends.y.size();
        for (std::size_t i = 0; i < size; ++i) state_[i] = ends.y[i] + ends.rest[i];
        std::fill_n(change, size, 0.0);
        std::copy(ends.rate.begin(), ends.rate.end(), end_rate);
        const long before = step_.evaluations();
        double t = ends.t;
        bool solved = true;
        for (const double length : lengths) {
            const double step = length * h;
            for (std::size_t i = 2 * n_; i < size; ++i) change[i] += step / 2 * end_rate[i];
            solved = solved && step_(t, step, state_.data());
            t += step;
            if (!solved || size == 2 * n_) continue;
            for (std::size_t i = 2 * n_; i < size; ++i) state_[i] = ends.y[i] + (change[i] + ends.rest[i]);
            ends.evaluate(t, state_.data(), end_rate);
            for (std::size_t i = 2 * n_; i < size; ++i) change[i] += step / 2 * end_rate[i];
        }
        for (std::size_t i = 0; i < 2 * n_; ++i) change[i] = (state_[i] - ends.y[i]) - ends.rest[i];
        ends.evaluations += step_.evaluations() - before;
        return solved;
    }

private:
    RattleStep step_;
    std::size_t n_;
    std::vector<double> state_;
};

using Rattle = RattleComposition<verlet_lengths>;
using Rattle8 = RattleComposition<kahan_li_8_lengths>;

}  // namespace alembert
