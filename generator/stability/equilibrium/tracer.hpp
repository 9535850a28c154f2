// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// One curve of equilibria over a parameter, step by step (pseudo-arclength continuation).
///
///     const Tracer tracer(problem, path, span);
///     auto here = tracer.at_parameter(root.at, 2.0);
///     auto next = tracer.step(*here, 0.01);             // along here->tangent
///
/// A point is y = (q/scale, p/span). With the unit tangent T of the curve F(y) = 0 at a point y₀, the next one
/// solves
///     F(y) = 0,     T·(y − y₀) = σ,
/// which is regular at folds too. (Keller, in Applications of Bifurcation Theory (1977), 359; Govaerts, Numerical
/// Methods for Bifurcations of Dynamical Equilibria (2000), chapter 2.)

#include <functional>

#include "stability/linear/steady.hpp"

namespace alembert {

struct TracedPoint {
    Instant<long double> at;
    double p = 0;
    VectorOf<long double> tangent;  ///< the tangent in y (coordinates, then the parameter), of length 1
    Split split;
    long double turn = 0;  ///< det [F_y; Tᵀ]: it changes sign where curves cross; NaN if unknown
    long double step = 0;  ///< σ from the point before
};

/// F_y at a point.
struct TracedSystem {
    SteadySystem system;
    MatrixOf<long double> by;    ///< the derivatives with respect to the unknowns, then p/span
    MatrixOf<long double> lift;  ///< the change of y for a change of these
};

class Tracer {
public:
    /// `path` gives parameters, given speeds and inputs at a value of the parameter.
    Tracer(const SteadyProblem& problem, std::function<Instant<long double>(double)> path, double span)
        : problem_(problem), path_(std::move(path)), span_(span) {}

    const SteadyProblem& problem() const { return problem_; }
    double span() const { return span_; }

    /// The root at this value of the parameter that Newton's method reaches, with its tangent toward larger p.
    std::optional<TracedPoint> at_parameter(const Instant<long double>& guess, double p) const;

    /// A step of length σ from a point along `direction`, or along its tangent if that is missing. Nothing if
    /// Newton's method does not converge.
    std::optional<TracedPoint> step(const TracedPoint& from, long double sigma,
                                    const VectorOf<long double>* direction = nullptr) const;

    /// `turn` of a point, computed with the independent coordinates of another.
    long double turn_by(const TracedPoint& point, const Split& split) const;

    TracedSystem linearized_at(const Instant<long double>& at, double p, const Split* split = nullptr) const;
    /// The rows of F_y except those of the forces of cyclic coordinates, which vanish identically.
    MatrixOf<long double> independent_rows(const TracedSystem& system) const;
    VectorOf<long double> place(const Instant<long double>& at, double p) const;  ///< y
    /// These rows of F after the unknowns and p/span have changed by `change` along the constraints.
    std::optional<VectorOf<long double>> moved(const TracedPoint& point,
                                               const VectorOf<long double>& change) const;

private:
    Instant<long double> with(const Instant<long double>& at, double p) const;
    void finish(TracedPoint& point, const VectorOf<long double>& direction) const;
    long double turn_of(const TracedSystem& system, const VectorOf<long double>& tangent) const;

    const SteadyProblem& problem_;
    std::function<Instant<long double>(double)> path_;
    double span_;
};

}  // namespace alembert
