// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Recognizes a number times small powers of parameters from its values at three states with different parameters.
///
///     const SteadyFactors known(values);                 // of m, l, (m1 + m2) at three states
///     known.of({c0, c1, c2})                              // −2·m/l
///
/// The powers are found from two states: Π ρ_j^e_j = w with ρ_j the ratios of the parameters and w that of the
/// values, and are looked up in a table of all small powers. The third state confirms what was found.

#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "check/claim_tree.hpp"
#include "program/prime.hpp"

namespace alembert {

struct SteadyFactor {
    int n = 1, d = 1;                                 ///< the number n/d
    std::vector<std::pair<std::size_t, int>> powers;  ///< the position of what is raised, and its exponent

    int degree() const;  ///< Σ |exponent|
    bool is_number() const { return powers.empty(); }
};

class SteadyFactors {
public:
    static constexpr std::size_t states = 3;
    using Values = std::array<Prime, states>;

    /// The values of parameters, and of sums of them, at three states.
    explicit SteadyFactors(std::vector<Values> values);

    std::optional<SteadyFactor> of(const Values& value) const;

private:
    using Powers = std::vector<std::pair<std::size_t, int>>;
    std::vector<Values> values_;
    std::map<Prime, Powers> table_;
};

/// The factors of -2*m/l times `of`, those of a product; `raised`: what may be raised.
std::vector<TreePtr> times(const SteadyFactor& factor, const std::vector<TreePtr>& raised,
                           const std::vector<TreePtr>& of);

}  // namespace alembert
