// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What the text of a unit means.
///
///     const auto unit = meaning_of_unit("N/mm");
///     unit->exponents;                             // kg: 1, s: −2
///     unit->factor;                                // 1000
///     unit->exact;                                 // "1/0.001"
///     unit->si;                                    // "N/m"
///
/// A unit is words with whole exponents, joined by spaces, points, * and /; a / applies to the next word only. A
/// word is one of the table in unit_text.cpp, with a prefix of the SI where it takes one, or a unit of the scene's
/// own ("AU"), which counts as a base unit. Factors are exact: those of the International System (BIPM, The
/// International System of Units, 9th edition 2019) and of the international yard and pound (1959).

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
    std::string exact;        ///< the factor as an expression of the scene language; empty where it is 1
    std::string si;           ///< the unit with the factor 1 in its place: "rad" for "deg"

    /// Whether it is made of kg, m, s, A, K, mol, cd and rad.
    bool is_si() const;
};

/// Nothing if the text is not of this form.
std::optional<UnitMeaning> meaning_of_unit(const std::string& text);

/// Whether this is a unit of the table, with or without a prefix.
bool is_known_unit(const std::string& word);

/// Whether the zero of this scale is elsewhere, or the scale is no multiple of a unit: "degC", "dB".
bool is_no_multiple(const std::string& word);

}  // namespace alembert
