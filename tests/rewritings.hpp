// SPDX-License-Identifier: MIT
#pragma once

/// Random right claims about a scene, as text: combinations of its equations with functions of the state as
/// coefficients, multiples of the constraints and of their derivatives added, rates replaced by means of the
/// constraints, sines and cosines rewritten, sides exchanged.
///
///     const Rewritings right(scene, mechanism, equations);
///     right.claim(random)       // "(1+x^2)*(m*x'' - F) + (x'-r*phi')/cos(phi) = 0", in some dress

#include <random>
#include <string>
#include <vector>

#include "model/formalism/equations.hpp"
#include "scene/scene.hpp"

namespace alembert::test {

class Rewritings {
public:
    Rewritings(const Scene& scene, const Mechanism& mechanism, const Equations& equations);

    std::string claim(std::mt19937& random) const;

    /// False if equations are written in intermediate symbols, which the oracle does not support.
    bool readable() const { return readable_; }

    /// The equations that are combined: those that `derive` prints, a row for each coordinate and those in the
    /// scene's speeds, and the scene's claims without open names.
    const std::vector<std::string>& right() const { return right_; }

private:
    std::string function(std::mt19937& random, bool divisor) const;
    std::string dressed(const std::string& text, std::mt19937& random, int changes) const;

    std::vector<std::string> right_;
    bool readable_ = true;
    std::vector<std::string> rates_;      ///< of the constraints: zero, and linear in the rates
    std::vector<std::string> positions_;  ///< of holonomic ones: zero
    std::vector<std::string> parameters_, coordinates_;
};

}  // namespace alembert::test
