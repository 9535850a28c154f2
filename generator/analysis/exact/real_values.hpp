// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Evaluates programs in numbers that a reader can substitute: fractions as long as the results are rational,
/// otherwise floats with 50 digits. Angles have values such as 2·atan(1/3), so that their sines and cosines are
/// fractions.
///
///     if (const auto r = evaluate(program, state, roots)) r->front().is_zero()
///     text_of(state, key)                                                           // "2*atan(1/3)"

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <ginac/ginac.h>

#include "algebra/symbolic/fifty_digits.hpp"
#include "program/program.hpp"

namespace alembert {

struct RealState {
    using Key = std::pair<Variable::Kind, int>;
    struct Angle {
        GiNaC::numeric tangent;  ///< the tangent of the half angle
        bool half_turn = false;  ///< whether the angle is π
    };
    std::map<Key, GiNaC::numeric> value;
    std::map<Key, Angle> angle;  ///< variables that are angles; `value` holds them as floats
    bool exact = true;           ///< whether constraints hold exactly and accelerations are fractions
};

/// Sets the variable to this angle.
void put_angle(RealState& state, const RealState::Key& key, const RealState::Angle& angle);

/// The values of `roots`; nothing if one is not a finite real number.
std::optional<std::vector<GiNaC::numeric>> evaluate(const Program& program, const RealState& state,
                                                    const std::vector<int>& roots);

/// The value as a person would type it: "3/7", "2*atan(1/3)", a decimal.
std::string text_of(const RealState& state, const RealState::Key& key);
std::string text_of(const GiNaC::numeric& value);

/// Gauss-Jordan elimination of rows of `columns` coefficients and a right-hand side; the solution if it is unique.
std::optional<std::vector<GiNaC::numeric>> solve_rows(std::vector<std::vector<GiNaC::numeric>> rows,
                                                      std::size_t columns);

}  // namespace alembert
