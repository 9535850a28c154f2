// SPDX-License-Identifier: MIT
#pragma once

/// Evaluates a claim at states in 60 digits, by a route that has only the parser in common with `check`: the
/// claim's tree is evaluated on Taylor series in time, at accelerations and multipliers from the interpreted
/// Program.
///
///     const Oracle oracle(scene, mechanism, equations, 7);
///     oracle.misfit(claim) < -40        // it holds at all states
///
/// Parameters are near the scene's, each by a random factor; coordinates near the start's, moved onto the
/// constraints by Newton's method of least change; rates random, projected.

#include <optional>

#include "digits.hpp"
#include "model/formalism/equations.hpp"
#include "scene/scene.hpp"

namespace alembert::test {

class Oracle {
public:
    Oracle(const Scene& scene, const Mechanism& mechanism, const Equations& equations, unsigned seed,
           int states = 3);

    /// log₁₀ of |lhs − rhs| over the sizes of all terms, at the worst state. Nothing if it has no value at any of
    /// them, or contains something that is not supported here (vector functions, momenta, third derivatives).
    std::optional<double> misfit(const Equality& claim) const;

    /// A claim is wrong if it is off by more than 1e-30 of its terms, and right below 1e-40: between these bounds
    /// the oracle is not accurate enough.
    std::optional<bool> holds(const Equality& claim) const;

    int states() const { return static_cast<int>(states_.size()); }

private:
    const Scene& scene_;
    const Mechanism& m_;
    std::vector<State<Digits>> states_;  ///< unknown: the multipliers, then each speed and its derivative
};

}  // namespace alembert::test
