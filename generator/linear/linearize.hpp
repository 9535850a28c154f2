// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The first approximation of the equations of motion near an equilibrium or a steady motion, constraints
/// eliminated.
///
///     const Linearization near = linearize(mechanism, equations, start);
///     near.M, near.D, near.P;       // M δw' + D δw + P δr = 0 in independent speeds w and coordinates r
///     near.A, near.states;          // δx' = A δx
///
/// In the speeds of the equations: q' = h(q,u,t), R = M u' − f − Aᵀλ = 0, A u' = γ, φ(q,t) = 0, ν(q,u,t) = 0 (ν' =
/// A u' − γ). Small motions obey
///     φ_q δq = 0,   ν_q δq + ν_u δu = 0,   δq' = h_q δq + h_u δu,
///     M δu' + R_q δq + R_u δu − Aᵀδλ = 0,   A δu' + (A u' − γ)_q δq − γ_u δu = 0,
/// R and A u' − γ being differentiated with u' and λ held at their values in the undisturbed motion: ∂(Aᵀλ)/∂q is
/// the effect of second order that constraint forces have on independent coordinates (a bead's λ/ρ on a curve of
/// radius ρ; g K₀ of a bicycle). Solved for δq, δu in independent ones, and projected on the null space of A, δλ
/// is gone. (Meijaard, Papadopoulos, Ruina & Schwab, Proc. R. Soc. A 463 (2007) 1955, appendix; Neimark & Fufaev,
/// Dynamics of Nonholonomic Systems (1972), chapter VI.)
///
/// Derivatives are exact: chain rule on each node of a Program (program/jet.hpp), in long double.
///
/// Steady: independent speeds do not change, and no coordinate moves that anything depends on. Which these are is
/// found at random states near the given one: coordinates that neither u' nor the rates of the others hold are
/// cyclic, in constrained scenes too (heading, and place on the floor, of what rolls). Inputs keep the values that
/// they have at the given time.

#include <Eigen/Core>
#include <complex>
#include <string>
#include <vector>

#include "formalism/equations.hpp"
#include "lower/start.hpp"

namespace alembert {

struct Linearization {
    std::vector<std::string> speeds;       ///< independent ones, w: rows and columns of M and D ("theta'")
    std::vector<std::string> coordinates;  ///< independent ones, r: columns of P
    std::vector<std::string> dependent;    ///< coordinates and speeds that have been eliminated
    Eigen::MatrixXd M, D, P;
    Eigen::MatrixXd C, G;              ///< D = C + G, symmetric and skew
    bool paired = false;               ///< each column of P that is not zero belongs to a speed that is its rate
    Eigen::MatrixXd K, N;              ///< then P = K + N over the speeds' coordinates, symmetric and skew
    std::vector<std::string> states;   ///< r and w; without cyclic coordinates where these move others
    std::vector<std::string> inputs;   ///< that occur, derivatives too ("F''")
    Eigen::MatrixXd A, B;              ///< δx' = A δx + B δinputs
    std::vector<std::string> outputs;  ///< of the scene, but for those that are not known at this state
    Eigen::MatrixXd output_state, output_input;  ///< δy = output_state δx + output_input δinputs
    std::vector<std::string> cyclic;    ///< coordinates that neither the speeds' rates nor other coordinates hold
    std::vector<std::string> moving;    ///< cyclic coordinates whose rates are not zero; none: an equilibrium
    std::vector<std::string> left_out;  ///< coordinates without a state
    std::vector<std::complex<double>> eigenvalues;  ///< of A; by real part, then imaginary part
};

/// About the state of `start`, which obeys the constraints. Coordinates and rates that the scene only guesses are
/// eliminated before others. Throws ModelError where the state is neither an equilibrium nor a steady motion, with
/// the residual, or where the equations change with time; IntegrationError where constraints or inertia are
/// singular at this state.
Linearization linearize(const Mechanism& mechanism, const Equations& equations, const Start& start);

/// Whether it is an equilibrium or a steady motion in the speeds of these equations. Throws as `linearize` does
/// for every other reason.
bool is_steady(const Mechanism& mechanism, const Equations& equations, const Start& start);

}  // namespace alembert
