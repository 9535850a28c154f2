// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The equations of motion and their first derivatives at one state, in independent coordinates and speeds: the
/// algebra of stability/linear/linearize.hpp, for any state and any floating-point type.
///
///     const Residuals residuals(mechanism, equations);           // one Program for all of them
///     const Split split = split_of(residuals, instant, …); // which coordinates and speeds are independent
///     const Tangent<long double> at = tangent(residuals, split, instant);
///     at.mass, at.force                                          // mass δw' + force (δr, δw, δx) = 0

#include <Eigen/Core>
#include <string>
#include <vector>

#include "model/formalism/equations.hpp"
#include "program/interpret.hpp"
#include "program/jet.hpp"

namespace alembert {

/// How many places of kind `unknown` there are up to the last of these inputs.
inline std::size_t input_places(const std::vector<int>& inputs) {
    return inputs.empty() ? 0 : static_cast<std::size_t>(inputs.back()) + 1;
}

/// Everything that the algebra needs as one Program. Its variables of kind `unknown` are the inputs that occur.
struct Residuals {
    /// If `at_rest` names speeds, they are 0 in M, f, A and γ, whose derivatives by them are 0 then: a much
    /// shorter program for the balance of a steady motion (Undisturbed::steady) in which these speeds are 0 and
    /// stay so.
    Residuals(const Mechanism& mechanism, const Equations& equations, const std::vector<bool>& at_rest = {});

    Program program;
    int n, s, holonomic, kept;  ///< coordinates, speeds, rows of φ, rows of A
    int states;                 ///< how many of the speeds, the last ones, are first-order states of the scene
    std::vector<int> mass, forcing, row, gamma, rate, position, velocity;
    std::vector<int> inputs;  ///< 3·index + order of the inputs that occur
    /// How many unknowns of the program there are, with those that do not occur.
    std::size_t input_places() const { return alembert::input_places(inputs); }
    std::vector<int> input_values;  ///< nodes, in parameters and t
    std::vector<int> geometry;      ///< all nodes that `position` and `velocity` need
    std::vector<int> steady;        ///< all nodes that the balance of a steady motion needs
    bool rates_are_speeds;
    bool steady_needs_mass;  ///< whether speeds must change (γ is not 0) where the independent ones do not
};

template <typename Real>
struct Instant {
    std::vector<Real> parameters, q, u, inputs;
    Real t = 0;
};

/// The instant of a state of the equations; inputs have the values of its time.
template <typename Real>
Instant<Real> instant_of(const Residuals& residuals, const State<double>& state);

/// The state with a unit derivative for each of q, u, t and the inputs, in this order; a caller with more
/// variables can append them. `unknowns` is the number of unknowns to provide for.
template <typename Real>
struct Varied {
    Varied(const Residuals& residuals, const Instant<Real>& at, std::size_t unknowns);
    /// A value with a unit derivative with respect to the next variable.
    Jet<Real> next(Real value);

    State<Jet<Real>> state;

private:
    std::size_t next_ = 0;
};

/// The positions of independent and dependent coordinates and speeds.
struct Split {
    std::vector<int> q, q_dependent, u, u_dependent;
};

template <typename Real>
using MatrixOf = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
template <typename Real>
using VectorOf = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

/// Columns: independent coordinates r, independent speeds w, then t and the inputs, which `tangent` calls x.
template <typename Real>
struct Tangent {
    VectorOf<Real> speed_rates;         ///< w'
    VectorOf<Real> rates;               ///< r'
    VectorOf<Real> balance;             ///< Uᵀ(f − M c), the unbalanced forces at w' = 0
    MatrixOf<Real> mass, force;         ///< mass δw' + force δ = 0
    MatrixOf<Real> speed_rates_by;      ///< δw' = −mass⁻¹ force δ
    MatrixOf<Real> rates_by;            ///< δr'
    MatrixOf<Real> along;               ///< rows q, u, t, inputs: their change for a change of each column
    VectorOf<Real> udot, lambda;        ///< u' and multipliers of the undisturbed motion
    MatrixOf<Real> udot_by, lambda_by;  ///< their derivatives
};

/// The dependent coordinates are chosen by the largest pivot of φ_q among `preferred_q`, or among all if none of
/// these is large enough; the dependent speeds in the same way from ν_u, the rates of dependent coordinates first.
/// First-order states are never dependent. Throws IntegrationError if the rows depend on each other at this state.
Split split_of(const Residuals& residuals, const Instant<long double>& at, const std::vector<bool>& preferred_q,
               const std::vector<bool>& preferred_u);

/// The undisturbed motion: the one that follows from the forces, or w' = 0 whatever the forces are. In the latter
/// case no inertia is needed, −force is the derivative of `balance`, and the members with w' are empty.
enum class Undisturbed { as_forced, steady };

/// `at_kink` tells that a function is at a critical point (is_at_kink of paths.hpp). Derivatives that the chain
/// rule does not give node by node, as of sqrt(x^2)^3 at 0, are then taken from one-sided series.
template <typename Real>
Tangent<Real> tangent(const Residuals& residuals, const Split& split, const Instant<Real>& at,
                      bool at_kink = false, Undisturbed motion = Undisturbed::as_forced);

/// Moves dependent coordinates and speeds until the constraints hold to rounding; false if they do not.
template <typename Real>
bool settle(const Residuals& residuals, const Split& split, Instant<Real>& at);

}  // namespace alembert
