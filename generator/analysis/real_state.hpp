// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// States of a mechanism in numbers that anyone can substitute: small fractions, angles such as 2·atan(1/3) whose sines and
/// cosines are fractions, and accelerations and multipliers that follow from them exactly.
///
///     for (unsigned seed = 0; seed < 100; ++seed)
///         if (const auto state = real_state(motions, mechanism, seed))
///             if (const auto r = evaluate(claim, *state, root); r && !r->is_zero()) …     // a counterexample
///
/// Every value is a GiNaC number: a fraction as long as the arithmetic stays in the rationals, otherwise a float of 50 digits.

#include <map>
#include <optional>

#include "analysis/motions.hpp"

namespace alembert {

struct RealState {
    using Key = std::pair<Variable::Kind, int>;
    struct Angle {
        GiNaC::numeric tangent;  ///< of the 2^(halves+1)-th part
        bool half_turn = false;  ///< the angle is π itself
    };
    std::map<Key, GiNaC::numeric> value;
    std::map<Key, Angle> angle;  ///< variables that are angles; `value` holds them as floats
    int halves = 0;
    bool exact = true;           ///< constraints hold exactly, accelerations are fractions
};

/// The values of `roots`; nothing where one is not a finite real number.
std::optional<std::vector<GiNaC::numeric>> evaluate(const Program& program, const RealState& state, const std::vector<int>& roots);

inline constexpr unsigned first_float_seed = 400;
/// A state that obeys the constraints; the larger the seed, the odder the numbers, and only from that seed on floats where a
/// constraint has no fraction as a solution. `angles`: variables that stand in sines and cosines of the claims as well.
/// Nothing at an unlucky seed.
std::optional<RealState> real_state(const Motions& motions, const Program& claims, const std::vector<int>& roots, unsigned seed);

/// As a person types it: "3/7", "2*atan(1/3)", a decimal.
std::string text_of(const RealState& state, const RealState::Key& key);
std::string text_of(const GiNaC::numeric& value);

/// Gauss-Jordan elimination of rows of `columns` coefficients and a right-hand side; the solution if it is unique.
std::optional<std::vector<GiNaC::numeric>> solve_rows(std::vector<std::vector<GiNaC::numeric>> rows, std::size_t columns);

}  // namespace alembert
