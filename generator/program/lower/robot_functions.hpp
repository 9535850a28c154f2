// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Functions that control, identification and planning of robots ask for, each as a program of its own.
///
///     const RobotFunctions functions(mechanism, {.fold = false});
///     const FunctionProgram tau = functions.dynamics("inverse");      // n values in q, q', q'', t
///
/// With the generalized forces Q(q, q', t) of springs, dampers and applied loads,
///     M(q) q'' + C(q, q') q' + g(q) = Q + τ + Aᵀλ,
/// where τ are the loads of drives, and Aᵀλ is absent in scenes without constraints:
///
///     inverse   M q'' + C q' + g − Q, n values: τ, with constraints τ + Aᵀλ
///     mass      M, n × n
///     bias      C q' + g − Q, n values: what `inverse` is at q'' = 0
///     gravity   g, n values
///     loads     Q, n values
///     inverse_jacobian   ∂/∂q and ∂/∂q' of `inverse`, n × 2n; ∂/∂q'' is M
///     mass_inverse       M⁻¹, n × n
///     coriolis  C(q, q'), n × n, by Christoffel's symbols of M, so that M' − 2C is skew
///
/// Several forms compete, and that with the fewest operations is taken: the recursions over a tree of joints along
/// axes that turn with the links or that do not, and for few coordinates or without a tree Lagrange's equations.
/// The derivatives of inverse dynamics are those of its program by elimination, or a closed form
/// (inverse_partials.hpp).

#include <optional>

#include "model/formalism/joint_tree.hpp"
#include "model/mechanism.hpp"
#include "program/named_function.hpp"

namespace alembert {

class RobotFunctions {
public:
    /// Throws ModelError for friction whose normal forces are not given. With `fold`, parameters are constants.
    RobotFunctions(const Mechanism& mechanism, bool fold);

    /// The names above, in this order.
    static const std::vector<std::string>& of_dynamics();
    /// For one of these names. Throws ModelError where M is singular or derivatives are too long, for
    /// `mass_inverse` and `coriolis` of a scene with quaternions, and for `gravity` and `loads` of a scene that
    /// gives its potential or Lagrangian by a formula, in which gravity is not told apart.
    FunctionProgram dynamics(const std::string& name) const;

private:
    FunctionProgram inverse_jacobian() const;
    std::optional<std::pair<Program, std::vector<int>>> closed_inverse_jacobian() const;
    FunctionProgram mass_inverse() const;
    FunctionProgram coriolis() const;
    std::optional<Program> christoffel() const;
    std::optional<Program> half_of_bias_by_rates(LinkAxes axes) const;
    std::vector<Program> tree_forms(const std::string& name) const;
    Program by_expressions(const std::vector<GiNaC::ex>& values) const;
    Program from_lagrange(const std::string& name) const;

    Mechanism m_;
    bool fold_;
    std::optional<JointTree> tree_;
};

}  // namespace alembert
