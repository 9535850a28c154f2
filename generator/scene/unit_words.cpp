// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/unit_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/language/say.hpp"
#include "scene/scene.hpp"

namespace alembert {

namespace {

struct KnownUnit {
    std::string_view word;
    UnitExponents exponents;
    double factor;
    std::string_view exact;  ///< as in UnitMeaning
    std::string_view si;     ///< likewise
    enum class Takes { nothing, prefixes } takes = Takes::nothing;
    bool yields = false;  ///< to a name of the scene: "2 kp" is no force where kp is a parameter
};
constexpr auto prefixed = KnownUnit::Takes::prefixes, alone = KnownUnit::Takes::nothing;

const UnitExponents length{{"m", 1}}, mass{{"kg", 1}}, duration{{"s", 1}}, angle{{"rad", 1}},
    force{{"kg", 1}, {"m", 1}, {"s", -2}}, work{{"kg", 1}, {"m", 2}, {"s", -2}},
    power{{"kg", 1}, {"m", 2}, {"s", -3}}, pressure{{"kg", 1}, {"m", -1}, {"s", -2}}, speed{{"m", 1}, {"s", -1}},
    turning{{"rad", 1}, {"s", -1}}, area{{"m", 2}}, volume{{"m", 3}};

const double pi = std::acos(-1.0);
constexpr double pound = 0.45359237, inch = 0.0254, foot = 0.3048, gravity = 9.80665,
                 pound_force = pound * gravity;

const std::vector<KnownUnit> table{
    {"1", {}, 1, "", "1"},
    {"%", {}, 0.01, "0.01", "1"},
    {"ppm", {}, 1e-6, "0.000001", "1", alone, true},
    {"m", length, 1, "", "m", prefixed},
    {"s", duration, 1, "", "s", prefixed},
    {"g", mass, 1e-3, "0.001", "kg", prefixed},
    {"kg", mass, 1, "", "kg"},
    {"rad", angle, 1, "", "rad", prefixed},
    {"A", {{"A", 1}}, 1, "", "A", prefixed},
    {"K", {{"K", 1}}, 1, "", "K", prefixed},
    {"mol", {{"mol", 1}}, 1, "", "mol", prefixed},
    {"cd", {{"cd", 1}}, 1, "", "cd", prefixed},
    {"N", force, 1, "", "N", prefixed},
    {"J", work, 1, "", "J", prefixed},
    {"W", power, 1, "", "W", prefixed},
    {"Pa", pressure, 1, "", "Pa", prefixed},
    {"Hz", {{"s", -1}}, 1, "", "Hz", prefixed},
    {"C", {{"A", 1}, {"s", 1}}, 1, "", "C", prefixed},
    {"V", {{"kg", 1}, {"m", 2}, {"s", -3}, {"A", -1}}, 1, "", "V", prefixed},
    {"T", {{"kg", 1}, {"s", -2}, {"A", -1}}, 1, "", "T", prefixed},
    {"F", {{"kg", -1}, {"m", -2}, {"s", 4}, {"A", 2}}, 1, "", "F", prefixed},
    {"H", {{"kg", 1}, {"m", 2}, {"s", -2}, {"A", -2}}, 1, "", "H", prefixed},
    {"Wb", {{"kg", 1}, {"m", 2}, {"s", -2}, {"A", -1}}, 1, "", "Wb", prefixed, true},
    {"ohm", {{"kg", 1}, {"m", 2}, {"s", -3}, {"A", -2}}, 1, "", "ohm", prefixed},
    {"Ω", {{"kg", 1}, {"m", 2}, {"s", -3}, {"A", -2}}, 1, "", "ohm", prefixed},
    {"\u2126", {{"kg", 1}, {"m", 2}, {"s", -3}, {"A", -2}}, 1, "", "ohm", prefixed},
    {"deg", angle, pi / 180, "pi/180", "rad"},
    {"°", angle, pi / 180, "pi/180", "rad"},
    {"º", angle, pi / 180, "pi/180", "rad"},
    {"arcmin", angle, pi / 10800, "pi/10800", "rad", alone, true},
    {"arcsec", angle, pi / 648000, "pi/648000", "rad", alone, true},
    {"gon", angle, pi / 200, "pi/200", "rad", alone, true},
    {"rev", angle, 2 * pi, "2*pi", "rad"},
    {"rpm", turning, pi / 30, "pi/30", "rad/s"},
    {"krpm", turning, 100 * pi / 3, "100*pi/3", "rad/s", alone, true},
    {"rps", turning, 2 * pi, "2*pi", "rad/s", alone, true},
    {"dps", turning, pi / 180, "pi/180", "rad/s", alone, true},
    {"in", length, inch, "0.0254", "m"},
    {"ft", length, foot, "0.3048", "m"},
    {"yd", length, 3 * foot, "0.9144", "m"},
    {"mi", length, 5280 * foot, "1609.344", "m"},
    {"nmi", length, 1852, "1852", "m", alone, true},
    {"ly", length, 9460730472580800, "9460730472580800", "m", alone, true},
    {"parsec", length, 149597870700 * 648000 / pi, "149597870700*648000/pi", "m", alone, true},
    {"thou", length, inch / 1000, "0.0000254", "m", alone, true},
    {"micron", length, 1e-6, "0.000001", "m", alone, true},
    {"Å", length, 1e-10, "0.0000000001", "m", alone, true},
    {"\u212B", length, 1e-10, "0.0000000001", "m", alone, true},
    {"ha", area, 1e4, "10000", "m^2", alone, true},
    {"acre", area, 43560 * foot* foot, "43560*0.3048^2", "m^2", alone, true},
    {"litre", volume, 1e-3, "0.001", "m^3", alone, true},
    {"min", duration, 60, "60", "s"},
    {"h", duration, 3600, "3600", "s"},
    {"day", duration, 86400, "86400", "s", alone, true},
    {"week", duration, 604800, "604800", "s", alone, true},
    {"tonne", mass, 1000, "1000", "kg", alone, true},
    {"lb", mass, pound, "0.45359237", "kg"},
    {"lbm", mass, pound, "0.45359237", "kg"},
    {"oz", mass, pound / 16, "0.45359237/16", "kg"},
    {"slug", mass, pound_force / foot, "0.45359237*9.80665/0.3048", "kg"},
    {"stone", mass, 14 * pound, "14*0.45359237", "kg", alone, true},
    {"carat", mass, 2e-4, "0.0002", "kg", alone, true},
    {"lbf", force, pound_force, "0.45359237*9.80665", "N"},
    {"ozf", force, pound_force / 16, "0.45359237*9.80665/16", "N", alone, true},
    {"pdl", force, pound* foot, "0.45359237*0.3048", "N", alone, true},
    {"kip", force, 1000 * pound_force, "453.59237*9.80665", "N"},
    {"kgf", force, gravity, "9.80665", "N"},
    {"kp", force, gravity, "9.80665", "N", alone, true},
    {"gf", force, gravity / 1000, "0.00980665", "N", alone, true},
    {"dyn", force, 1e-5, "0.00001", "N"},
    {"erg", work, 1e-7, "0.0000001", "J"},
    {"cal", work, 4.184, "4.184", "J", prefixed},
    {"Wh", work, 3600, "3600", "J", prefixed},
    {"eV", work, 1.602176634e-19, "1.602176634e-19", "J", prefixed, true},
    {"Btu", work, 1055.05585262, "1055.05585262", "J", alone, true},
    {"hp", power, 550 * foot* pound_force, "550*0.3048*0.45359237*9.80665", "W"},
    {"PS", power, 75 * gravity, "75*9.80665", "W"},
    {"bar", pressure, 1e5, "100000", "Pa", prefixed},
    {"atm", pressure, 101325, "101325", "Pa"},
    {"torr", pressure, 101325.0 / 760, "101325/760", "Pa", alone, true},
    {"mmHg", pressure, 13.5951 * gravity, "13.5951*9.80665", "Pa", alone, true},
    {"inHg", pressure, 25.4 * 13.5951 * gravity, "25.4*13.5951*9.80665", "Pa", alone, true},
    {"psi", pressure, pound_force / (inch * inch), "0.45359237*9.80665/0.0254^2", "Pa"},
    {"ksi", pressure, 1000 * pound_force / (inch * inch), "453.59237*9.80665/0.0254^2", "Pa", alone, true},
    {"psf", pressure, pound_force / (foot * foot), "0.45359237*9.80665/0.3048^2", "Pa", alone, true},
    {"cP", {{"kg", 1}, {"m", -1}, {"s", -1}}, 1e-3, "0.001", "Pa*s", alone, true},
    {"cSt", {{"m", 2}, {"s", -1}}, 1e-6, "0.000001", "m^2/s", alone, true},
    {"mph", speed, 5280 * foot / 3600, "1609.344/3600", "m/s"},
    {"kmh", speed, 1 / 3.6, "1/3.6", "m/s"},
    {"kph", speed, 1 / 3.6, "1/3.6", "m/s", alone, true},
    {"kmph", speed, 1 / 3.6, "1/3.6", "m/s", alone, true},
    {"fpm", speed, foot / 60, "0.3048/60", "m/s", alone, true},
    {"mps", speed, 1, "", "m/s", alone, true},
    {"fps", speed, foot, "0.3048", "m/s", alone, true},
    {"ips", speed, inch, "0.0254", "m/s", alone, true},
    {"kn", speed, 1852.0 / 3600, "1852/3600", "m/s"},
    {"gn", {{"m", 1}, {"s", -2}}, gravity, "9.80665", "m/s^2", alone, true},
    {"g0", {{"m", 1}, {"s", -2}}, gravity, "9.80665", "m/s^2", alone, true},
};

/// Names in full and abbreviations, in small letters; each has a plural with s, and those of units that take
/// prefixes have prefixes in full.
const std::map<std::string_view, std::string_view> unit_names{{"meter", "m"},
                                                              {"metre", "m"},
                                                              {"second", "s"},
                                                              {"sec", "s"},
                                                              {"gram", "g"},
                                                              {"gramme", "g"},
                                                              {"kg", "kg"},
                                                              {"radian", "rad"},
                                                              {"rad", "rad"},
                                                              {"ampere", "A"},
                                                              {"amp", "A"},
                                                              {"kelvin", "K"},
                                                              {"degk", "K"},
                                                              {"mole", "mol"},
                                                              {"candela", "cd"},
                                                              {"newton", "N"},
                                                              {"joule", "J"},
                                                              {"watt", "W"},
                                                              {"pascal", "Pa"},
                                                              {"hertz", "Hz"},
                                                              {"coulomb", "C"},
                                                              {"volt", "V"},
                                                              {"tesla", "T"},
                                                              {"farad", "F"},
                                                              {"henry", "H"},
                                                              {"henries", "H"},
                                                              {"weber", "Wb"},
                                                              {"ohm", "ohm"},
                                                              {"degree", "deg"},
                                                              {"deg", "deg"},
                                                              {"arcminute", "arcmin"},
                                                              {"arcsecond", "arcsec"},
                                                              {"gradian", "gon"},
                                                              {"gon", "gon"},
                                                              {"revolution", "rev"},
                                                              {"rev", "rev"},
                                                              {"turn", "rev"},
                                                              {"inch", "in"},
                                                              {"inches", "in"},
                                                              {"foot", "ft"},
                                                              {"feet", "ft"},
                                                              {"yard", "yd"},
                                                              {"yd", "yd"},
                                                              {"mile", "mi"},
                                                              {"lightyear", "ly"},
                                                              {"parsec", "parsec"},
                                                              {"stone", "stone"},
                                                              {"carat", "carat"},
                                                              {"micron", "micron"},
                                                              {"angstrom", "Å"},
                                                              {"thou", "thou"},
                                                              {"hectare", "ha"},
                                                              {"acre", "acre"},
                                                              {"litre", "litre"},
                                                              {"liter", "litre"},
                                                              {"minute", "min"},
                                                              {"min", "min"},
                                                              {"hour", "h"},
                                                              {"hr", "h"},
                                                              {"day", "day"},
                                                              {"week", "week"},
                                                              {"tonne", "tonne"},
                                                              {"pound", "lb"},
                                                              {"lb", "lb"},
                                                              {"ounce", "oz"},
                                                              {"slug", "slug"},
                                                              {"kip", "kip"},
                                                              {"poundal", "pdl"},
                                                              {"kilopond", "kp"},
                                                              {"dyne", "dyn"},
                                                              {"erg", "erg"},
                                                              {"calorie", "cal"},
                                                              {"electronvolt", "eV"},
                                                              {"horsepower", "hp"},
                                                              {"bar", "bar"},
                                                              {"atmosphere", "atm"},
                                                              {"torr", "torr"},
                                                              {"knot", "kn"},
                                                              {"kts", "kn"},
                                                              {"percent", "%"}};

/// Words of which people mean different things.
const std::map<std::string_view, std::vector<std::string>> ambiguous_words{
    {"Cal", {"kcal", "cal"}},
    {"Calorie", {"kcal", "cal"}},
    {"Calories", {"kcal", "cal"}},
    {"ton", {"tonne", "2000 lb", "2240 lb"}},
    {"tons", {"tonne", "2000 lb", "2240 lb"}},
    {"kton", {"1000 tonne"}},
    {"ktons", {"1000 tonne"}},
    {"kiloton", {"1000 tonne"}},
    {"kilotons", {"1000 tonne"}},
    {"metric", {"tonne"}},
    {"short", {"2000 lb"}},
    {"long", {"2240 lb"}},
    {"nautical", {"nmi"}},
    {"light", {"ly"}},
    {"square", {"m^2"}},
    {"sq", {"m^2"}},
    {"cubic", {"m^3"}},
    {"t", {"tonne"}},
    {"kt", {"kn", "1000 tonne"}},
    {"tonf", {"1000 kgf", "2000 lbf", "2240 lbf"}},
    {"mil", {"thou", "rev/6400"}},
    {"mils", {"thou", "rev/6400"}},
    {"grad", {"gon", "deg"}},
    {"gm", {"g", "g*m"}},
    {"gms", {"g"}},
    {"l", {"litre"}},
    {"L", {"litre"}},
    {"ml", {"cm^3"}},
    {"mL", {"cm^3"}},
    {"cc", {"cm^3"}},
    {"gal", {"cm/s^2", "231 in^3"}},
    {"gallon", {"231 in^3", "277.42 in^3"}},
    {"gallons", {"231 in^3", "277.42 in^3"}},
    {"r", {"rev"}},
    {"cycle", {"rev"}},
    {"cycles", {"rev"}},
    {"year", {"365 day", "365.25 day"}},
    {"years", {"365 day", "365.25 day"}},
    {"yr", {"365 day", "365.25 day"}},
    {"NM", {"N*m", "nmi", "nm"}},
    {"S", {"s", "1/ohm"}},
    {"M", {"m"}}};

struct Prefix {
    std::string_view letter, name;
    int ten;
    enum class Use { everyday, seldom, rare } use;
};
constexpr auto everyday = Prefix::Use::everyday, seldom = Prefix::Use::seldom, rare = Prefix::Use::rare;

/// da stands before d, which begins it.
constexpr Prefix prefixes[] = {
    {"da", "deca", 1, everyday},  {"da", "deka", 1, everyday},  {"d", "deci", -1, everyday},
    {"c", "centi", -2, everyday}, {"m", "milli", -3, everyday}, {"u", "micro", -6, everyday},
    {"µ", "micro", -6, everyday}, {"μ", "micro", -6, everyday}, {"n", "nano", -9, everyday},
    {"p", "pico", -12, seldom},   {"f", "femto", -15, seldom},  {"a", "atto", -18, rare},
    {"z", "zepto", -21, rare},    {"y", "yocto", -24, rare},    {"r", "ronto", -27, rare},
    {"q", "quecto", -30, rare},   {"h", "hecto", 2, everyday},  {"k", "kilo", 3, everyday},
    {"M", "mega", 6, everyday},   {"G", "giga", 9, everyday},   {"T", "tera", 12, everyday},
    {"P", "peta", 15, rare},      {"E", "exa", 18, rare},       {"Z", "zetta", 21, rare},
    {"Y", "yotta", 24, rare},     {"R", "ronna", 27, rare},     {"Q", "quetta", 30, rare}};

const KnownUnit* find_unit(std::string_view word) {
    const auto found =
        std::find_if(table.begin(), table.end(), [&](const KnownUnit& u) { return u.word == word; });
    return found == table.end() ? nullptr : &*found;
}

/// 1000 as "1000", 10^-3 as "0.001".
std::string power_of_ten(int ten) {
    return ten >= 0 ? "1" + std::string(static_cast<std::size_t>(ten), '0')
                    : "0." + std::string(static_cast<std::size_t>(-ten - 1), '0') + "1";
}

UnitMeaning meaning_of(const KnownUnit& unit) {
    return {unit.exponents, unit.factor, std::string(unit.exact), std::string(unit.si)};
}

UnitMeaning meaning_of(const Prefix& prefix, const KnownUnit& unit) {
    UnitMeaning result = meaning_of(unit);
    const bool is_gram = unit.word == "g";  // kg is the unit of the SI
    const int ten = prefix.ten - (is_gram ? 3 : 0);
    result.factor = ten == 0 ? 1 : is_gram ? std::pow(10.0, ten) : std::pow(10.0, ten) * unit.factor;
    result.exact = ten == 0 ? "" : power_of_ten(ten);
    if (!is_gram && !unit.exact.empty()) result.exact += fmt::format("*({})", unit.exact);
    return result;
}

std::string small_letters(std::string_view word) {
    std::string result(word);
    for (char& c : result)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return result;
}

/// A symbol in the table's own letters.
UnitWord symbol_word(std::string_view word) {
    if (const KnownUnit* const unit = find_unit(word)) return {meaning_of(*unit), !unit->yields};
    for (const Prefix& prefix : prefixes) {
        if (!word.starts_with(prefix.letter)) continue;
        const KnownUnit* const unit = find_unit(word.substr(prefix.letter.size()));
        if (unit == nullptr || unit->takes != prefixed) continue;
        return {meaning_of(prefix, *unit), prefix.use == everyday && !unit->yields};
    }
    return {};
}

bool has_rare_prefix(const std::string& word) {
    return find_unit(word) == nullptr &&
           std::any_of(std::begin(prefixes), std::end(prefixes), [&](const Prefix& prefix) {
               if (prefix.use != rare || !word.starts_with(prefix.letter)) return false;
               const KnownUnit* const unit = find_unit(std::string_view(word).substr(prefix.letter.size()));
               return unit != nullptr && unit->takes == prefixed;
           });
}

/// A name in full, in the singular or the plural, with a prefix in full: "kilometers". msec has that of a symbol.
std::optional<UnitMeaning> named_unit(std::string_view word) {
    const auto unit_named = [](std::string_view name) -> const KnownUnit* {
        auto found = unit_names.find(name);
        if (found == unit_names.end() && name.ends_with('s'))
            found = unit_names.find(name.substr(0, name.size() - 1));
        return found == unit_names.end() ? nullptr : find_unit(found->second);
    };
    const std::string name = small_letters(word);
    if (const KnownUnit* const unit = unit_named(name)) return meaning_of(*unit);
    for (const Prefix& prefix : prefixes) {
        if (word.starts_with(prefix.letter)) {
            const std::string_view rest = word.substr(prefix.letter.size());
            if (rest == "sec" || rest == "secs") return meaning_of(prefix, *find_unit("s"));
        }
        if (!name.starts_with(prefix.name)) continue;
        const std::string_view rest = std::string_view(name).substr(prefix.name.size());
        const KnownUnit* const unit = unit_named(rest);
        if (unit != nullptr && rest.size() > 2 && unit->takes == prefixed) return meaning_of(prefix, *unit);
    }
    return {};
}

/// A symbol that differs from a word by the case of its letters alone.
struct OtherCase {
    std::string symbol;
    UnitMeaning meaning;
    bool is_certain;  ///< whether the word is read as this one, if nothing else may be meant
};

void add_prefixed(const std::string& word, std::vector<OtherCase>& found) {
    std::vector<OtherCase> own, others;  // with the prefix as it is written, and with that in the other case
    for (const Prefix& prefix : prefixes) {
        if (prefix.use == rare || !small_letters(word).starts_with(small_letters(prefix.letter))) continue;
        const bool is_own = word.starts_with(prefix.letter);
        for (const KnownUnit& unit : table) {
            const std::string symbol = std::string(prefix.letter) + std::string(unit.word);
            if (unit.takes != prefixed || symbol == word || small_letters(symbol) != small_letters(word)) continue;
            if (prefix.name == "deka" || (prefix.use == seldom && unit.word.size() == 1 && !is_own)) continue;
            const bool is_certain = unit.word.size() > 1 || prefix.letter == "k";
            (is_own ? own : others).push_back({symbol, meaning_of(prefix, unit), is_certain});
        }
    }
    const bool is_large = word[0] >= 'A' && word[0] <= 'Z';  // Mpa is MPa, and mpa may be that too
    const bool is_clear = std::any_of(own.begin(), own.end(), [](const OtherCase& one) { return one.is_certain; });
    if (!is_large || !is_clear) own.insert(own.end(), others.begin(), others.end());
    found.insert(found.end(), own.begin(), own.end());
}

std::vector<OtherCase> other_cases(const std::string& word) {
    std::vector<OtherCase> found;
    for (const KnownUnit& unit : table)
        if (unit.word != word && small_letters(unit.word) == small_letters(word))
            found.push_back({std::string(unit.word), meaning_of(unit), word.size() > 1});
    const bool is_whole = !found.empty();
    add_prefixed(word, found);
    // FT is a foot: the femtotesla would be written by few.
    if (is_whole)
        std::erase_if(found, [](const OtherCase& one) {
            return find_unit(one.symbol) == nullptr &&
                   std::string_view("hdaf").find(one.symbol[0]) != std::string::npos;
        });
    return found;
}

std::string joined_by_or(const std::vector<std::string>& words) {
    std::string result;
    for (const std::string& word : words) result += (result.empty() ? "" : say(" or ")) + word;
    return result;
}

std::string listed_symbols(const std::vector<OtherCase>& found) {
    std::vector<std::string> symbols;
    for (const OtherCase& one : found) symbols.push_back(one.symbol);
    return joined_by_or(symbols);
}

bool mean_the_same(const std::vector<OtherCase>& found) {
    return std::all_of(found.begin(), found.end(), [&](const OtherCase& one) {
        return one.meaning.factor == found[0].meaning.factor &&
               one.meaning.exponents == found[0].meaning.exponents;
    });
}

/// What is written without a sign between: the first and the second words.
struct Joined {
    std::vector<std::string_view> first, second;
};

const std::vector<Joined>& joined_table() {
    static const std::vector<Joined> all{{{"N", "kN", "MN", "GN", "mN", "uN", "µN", "μN", "nN", "cN", "daN"},
                                          {"m", "mm", "cm", "um", "µm", "μm", "s"}},
                                         {{"kgf", "gf", "kp", "dyn"}, {"m", "cm", "mm"}},
                                         {{"lbf", "ozf", "kip"}, {"ft", "in"}},
                                         {{"ft", "in"}, {"lbf", "ozf", "kip"}},
                                         {{"kg"}, {"m", "cm", "mm"}},
                                         {{"g"}, {"cm", "mm"}},
                                         {{"slug"}, {"ft", "in"}},
                                         {{"lb", "lbs", "lbm", "oz"}, {"ft", "in"}},
                                         {{"ft", "in"}, {"lb", "lbs", "oz"}},
                                         {{"foot", "inch"}, {"pound", "pounds"}},
                                         {{"pound", "pounds"}, {"foot", "feet", "inch", "inches"}},
                                         {{"newton", "kilonewton"}, {"meter", "meters", "metre", "metres"}},
                                         {{"A", "mA", "kA"}, {"s", "h"}},
                                         {{"V", "mV", "W", "mW", "kW", "J", "mJ"}, {"s"}},
                                         {{"V", "kV", "mV"}, {"A"}},
                                         {{"Pa", "mPa", "kPa", "MPa"}, {"s"}}};
    return all;
}

}  // namespace

bool UnitMeaning::is_si() const {
    static const std::set<std::string> bases{"kg", "m", "s", "A", "K", "mol", "cd", "rad"};
    return std::all_of(exponents.begin(), exponents.end(),
                       [](const auto& entry) { return bases.contains(entry.first); });
}

UnitWord unit_word(const std::string& word) {
    if (word.empty() || is_no_multiple(word)) return {};
    if (UnitWord known = symbol_word(word); known.meaning) {
        if (has_rare_prefix(word)) known.meant = listed_symbols(other_cases(word));
        return known;
    }
    if (const auto doubt = ambiguous_words.find(word); doubt != ambiguous_words.end())
        return {{}, false, joined_by_or(doubt->second)};
    if (auto meaning = named_unit(word)) return {std::move(meaning)};
    if (const auto doubt = ambiguous_words.find(small_letters(word));
        doubt != ambiguous_words.end() && word.size() > 1)
        return {{}, false, joined_by_or(doubt->second)};
    const std::vector<OtherCase> found = other_cases(word);
    if (!found.empty() && mean_the_same(found) && found[0].is_certain) return {found[0].meaning};
    return {{}, false, listed_symbols(found)};
}

std::string nearest_unit(const std::string& word) {
    static const std::vector<std::string> known = [] {
        std::vector<std::string> result{"km",         "cm",        "mm",          "kN",          "Nm",
                                        "kNm",        "Nmm",       "kPa",         "MPa",         "GPa",
                                        "kHz",        "MHz",       "kW",          "kJ",          "ms",
                                        "kWh",        "mrad",      "kilometer",   "centimeter",  "millimeter",
                                        "kilogram",   "milligram", "millisecond", "microsecond", "kilonewton",
                                        "megapascal", "kilowatt",  "kilojoule",   "kilohertz",   "megahertz"};
        for (const KnownUnit& unit : table)
            if (unit.word.size() > 1) result.emplace_back(unit.word);
        for (const auto& [name, symbol] : unit_names)
            if (name.size() > 2) result.emplace_back(name);
        return result;
    }();
    // A slip changes neither the first letter nor most of a short word: a kin is no kN, and a gn no GN.
    if (word.size() < 4) return {};
    std::vector<std::string> like;
    for (const std::string& one : known)
        if (small_letters(one)[0] == small_letters(word)[0]) like.push_back(one);
    return nearest(word, like);
}

std::optional<std::pair<std::string, std::string>> joined_units(std::string_view word) {
    for (const Joined& joined : joined_table())
        for (const std::string_view first : joined.first)
            for (const std::string_view second : joined.second) {
                const bool has_kilo = first.starts_with('k') && word.starts_with('K');  // KNm
                const std::string_view rest = word.substr(has_kilo ? 1 : 0);
                if (rest == std::string(first.substr(has_kilo ? 1 : 0)) + std::string(second))
                    return std::pair(std::string(first), std::string(second));
            }
    return {};
}

bool is_no_multiple(const std::string& word) {
    static const std::set<std::string> words{"degC",       "degF", "°C",  "°F", "℃",    "℉",   "celsius",
                                             "fahrenheit", "dB",   "dBA", "Np", "psig", "barg"};
    return words.contains(word);
}

std::vector<std::string> unit_symbols() {
    std::vector<std::string> result;
    for (const KnownUnit& unit : table) result.emplace_back(unit.word);
    return result;
}

}  // namespace alembert
