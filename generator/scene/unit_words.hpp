// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The words of units: symbols with the prefixes of the SI, names in full, and what people write in their place.
///
///     unit_word("kN").meaning->exact;      // "1000"
///     unit_word("kilonewtons"), unit_word("KN"), unit_word("Deg");
///     unit_word("mpa").meant;              // "mPa or MPa", and no meaning: it may be either
///
/// A word in other letters than the table's, "RPM" or "Deg", is read where no other unit can be meant. Factors are
/// exact: those of the International System (BIPM, The International System of Units, 9th edition 2019, with its
/// 24 prefixes), of the international yard and pound (1959), and the definitions of NIST SP 811 (2008), appendix
/// B.

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace alembert {

/// A product of powers of base units: base unit → exponent, none of them 0.
using UnitExponents = std::map<std::string, double>;

struct UnitMeaning {
    UnitExponents exponents;  ///< rad counts as a base unit, and so does each word that is not known
    double factor = 1;        ///< the unit as a multiple of that product: π/180 for "deg"
    std::string exact;        ///< the factor as an expression of the scene language; empty where it is 1
    std::string si;           ///< the unit with the factor 1 in its place: "rad" for "deg"

    /// Whether it is made of kg, m, s, A, K, mol, cd and rad.
    bool is_si() const;
};

struct UnitWord {
    std::optional<UnitMeaning> meaning;  ///< nothing if the word is not known
    bool is_symbol = false;  ///< "mm", "kN": a unit right after a number even where the scene has that name
    /// What an unknown word most likely is, "litre" or "mPa or MPa"; of a known one, what it may be in place of
    /// that: "Pa" for PA, the petaampere.
    std::string meant = {};
};
UnitWord unit_word(const std::string& word);

/// The word that an unknown one may be a slip of: "metre" for "metrs"; empty if none is near.
std::string nearest_unit(const std::string& word);

/// Two words written as one, "kNm" as kN and m; the second word bears the exponent.
std::optional<std::pair<std::string, std::string>> joined_units(std::string_view word);

/// Whether the zero of this scale is elsewhere, or the scale is no multiple of a unit: "degC", "dB".
bool is_no_multiple(const std::string& word);

/// All symbols of the table, without prefixes.
std::vector<std::string> unit_symbols();

}  // namespace alembert
