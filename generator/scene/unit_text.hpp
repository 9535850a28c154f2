// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What the text of a unit means.
///
///     const auto unit = meaning_of_unit("N*m/rad");
///     unit->exponents;                             // kg: 1, m: 2, s: −2, rad: −1
///
/// A unit is words with whole exponents, joined by spaces, points, * and /; a / applies to the next word only.

#include <map>
#include <optional>
#include <string>

namespace alembert {

/// A product of powers of base units: base unit → exponent, none of them 0.
using UnitExponents = std::map<std::string, double>;

UnitExponents multiplied(UnitExponents a, const UnitExponents& b, double exponent = 1);

struct UnitMeaning {
    UnitExponents exponents;  ///< rad counts as a base unit, and so does each word that is not known
    double factor = 1;        ///< the unit as a multiple of that product: π/180 for "deg"

    /// Whether it is made of kg, m, s, A, K, mol, cd and rad.
    bool is_si() const;
};

/// Nothing if the text is not of this form.
std::optional<UnitMeaning> meaning_of_unit(const std::string& text);

}  // namespace alembert
