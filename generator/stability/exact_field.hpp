// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The equations of motion as a field on independent coordinates and speeds, modulo the prime 2⁶¹ − 1. Equality at
/// random states proves that two fields are the same, but for a probability below 2⁻⁶⁰.
///
///     const ExactField field(residuals, split);
///     field.holds_everywhere([&](const ExactField::State& at) { … field.at(at) … });
///
/// Positions are arbitrary, whether or not they obey the constraints: M u' = f + Aᵀλ, A u' = γ give accelerations
/// there too, and what is the same for all of them is the same for those that obey the constraints. Parameters are
/// random: what is found holds for all values of these.

#include <functional>
#include <optional>

#include "analysis/exact/quadratic_residue_points.hpp"
#include "stability/linear/tangent.hpp"

namespace alembert {

class ExactField {
public:
    /// Both must outlive it.
    ExactField(const Residuals& residuals, const Split& split);

    struct State {
        ModularPoint point;
        std::vector<Prime> speeds;  ///< the independent ones; the others follow from the constraints
    };
    struct Rates {
        std::vector<Prime> q, u;  ///< of the independent coordinates and speeds
        double degree = 1;        ///< a bound on the degree in the random values of numerators and denominators
        double conditions = 0;    ///< how often the probability of an error is doubled (ModularValues)
    };
    /// Nothing at an unusable point: a denominator or determinant is zero, a root has no value.
    std::optional<Rates> at(const State& state) const;
    /// In place of the rates of the speeds: the forces along them that are not balanced if these rates are zero.
    std::optional<Rates> balance_at(const State& state) const;

    /// Of one comparison at this state: log₂ of the probability that it holds by chance, infinite if it does not
    /// hold; nothing at an unusable state.
    using Comparison = std::function<std::optional<double>(const State&)>;
    bool holds_everywhere(const Comparison& comparison) const;

    /// Does the field stay the same if these coordinates change in any way? Here and below the rates of the
    /// independent coordinates at the positions `left_out` of the split are not looked at.
    bool is_independent_of(const std::vector<int>& coordinates, const std::vector<int>& left_out) const;

    /// Is f(r, −w_j) = −f(r, w_j) but for the rate of w_j, which is the same?
    bool is_reversed_with(std::size_t speed, const std::vector<int>& left_out) const;

    /// Where the speeds at these positions are zero: for each independent coordinate, then for each independent
    /// speed, whether its rate or the force along it is zero whatever the rest of the state is.
    std::vector<bool> balanced_without(const std::vector<std::size_t>& speeds) const;

private:
    struct Values;
    bool find_dependent_speeds(State& state, double& degree, double& conditions) const;

    const Residuals& residuals_;
    const Split& split_;
    QuadraticResiduePoints usable_;
    int finer_;
};

}  // namespace alembert
