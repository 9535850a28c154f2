// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Equilibria, frequencies and modes of small vibrations as claims: for all values of the parameters, in exact
/// symbols.
///
///     check_equilibrium({scene, mechanism, {{"theta", 0}}})
///     check_frequency({scene, mechanism, {{"theta", 0}}}, square)      // square: ω² as an expression, g/l
///     check_mode({…}, {{"x1", 1}, {"x2", -1}}, square)
///
/// With q = q₀ + a e^{st}, λ = λ₀ + b e^{st} the equations near q₀ are N(s) (a, b) = 0, where
///     N = [M s² + D s + K, −Aᵀ; A, 0],
/// and ω is a frequency if det N(iω) = 0 (Zhang & Qin, §4.4; Meirovitch, Fundamentals of Vibrations, §7.4).

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "check/verdict.hpp"
#include "model/mechanism.hpp"
#include "model/root_sheets.hpp"

namespace alembert {

/// A state of a scene: coordinates, and rates as "x'", with their values in parameters, as in Claim::near.
struct AtPoint {
    const Scene& scene;
    const Mechanism& mechanism;
    std::vector<std::pair<std::string, Expression>> near;
    std::shared_ptr<RootSheets> sheets = {};
};

/// Whether the state is an equilibrium, or with rates a steady motion.
CheckedClaim check_equilibrium(const AtPoint& point);

struct CheckedFrequency : CheckedClaim {
    int multiplicity = 0;              ///< of a right one
    std::vector<std::string> squares;  ///< ω² of all frequencies, where there is a short form
};
/// `square`: ω², in parameters. Throws SceneMistake for what cannot be read.
CheckedFrequency check_frequency(const AtPoint& point, const Expression& square);

/// Whether these amplitudes, with 0 for coordinates that are not among them, are a mode: that of the frequency, or
/// if none is given that of any.
CheckedClaim check_mode(const AtPoint& point, const std::vector<std::pair<std::string, Expression>>& amplitudes,
                        const std::optional<Expression>& square = {});

}  // namespace alembert
