// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The first approximation of the equations of motion near an equilibrium or a steady motion, with constraints
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
/// where R and A u' − γ are differentiated with u' and λ constant at their values in the undisturbed motion:
/// ∂(Aᵀλ)/∂q is the effect of second order that constraint forces have on independent coordinates (a bead's λ/ρ on
/// a curve of radius ρ; g K₀ of a bicycle). The equations are solved for δq, δu in terms of independent ones and
/// projected on the null space of A, which eliminates δλ. (Meijaard, Papadopoulos, Ruina & Schwab, Proc. R. Soc. A
/// 463 (2007) 1955, appendix; Neimark & Fufaev, Dynamics of Nonholonomic Systems (1972), chapter VI.)
///
/// Derivatives are exact: they follow from the chain rule on each node of a Program (program/jet.hpp), in long
/// double.
///
/// A motion is steady if independent speeds do not change and no coordinate moves on which anything depends. Such
/// coordinates are found at random states near the given one: coordinates on which neither u' nor the rates of the
/// others depend are cyclic, in constrained scenes too (the heading and the position on the floor of a rolling
/// body). Inputs keep the values that they have at the given time.

#include <Eigen/Core>
#include <complex>
#include <functional>
#include <string>
#include <vector>

#include "model/formalism/equations.hpp"
#include "program/lower/start.hpp"

namespace alembert {

struct Linearization {
    std::vector<std::string> speeds;       ///< independent speeds w: rows and columns of M and D ("theta'")
    std::vector<std::string> coordinates;  ///< independent coordinates r: columns of P
    std::vector<std::string> dependent;    ///< coordinates and speeds that have been eliminated
    Eigen::MatrixXd M, D, P;
    Eigen::MatrixXd C, G;             ///< D = C + G, symmetric and skew
    bool paired = false;              ///< whether each column of P that is not zero has a speed that is its rate
    Eigen::MatrixXd K, N;             ///< in that case P = K + N over the speeds' coordinates, symmetric and skew
    std::vector<std::string> states;  ///< r and w, without cyclic coordinates if these move others
    std::vector<std::string> inputs;  ///< the inputs that occur, including derivatives ("F''")
    Eigen::MatrixXd A, B;             ///< δx' = A δx + B δinputs
    /// About::any alone: x' at the state, so that x' = A (x − x₀) + B (inputs − inputs₀) + rest near it.
    Eigen::VectorXd rest;
    Eigen::VectorXd at;                ///< x₀, likewise
    std::vector<std::string> outputs;  ///< outputs of the scene, except those that are not known at this state
    Eigen::MatrixXd output_state, output_input;  ///< δy = output_state δx + output_input δinputs
    std::vector<std::string>
        cyclic;  ///< coordinates on which neither the rates of speeds nor those of other coordinates depend
    std::vector<std::string> moving;    ///< cyclic coordinates whose rates are not zero; empty for an equilibrium
    std::vector<std::string> left_out;  ///< coordinates that are not among the states
    std::vector<std::complex<double>> eigenvalues;  ///< of A; by real part, then imaginary part
};

/// `steady`: about an equilibrium or a steady motion. `any`: about any state, with all independent coordinates as
/// states; x₀ stays where it is, so that the rates at it are a constant part of x'. Deviations from the motion
/// through the state obey δx' = A δx + B δinputs.
enum class About { steady, any };

/// Linearizes about the state of `start`, which obeys the constraints. Coordinates and rates that are only guesses
/// in the scene are eliminated before others. Throws ModelError if the state is neither an equilibrium nor a
/// steady motion where it has to be one, with the residual, or if the equations change with time; IntegrationError
/// if constraints or inertia are singular at this state.
Linearization linearize(const Mechanism& mechanism, const Equations& equations, const Start& start,
                        About about = About::steady);

/// The same about each of these states, with the independent coordinates and speeds of the first. `told` is called
/// with the part that is done before each; it may be empty.
std::vector<Linearization> linearize_along(const Mechanism& mechanism, const Equations& equations,
                                           const std::vector<Start>& starts,
                                           const std::function<void(double part)>& told = {});

/// Whether it is an equilibrium or a steady motion in the speeds of these equations. Throws as `linearize` does
/// for every other reason.
bool is_steady(const Mechanism& mechanism, const Equations& equations, const Start& start);

}  // namespace alembert
