// SPDX-License-Identifier: MIT
#pragma once

/// Moves a state to its constraints, by the least change in the metric of the mass matrix.
///
///     Projection project(module, values);
///     project(t, state);                     // state: q, u, and quadratures, which stay as they are
///
/// Positions: δq = −M⁻¹Aᵀ (A M⁻¹Aᵀ)⁺ f, repeated until f stops shrinking; then rates: δq' the same of A q' + b
/// (Hairer & Wanner, Solving ODEs II, §VII.2). Where the speeds are not the rates M belongs to the speeds: then these are
/// moved in its metric, positions in the plain one. The mass-weighted norm leaves the motion along the constraints alone; the
/// pseudo-inverse takes redundant rows in its stride. One object serves one thread.

#include <Eigen/Dense>
#include <vector>

#include "alembert/module.hpp"

namespace alembert {

class Projection {
public:
    explicit Projection(const Module& module, const std::vector<double>& values = {});
    void operator()(double t, double* state);

    /// The largest |f| and |A q' + b| at a state.
    double residual(double t, const double* state);

private:
    void evaluate(double t, const double* state);
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    Eigen::VectorXd correction(const Rows& A, bool weighed, const Eigen::VectorXd& misfit) const;

    Module module_;
    std::vector<double> par_;
    int n_, s_, m_;  ///< coordinates, speeds, constraints
    Eigen::VectorXd position_, velocity_, forcing_;
    Rows mass_;
    std::vector<double> rows_;  ///< A; where the speeds are not the rates, then A in speeds
};

}  // namespace alembert
