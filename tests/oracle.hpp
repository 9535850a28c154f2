// SPDX-License-Identifier: MIT
#pragma once

/// What a claim comes to at states in 60 digits, by a way that shares nothing with `check` but the parser: the
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
#include "formalism/equations.hpp"
#include "scene/scene.hpp"

namespace alembert::test {

class Oracle {
public:
    Oracle(const Scene& scene, const Mechanism& mechanism, const Equations& equations, unsigned seed,
           int states = 3);

    /// log₁₀ of |lhs − rhs| over the sizes of all terms, at the worst state. Nothing where it has a value at none
    /// of them, or asks for what is not known here (vector functions, momenta, third derivatives).
    std::optional<double> misfit(const Equality& claim) const;

    /// A claim is wrong if it is off by more than 1e-30 of its terms, and right below 1e-40: between lie bad
    /// oracles.
    std::optional<bool> holds(const Equality& claim) const;

    int states() const { return static_cast<int>(states_.size()); }

private:
    const Scene& scene_;
    const Mechanism& m_;
    const Equations& e_;
    std::vector<State<Digits>> states_;  ///< unknown: the multipliers, then each speed and its derivative
};

}  // namespace alembert::test
