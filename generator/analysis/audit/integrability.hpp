// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Decides exactly, by Frobenius' condition, which velocity constraints are equivalent to constraints on
/// positions.
///
/// A constraint a·q' + b = 0 is the one-form w = Σ aᵢ dqᵢ + b dt in the n + 1 variables (q, t); that of f(q,t) = 0
/// is df.
///
///     const std::vector<OneForm> forms = forms_of(mechanism);
///     const Integrability joint = integrability(forms, mechanism, positions, states);
///     joint.integrable[0] == true, joint.integrals == 2
///
/// The forms together span a Pfaffian system I. It is integrable if and only if dw(X,Y) = 0, that is w([X,Y]) = 0,
/// for all w in I and all vector fields X, Y with I(X) = I(Y) = 0 (Frobenius; Warner, Foundations of
/// Differentiable Manifolds (1983), 1.60 and 2.32). If it is not integrable, a part of it may be: the last member
/// of the derived flag I ⊃ I′ ⊃ I″ … is the largest integrable subsystem, and it annihilates the fields together
/// with all their brackets (Bryant et al., Exterior Differential Systems (1991), II.4). `integrable[k]` says
/// whether w_k lies in it. So in
///     z' − y·x' = 0,   y' = 0
///         the first is not integrable alone, and is so beside the second: z − y·x is constant;
///     two forms in three variables   always are, each of them.
/// `integrals` is the number of independent functions of q and t that all motions keep.
///
/// The decision is made modulo 2⁶¹ − 1 at random points of the constraint variety (variety.hpp) and is valid for
/// all but special parameters. "No" is then certain, and "yes" is wrong with a probability of at most 2^failure.
/// If points of the variety could not be found exactly, or if a function occurs whose identities the arithmetic
/// does not obey, "yes" (which then holds outside the variety too) is kept, and "no" must be confirmed in floating
/// point at one of `states`; otherwise there is no answer.

#include "model/mechanism.hpp"
#include "program/interpret.hpp"

namespace alembert {

/// The coefficients of dq₁ … dqₙ, dt.
using OneForm = std::vector<GiNaC::ex>;

std::vector<OneForm> forms_of(const Mechanism& mechanism);

struct Integrability {
    std::vector<std::optional<bool>> integrable;  ///< for each form; nothing if undecided
    std::vector<int> independent;    ///< forms that are not combinations of earlier ones, exact ones first
    std::vector<int> contradictory;  ///< forms whose rates are combinations of those of earlier ones, but not the
                                     ///< rest (0 = g(q,t))
    std::optional<int> integrals;    ///< how many independent functions are constant in every motion
    /// Combinations Σ c_k w_k with rational coefficients that are integrable though their forms are not.
    std::vector<std::vector<GiNaC::numeric>> combinations;
    bool on_variety = true, exact = true;
    double failure = 0;  ///< log₂ of the probability that a "yes" is wrong; 0 if that is impossible
    std::string reason;  ///< the reason why nothing was decided
};

struct IntegrabilityOptions {
    bool fixed = false;            ///< whether to use the scene's parameters instead of generic ones
    std::vector<bool> exact = {};  ///< forms known to be differentials, those of holonomic constraints
    std::vector<int> redundant =
        {};  ///< forms that were found dependent numerically; this is used if no exact point was found
};

/// `positions` are the f of independent holonomic constraints, whose forms are among `forms`. `states` must obey
/// all constraints.
Integrability integrability(const std::vector<OneForm>& forms, const Mechanism& mechanism,
                            const std::vector<GiNaC::ex>& positions, const std::vector<State<double>>& states,
                            const IntegrabilityOptions& options = {});

}  // namespace alembert
