// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A periodic motion and its monodromy matrix, in any precision.
///
///     PeriodicSystem periodic(derived);
///     PeriodicMotion<double> motion = periodic.motion<double>(start, period);
///     periodic.shoot(motion);                              // until one period leads back to the start
///     periodic.monodromy(motion, 1e-10).Phi;               // over independent coordinates and speeds
///
/// With constraints the variational equations begin with a basis of the tangent space, one column for each
/// independent coordinate and speed, and the rows of these make the monodromy matrix: the equations keep
/// constraints and tangent space, so that nothing is lost.

#include <Eigen/Core>

#include "analysis/derive/derived.hpp"
#include "program/variation.hpp"
#include "stability/linear/tangent.hpp"

namespace alembert {

template <typename Real>
struct PeriodicMotion {
    std::vector<Real> parameters, x;  ///< coordinates, then speeds
    Real t = 0, period = 0;
    double closure_error = 0;  ///< |x(T) − x(0)|
};

/// The end of one period.
template <typename Real>
struct PeriodEnd {
    std::vector<Real> state;
    std::vector<Real> Phi;  ///< by columns, square, over the independent ones
    bool finished = true;
};

class PeriodicSystem {
public:
    /// Throws ModelError for contacts, and where the equations cannot be differentiated.
    explicit PeriodicSystem(const Derived& derived);

    const Program& program() const { return program_; }
    const Residuals& residuals() const { return residuals_; }
    bool autonomous() const { return autonomous_; }
    bool constrained() const { return residuals_.holonomic > 0 || residuals_.kept > 0; }
    /// Coordinates and speeds by name.
    std::vector<std::string> names() const;

    /// The start in doubles, and the period; 0: the scene's.
    template <typename Real>
    PeriodicMotion<Real> motion(const Start& start, double period) const;

    /// Newton's method: x (and the period of an autonomous system) so that x(T) = x; the shortest step. False
    /// where it does not converge.
    template <typename Real>
    bool shoot(PeriodicMotion<Real>& motion) const;

    template <typename Real>
    PeriodEnd<Real> monodromy(const PeriodicMotion<Real>& motion, double tolerance) const;

    /// Positions of the independent ones in x, as `monodromy` has them.
    template <typename Real>
    std::vector<int> independent(const PeriodicMotion<Real>& motion) const;

private:
    struct Frame {
        std::vector<int> rows;          ///< of the independent ones in x
        MatrixOf<long double> columns;  ///< of the tangent space; empty: unit vectors
        Instant<long double> at;
        Split split;
    };
    template <typename Real>
    Frame frame(const PeriodicMotion<Real>& motion) const;
    template <typename Real>
    bool settled(PeriodicMotion<Real>& motion) const;
    template <typename Real>
    void look_for_jumps(const PeriodicMotion<Real>& motion) const;

    const Derived& derived_;
    Program program_;
    Residuals residuals_;
    bool autonomous_;
};

/// Do the equations contain t, directly or by inputs?
bool changes_with_time(const Mechanism& mechanism, const Equations& equations);

}  // namespace alembert
