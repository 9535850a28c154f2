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
/// A unit is words (scene/unit_words.hpp) with whole exponents (m^2, m2, m²), joined by spaces, points, *, hyphens
/// and / or "per", which apply to the next word only. Words written as one are read where engineers write them so:
/// kNm, kgm2, ftlb. A word that is not known counts as a base unit, and is told. Whether a pound is a force:
/// scene/unit_pounds.hpp.

#include <optional>
#include <string>
#include <vector>

#include "scene/unit_words.hpp"

namespace alembert {

UnitExponents multiplied(UnitExponents a, const UnitExponents& b, double exponent = 1);

/// The units of a scene's own, from [units].
using OwnUnits = std::map<std::string, UnitMeaning>;

/// That of this word, also in the plural, "furlongs"; null for none.
const UnitMeaning* own_unit(const OwnUnits& own, const std::string& word);

/// A word of a unit that is not known, or is most likely another one.
struct UnitDoubt {
    std::string word;
    std::string meant;      ///< "litre"; may be empty
    bool is_known = false;  ///< "PA", the petaampere
    std::string mass = {};  ///< "lb" in the word "lb/in", which is read, and may be meant as "lbf/in"
};

/// What is said of a mass that may be meant as a force.
std::string advice_on_mass(const UnitDoubt& doubt);

struct UnitReading {
    std::optional<UnitMeaning> meaning;  ///< nothing if the text is no unit
    std::string mistake;                 ///< then why it is none: "nothing follows '/'"
    int offset = 0;                      ///< and where
    std::vector<UnitDoubt> doubts;
    bool has_own = false;  ///< whether a unit of the scene's own is in it
};

/// The text is in plain signs (scene/typed.hpp).
UnitReading read_unit(const std::string& text, const OwnUnits& own = {});

/// Nothing if the text is no unit.
std::optional<UnitMeaning> meaning_of_unit(const std::string& text);

/// The unit of a derivative by time: "m" → "m/s", "N m" → "(N m)/s^2" for the second; empty for a unit that is not
/// known.
std::string per_second(const std::string& unit, int times = 1);

/// Whether this word is a unit after a number: one of the table, with or without a prefix, or several as one.
bool is_known_unit(const std::string& word);

/// Whether two words are what engineers write as one unit: N and m as Nm, kW and h as kWh, but not m and s.
bool is_product_of_units(const std::string& first, const std::string& second);

/// Whether it is a symbol, "mm" or "kN", which no name of a scene takes away after a number.
bool is_unit_symbol(const std::string& word);

}  // namespace alembert
