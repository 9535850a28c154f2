// SPDX-License-Identifier: MIT
#pragma once

/// A mechanical system in terms of its momenta, for methods that advance momenta (rattle_step.hpp):
///
///     p = ∂L/∂q' = M(q,t) q' + p₀(q,t),   p' = F + Aᵀλ,   F = ∂L/∂q + Q,   f(q,t) = 0,   A = ∂f/∂q
///
/// Q are the loads that have no potential; if there are none and L does not depend on t, H = p·q' − L is
/// conserved. M is positive definite. States are (q, q'), n numbers each.
///
///     rhs.canonical = make_canonical(module, form, parameters);
///
/// There are two emitted files: `module` has the equations of motion, and `form` has M (lower triangle, row by
/// row), p and F as outputs, one after the other. A quaternion obeys e·e = 1 and has no inertia along e. Therefore
/// L in `form` contains ½ (row·q')² with the row of that constraint: it is zero in every motion and makes M
/// regular.

#include <functional>
#include <memory>
#include <vector>

#include "alembert/native/module.hpp"

namespace alembert {

struct HamiltonianSystem {
    int coordinates = 0;  ///< n
    int constraints = 0;  ///< m, all holonomic
    /// form: M, p, F as above, n (n + 1)/2 + 2n numbers.
    std::function<void(double t, const double* state, double* form)> form = {};
    /// f, A q' + ∂f/∂t, A (m×n, row by row); not called where m = 0.
    std::function<void(double t, const double* state, double* position, double* velocity, double* rows)> held = {};

    int form_size() const { return coordinates * (coordinates + 1) / 2 + 2 * coordinates; }
};

/// Throws std::invalid_argument if the two files do not fit together.
std::shared_ptr<const HamiltonianSystem> make_canonical(const Module& module, const Module& form,
                                                        const std::vector<double>& values = {});

}  // namespace alembert
