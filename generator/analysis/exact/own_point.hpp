// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Which roots of the conditions are on the scene's own branch, in exact arithmetic.
///
///     const OwnPoints points(program, steps, branch);
///     if (const auto point = points.at(seed))
///         solve_condition(program, steps[k], state, &point->roots[k]);     // modulo the prime, on the own branch
///
/// The variables that no condition is solved for get random fractions near a place of the branch, where Newton's
/// method gives the roots of the own branch with fifty digits. The polynomial of a condition then has rational
/// coefficients and is factored over the rational numbers. That factor which vanishes at the root found is the
/// minimal polynomial of the own root, and its roots modulo the prime are those of the own branch (and of its
/// conjugates, for which every equation with rational coefficients holds as well; Hilbert's irreducibility
/// theorem: at random fractions a branch splits no further). Where roots before are irrational, the polynomial is
/// that of a random combination θ of all roots, a primitive element of their field, from which they are eliminated
/// by resultants (Trager, Algebraic factoring and rational function integration, SYMSAC 1976).

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "analysis/exact/own_branch.hpp"
#include "program/prime_polynomial.hpp"

namespace alembert {

/// What is known of the own root of a step: `factor` vanishes at θ = Σ weight · x, with x as in
/// analysis/exact/counted_angle.hpp for angles. It is empty if the condition has no other root.
struct OwnRoot {
    PrimePolynomial factor{};
    std::vector<std::pair<SolvedUnknown, Prime>> theta{};
};

struct OwnPoint {
    std::map<RealState::Key, Prime> values;  ///< of variables that are not solved for
    std::map<RealState::Key, Prime> angles;  ///< likewise, as x of analysis/exact/counted_angle.hpp
    std::vector<OwnRoot> roots;              ///< for each step
};

class OwnPoints {
public:
    /// log₂ of the number of values from which each free variable is drawn.
    static constexpr double field = 30;

    /// `halves` as in analysis/exact/counted_angle.hpp. The other arguments must outlive it.
    OwnPoints(const Program& program, const std::vector<SolvingStep>& steps, const OwnBranch& branch, int halves)
        : program_(program), steps_(steps), branch_(branch), halves_(halves) {}

    /// Nothing if the roots cannot be told apart for this seed.
    std::optional<OwnPoint> at(std::uint64_t seed) const;

private:
    const Program& program_;
    const std::vector<SolvingStep>& steps_;
    const OwnBranch& branch_;
    int halves_;
};

}  // namespace alembert
