// SPDX-License-Identifier: GPL-2.0-or-later
// The words of units: each symbol against GNU units, all prefixes of the SI, what engineers write, what is refused
// and what is warned of; units of a scene's own.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "alembert/base/error.hpp"
#include "scene/joints_file.hpp"
#include "scene/known_names.hpp"
#include "scene/scene.hpp"
#include "scene/unit_text.hpp"
#include "scene/units.hpp"

namespace scene_unit_words {

using namespace alembert;

namespace {

struct Reference {
    const char* unit;
    double factor;
    const char* base;  ///< "kg m^2 s^-2"
};

// GNU units 2.22, `units -t -d 15 UNIT`; ozf and gf, which it has not, from NIST SP 811 (2008), B.8, to seven
// digits; the parsec, 648000/π au, from resolution B2 of the IAU (2015).
constexpr Reference references[] = {{"1", 1, ""},
                                    {"%", 0.01, ""},
                                    {"ly", 9.4607304725808e15, "m"},
                                    {"parsec", 3.0856775814913673e16, "m"},
                                    {"stone", 6.35029318, "kg"},
                                    {"carat", 0.0002, "kg"},
                                    {"kmph", 0.277777777777778, "m s^-1"},
                                    {"fpm", 0.00508, "m s^-1"},
                                    {"gn", 9.80665, "m s^-2"},
                                    {"g0", 9.80665, "m s^-2"},
                                    {"ppm", 1e-06, ""},
                                    {"m", 1, "m"},
                                    {"s", 1, "s"},
                                    {"g", 0.001, "kg"},
                                    {"kg", 1, "kg"},
                                    {"rad", 1, "rad"},
                                    {"A", 1, "A"},
                                    {"K", 1, "K"},
                                    {"mol", 1, "mol"},
                                    {"cd", 1, "cd"},
                                    {"N", 1, "kg m s^-2"},
                                    {"J", 1, "kg m^2 s^-2"},
                                    {"W", 1, "kg m^2 s^-3"},
                                    {"Pa", 1, "kg m^-1 s^-2"},
                                    {"Hz", 1, "s^-1"},
                                    {"C", 1, "A s"},
                                    {"V", 1, "kg m^2 A^-1 s^-3"},
                                    {"T", 1, "kg A^-1 s^-2"},
                                    {"F", 1, "A^2 s^4 kg^-1 m^-2"},
                                    {"H", 1, "kg m^2 A^-2 s^-2"},
                                    {"Wb", 1, "kg m^2 A^-1 s^-2"},
                                    {"ohm", 1, "kg m^2 A^-2 s^-3"},
                                    {"Ω", 1, "kg m^2 A^-2 s^-3"},
                                    {"\u2126", 1, "kg m^2 A^-2 s^-3"},
                                    {"deg", 0.0174532925199433, "rad"},
                                    {"°", 0.0174532925199433, "rad"},
                                    {"º", 0.0174532925199433, "rad"},
                                    {"arcmin", 0.000290888208665722, "rad"},
                                    {"arcsec", 4.84813681109536e-06, "rad"},
                                    {"gon", 0.015707963267949, "rad"},
                                    {"rev", 6.28318530717959, "rad"},
                                    {"rpm", 0.10471975511966, "rad s^-1"},
                                    {"krpm", 104.71975511966, "rad s^-1"},
                                    {"rps", 6.28318530717959, "rad s^-1"},
                                    {"dps", 0.0174532925199433, "rad s^-1"},
                                    {"in", 0.0254, "m"},
                                    {"ft", 0.3048, "m"},
                                    {"yd", 0.9144, "m"},
                                    {"mi", 1609.344, "m"},
                                    {"nmi", 1852, "m"},
                                    {"thou", 2.54e-05, "m"},
                                    {"micron", 1e-06, "m"},
                                    {"Å", 1e-10, "m"},
                                    {"\u212B", 1e-10, "m"},
                                    {"ha", 10000, "m^2"},
                                    {"acre", 4046.8564224, "m^2"},
                                    {"litre", 0.001, "m^3"},
                                    {"min", 60, "s"},
                                    {"h", 3600, "s"},
                                    {"day", 86400, "s"},
                                    {"week", 604800, "s"},
                                    {"tonne", 1000, "kg"},
                                    {"lb", 0.45359237, "kg"},
                                    {"lbm", 0.45359237, "kg"},
                                    {"oz", 0.028349523125, "kg"},
                                    {"slug", 14.5939029372064, "kg"},
                                    {"lbf", 4.4482216152605, "kg m s^-2"},
                                    {"ozf", 0.2780139, "kg m s^-2"},
                                    {"pdl", 0.138254954376, "kg m s^-2"},
                                    {"kip", 4448.2216152605, "kg m s^-2"},
                                    {"kgf", 9.80665, "kg m s^-2"},
                                    {"kp", 9.80665, "kg m s^-2"},
                                    {"gf", 9.80665e-3, "kg m s^-2"},
                                    {"dyn", 1e-05, "kg m s^-2"},
                                    {"erg", 1e-07, "kg m^2 s^-2"},
                                    {"cal", 4.184, "kg m^2 s^-2"},
                                    {"Wh", 3600, "kg m^2 s^-2"},
                                    {"eV", 1.602176634e-19, "kg m^2 s^-2"},
                                    {"Btu", 1055.05585262, "kg m^2 s^-2"},
                                    {"hp", 745.69987158227, "kg m^2 s^-3"},
                                    {"PS", 735.49875, "kg m^2 s^-3"},
                                    {"bar", 100000, "kg m^-1 s^-2"},
                                    {"atm", 101325, "kg m^-1 s^-2"},
                                    {"torr", 133.322368421053, "kg m^-1 s^-2"},
                                    {"mmHg", 133.322387415, "kg m^-1 s^-2"},
                                    {"inHg", 3386.388640341, "kg m^-1 s^-2"},
                                    {"psi", 6894.75729316836, "kg m^-1 s^-2"},
                                    {"ksi", 6894757.29316836, "kg m^-1 s^-2"},
                                    {"psf", 47.8802589803358, "kg m^-1 s^-2"},
                                    {"cP", 0.001, "kg m^-1 s^-1"},
                                    {"cSt", 1e-06, "m^2 s^-1"},
                                    {"mph", 0.44704, "m s^-1"},
                                    {"kmh", 0.277777777777778, "m s^-1"},
                                    {"kph", 0.277777777777778, "m s^-1"},
                                    {"mps", 1, "m s^-1"},
                                    {"fps", 0.3048, "m s^-1"},
                                    {"ips", 0.0254, "m s^-1"},
                                    {"kn", 0.514444444444444, "m s^-1"}};

/// The value of the factor as the program computes with it.
double value_of_factor(const UnitMeaning& unit) {
    if (unit.exact.empty()) return 1;
    std::vector<Diagnostic> mistakes;
    const auto value = value_of(parse_expression(unit.exact, {}, mistakes));
    REQUIRE(value);
    return *value;
}

Scene scene_with(const std::string& unit, const std::string& more = {}) {
    return parse_scene(more + "[parameters]\na = { value = 3, unit = \"" + unit +
                           "\" }\n[coordinates]\nx = 0\n[energy]\nkinetic = \"a*x'^2\"\n",
                       "unit.toml");
}

/// What is said of a scene with a parameter in this unit: its warnings, or why it is refused.
std::string said_of(const std::string& unit, const std::string& more = {}) {
    std::string result;
    try {
        for (const Diagnostic& one : scene_with(unit, more).warnings)
            if (one.kind == "unknown_unit") result += one.message + "\n";
    } catch (const SceneError& error) {
        return error.what();
    }
    return result;
}

bool holds(const std::string& text, const std::string& words) {
    return text.find(words) != std::string::npos;
}

}  // namespace

TEST_CASE("units: each symbol of the table has the factor and the dimension that GNU units gives") {
    for (const std::string& symbol : unit_symbols()) {
        CAPTURE(symbol);
        const auto* const known = std::find_if(std::begin(references), std::end(references),
                                               [&](const Reference& one) { return one.unit == symbol; });
        REQUIRE(known != std::end(references));  // a new unit needs a number from elsewhere
        const auto meaning = meaning_of_unit(symbol);
        REQUIRE(meaning);
        const double digits = symbol == "ozf" ? 5e-8 : 1e-14;  // the references have 7 digits, and 15
        CHECK(meaning->factor == doctest::Approx(known->factor).epsilon(digits));
        CHECK(value_of_factor(*meaning) == doctest::Approx(known->factor).epsilon(digits));
        const auto base = *known->base == '\0' ? UnitMeaning{} : meaning_of_unit(known->base).value();
        CHECK(meaning->exponents == base.exponents);
        const auto si = meaning_of_unit(meaning->si);
        REQUIRE(si);
        CHECK(si->factor == 1);
        CHECK(si->exponents == base.exponents);
    }
}

TEST_CASE("units: all 24 prefixes of the SI, as letters and in full") {
    // BIPM, The International System of Units (9th edition 2019, with the prefixes of 2022), table 7.
    const std::pair<std::pair<const char*, const char*>, int> prefixes[] = {
        {{"q", "quecto"}, -30}, {{"r", "ronto"}, -27}, {{"y", "yocto"}, -24}, {{"z", "zepto"}, -21},
        {{"a", "atto"}, -18},   {{"f", "femto"}, -15}, {{"p", "pico"}, -12},  {{"n", "nano"}, -9},
        {{"u", "micro"}, -6},   {{"µ", "micro"}, -6},  {{"μ", "micro"}, -6},  {{"m", "milli"}, -3},
        {{"c", "centi"}, -2},   {{"d", "deci"}, -1},   {{"da", "deca"}, 1},   {{"da", "deka"}, 1},
        {{"h", "hecto"}, 2},    {{"k", "kilo"}, 3},    {{"M", "mega"}, 6},    {{"G", "giga"}, 9},
        {{"T", "tera"}, 12},    {{"P", "peta"}, 15},   {{"E", "exa"}, 18},    {{"Z", "zetta"}, 21},
        {{"Y", "yotta"}, 24},   {{"R", "ronna"}, 27},  {{"Q", "quetta"}, 30}};
    const std::pair<const char*, const char*> units[] = {{"m", "meter"}, {"s", "seconds"}, {"N", "newtons"},
                                                         {"g", "grams"}, {"Pa", "pascal"}, {"Hz", "hertz"}};
    for (const auto& [words, ten] : prefixes)
        for (const auto& [symbol, name] : units)
            for (const std::string& unit : {std::string(words.first) + symbol, std::string(words.second) + name}) {
                CAPTURE(unit);
                const auto meaning = meaning_of_unit(unit);
                REQUIRE(meaning);
                const double factor = std::pow(10.0, ten - (symbol == std::string("g") ? 3 : 0));
                CHECK(meaning->factor == doctest::Approx(factor).epsilon(1e-14));
                CHECK(value_of_factor(*meaning) == doctest::Approx(factor).epsilon(1e-14));
                CHECK(meaning->is_si());
            }
}

TEST_CASE("units: what engineers write is read as they mean it, without a warning") {
    const std::pair<const char*, const char*> same[] = {{"miles", "mi"},
                                                        {"Miles", "mi"},
                                                        {"yards", "yd"},
                                                        {"feet", "ft"},
                                                        {"Inches", "in"},
                                                        {"slugs", "slug"},
                                                        {"knots", "kn"},
                                                        {"kts", "kn"},
                                                        {"hrs", "h"},
                                                        {"hr", "h"},
                                                        {"mins", "min"},
                                                        {"secs", "s"},
                                                        {"msec", "ms"},
                                                        {"usec", "us"},
                                                        {"lbs", "lb"},
                                                        {"kgs", "kg"},
                                                        {"degs", "deg"},
                                                        {"Degrees", "deg"},
                                                        {"radians", "rad"},
                                                        {"revs", "rev"},
                                                        {"Deg", "deg"},
                                                        {"DEG", "deg"},
                                                        {"Rad", "rad"},
                                                        {"RPM", "rpm"},
                                                        {"Rpm", "rpm"},
                                                        {"PSI", "psi"},
                                                        {"KG", "kg"},
                                                        {"Kg", "kg"},
                                                        {"HZ", "Hz"},
                                                        {"hz", "Hz"},
                                                        {"Khz", "kHz"},
                                                        {"Mpa", "MPa"},
                                                        {"gpa", "GPa"},
                                                        {"KPA", "kPa"},
                                                        {"KW", "kW"},
                                                        {"kw", "kW"},
                                                        {"Km", "km"},
                                                        {"FT", "ft"},
                                                        {"IN", "in"},
                                                        {"LBF", "lbf"},
                                                        {"HP", "hp"},
                                                        {"BTU", "Btu"},
                                                        {"ev", "eV"},
                                                        {"MPH", "mph"},
                                                        {"kPH", "kph"},
                                                        {"kips", "kip"},
                                                        {"Nm", "N m"},
                                                        {"kNm", "kN m"},
                                                        {"KNm", "kN m"},
                                                        {"N-m", "N m"},
                                                        {"kN-m", "kN m"},
                                                        {"Nmm", "N mm"},
                                                        {"Ncm", "N cm"},
                                                        {"Nm/rad", "N m/rad"},
                                                        {"Nms/rad", "N m s/rad"},
                                                        {"Ns/m", "N s/m"},
                                                        {"N-s/m", "N s/m"},
                                                        {"kgm2", "kg m^2"},
                                                        {"kgm^2", "kg m^2"},
                                                        {"kg-m2", "kg m^2"},
                                                        {"kgcm²", "kg cm^2"},
                                                        {"gcm2", "g cm^2"},
                                                        {"1/kgm2", "kg^-1 m^-2"},
                                                        {"slug-ft^2", "slug ft^2"},
                                                        {"slugft2", "slug ft^2"},
                                                        {"ft-lb", "ft lbf"},
                                                        {"ftlb", "ft lbf"},
                                                        {"lb-ft", "lbf ft"},
                                                        {"lbft", "lbf ft"},
                                                        {"in-lbs", "in lbf"},
                                                        {"lbf-in", "lbf in"},
                                                        {"oz-in", "ozf in"},
                                                        {"lb-ft^2", "lb ft^2"},
                                                        {"lb-in2", "lb in^2"},
                                                        {"lbft2", "lb ft^2"},
                                                        {"ft-lb/deg", "ft lbf/deg"},
                                                        {"kgf-m", "kgf m"},
                                                        {"kgfcm", "kgf cm"},
                                                        {"kipft", "kip ft"},
                                                        {"mPas", "mPa s"},
                                                        {"mAh", "mA h"},
                                                        {"kVA", "kV A"},
                                                        {"mm2", "mm^2"},
                                                        {"mm3", "mm^3"},
                                                        {"mm**2", "mm^2"},
                                                        {"m/s2", "m/s^2"},
                                                        {"m s-2", "m s^-2"},
                                                        {"m s⁻²", "m/s^2"},
                                                        {"m·s^-2", "m/s^2"},
                                                        {"m/s^(2)", "m/s^2"},
                                                        {"kg·m²", "kg m^2"},
                                                        {"kg²m", "kg^2 m"},
                                                        {"rad/sec", "rad/s"},
                                                        {"deg/sec", "deg/s"},
                                                        {"meters per second", "m/s"},
                                                        {"rad per s", "rad/s"},
                                                        {"kilometers per hour", "km/h"},
                                                        {"kilonewtons", "kN"},
                                                        {"millimetre", "mm"},
                                                        {"Megapascals", "MPa"},
                                                        {"kilograms", "kg"},
                                                        {"µm", "um"},
                                                        {"tonnes", "Mg"}};
    for (const auto& [typed, meant] : same) {
        CAPTURE(std::string(typed));
        CHECK(said_of(typed) == "");
        const auto meaning = meaning_of_unit(typed), other = meaning_of_unit(meant);
        REQUIRE(meaning);
        REQUIRE(other);
        CHECK(meaning->factor == doctest::Approx(other->factor).epsilon(1e-15));
        CHECK(meaning->exponents == other->exponents);
        CHECK(meaning->is_si());
        const auto si = meaning_of_unit(meaning->si);
        REQUIRE_MESSAGE(si, meaning->si);
        CHECK(si->factor == 1);
        CHECK(si->exponents == meaning->exponents);
    }
}

TEST_CASE("units: a pound beside a foot or inch is a force in all spellings, as NIST has it") {
    // NIST SP 811 (2008), B.8: pound-force foot, pound-force inch, ounce-force inch.
    const std::pair<double, std::vector<const char*>> torques[] = {
        {1.355818, {"ft lb",       "lb ft",       "ft·lb",       "ft*lb",      "ft.lb",      "ft lbs",
                    "foot-pounds", "foot pounds", "foot-pound",  "pound-feet", "lbs-ft",     "lb-ft",
                    "ft-lb",       "ft-lbs",      "lbft",        "ftlbs",      "lbsft",      "footpounds",
                    "FT-LB",       "Ft Lb",       "(lb ft)",     "pound foot", "feet*lbs",   "lb (ft)",
                    "ft lb/rad",   "lbf ft",      "pounds feet", "lb⋅ft",      "foot‑pounds"}},
        {0.1129848,
         {"in lb", "lb in", "inch-pounds", "in-lbs", "lb-in", "in.lb", "pounds*inches", "inlb", "lbin"}},
        {7.061552e-3, {"oz in", "in oz", "oz-in", "in-oz", "ounce-inches", "ozin", "oz*in"}}};
    for (const auto& [factor, spellings] : torques)
        for (const std::string typed : spellings) {
            CAPTURE(typed);
            CHECK(said_of(typed) == "");
            const auto meaning = meaning_of_unit(typed);
            REQUIRE(meaning);
            CHECK(meaning->factor == doctest::Approx(factor).epsilon(5e-7));
            CHECK(value_of_factor(*meaning) == doctest::Approx(factor).epsilon(5e-7));
            CHECK(meaning_of_unit(meaning->si)->exponents == meaning->exponents);
        }
    // As a mass: moments of inertia, densities, flows, and a poundal (0.1382550 N in B.8).
    const std::pair<const char*, double> masses[] = {{"lb", 0.4535924},       {"lb-ft^2", 0.04214011},
                                                     {"lb ft2", 0.04214011},  {"lb/ft^3", 16.01846},
                                                     {"lb ft/s^2", 0.138255}, {"lb-ft/s2", 0.138255},
                                                     {"lb/(ft s)", 1.488164}, {"lb/s", 0.4535924},
                                                     {"lbm ft", 0.1382550},   {"kg/m", 1},
                                                     {"kg/m^2", 1},           {"kg m", 1}};
    for (const auto& [typed, factor] : masses) {
        CAPTURE(std::string(typed));
        CHECK(said_of(typed) == "");
        CHECK(meaning_of_unit(typed)->factor == doctest::Approx(factor).epsilon(5e-7));
    }
    CHECK(meaning_of_unit("lb in s^2")->exponents == UnitExponents{{"kg", 1}, {"m", 2}});  // of lbf
}

TEST_CASE("units: a mass where a force may be meant is told with its place and the unit of the force") {
    const std::pair<const char*, const char*> doubtful[] = {
        {"lb/in", "lbf/in"},         {"lbs/in", "lbf/in"},
        {"lb/in2", "lbf/in2"},       {"lb/in^2", "lbf/in^2"},
        {"lb/ft^2", "lbf/ft^2"},     {"kg/cm2", "kgf/cm2"},
        {"lb s/in", "lbf s/in"},     {"kg-cm", "kgf-cm"},
        {"kgcm", "kgfcm"},           {"kg/mm", "kgf/mm"},
        {"g cm", "gf cm"},           {"lb-s", "lbf-s"},
        {"oz/in", "ozf/in"},         {"in/lb", "in/lbf"},
        {"lb s^2/in", "lbf s^2/in"}, {"pounds per inch", "lbf per inch"},
        {"lb s^2 in", "lbf s^2 in"}, {"lb cm", "lbf cm"}};
    for (const auto& [typed, meant] : doubtful) {
        const std::string said = said_of(typed);
        CHECK_MESSAGE(holds(said, std::string("if a force is meant, write ") + meant), typed, ": ", said);
        CHECK_MESSAGE(holds(said, "is read with the mass"), said);
        CHECK(said_of(meant) == "");
    }
    // Once, and in expressions too.
    const Scene scene = parse_scene(
        "[parameters]\na = { value = 3, unit = \"lb/in\" }\nb = { value = 3, unit = "
        "\"lb/in\" }\nc = \"2 + 3 kg/cm^2/(1 kg/cm^2)\"\n[coordinates]\nx = 0\n"
        "[energy]\nkinetic = \"a*b*c*x'^2\"\n",
        "mass.toml");
    int of_pounds = 0, of_kilograms = 0;
    for (const Diagnostic& one : scene.warnings) {
        of_pounds += holds(one.message, "'lb/in' is read with the mass 'lb'") && one.place.line == 2;
        of_kilograms += holds(one.message, "write kgf/cm^2") && one.place.line == 4;
    }
    CHECK(of_pounds == 1);
    CHECK(of_kilograms >= 1);
}

TEST_CASE("units: hyphens after a number join units, or are refused where a name may be subtracted") {
    const auto read = [](const std::string& expression, const std::string& names = "m = 2\ns = 3\n") {
        try {
            const Scene scene = parse_scene("[parameters]\n" + names + "a = \"" + expression +
                                                "\"\n[coordinates]\nx = 1\n[energy]\nkinetic = \"a*x'^2\"\n",
                                            "hyphens.toml");
            const Expression& a = scene.parameters.back().value;
            const auto value = value_of(a);
            return value ? fmt::format("{:.6g}", *value) : a.text;
        } catch (const SceneError& error) {
            return std::string(error.what());
        }
    };
    const std::pair<const char*, const char*> units[] = {
        {"20 N-m", "20"},         {"20 ft-lb", "27.1164"},      {"20 lb-in", "2.2597"}, {"2 lb-ft", "2.71164"},
        {"20 oz-in", "0.141231"}, {"2 kW-h", "7.2e+06"},        {"3 N-m/rad", "3"},     {"3 N-s/m", "3"},
        {"2 kg-m^2", "2"},        {"2 foot-pounds", "2.71164"}, {"2 ft lb", "2.71164"}, {"3 N-m - 1 N-m", "2"}};
    for (const auto& [typed, value] : units) CHECK_MESSAGE(read(typed) == value, typed, ": ", read(typed));
    CHECK(read("20 N-m", "s = 3\n") == "20");
    CHECK(read("3 m-h", "s = 3\n") == "10800");
    CHECK(read("20 N - m") == "20 N - m");  // a difference
    CHECK(read("20-m") == "20-m");
    CHECK(read("5 mm-y", "y = 2\n") == "5 mm-y");
    CHECK(holds(read("3 m-s"), "write m*s for the unit, and m - s with blanks for the difference"));
    CHECK(holds(read("3 mm-m"), "write mm*m for the unit"));
}

TEST_CASE("units: what follows a number and is no unit is told with what was probably meant") {
    const auto said = [](const std::string& expression) {
        std::vector<Diagnostic> mistakes;
        KnownNames names;
        names.add("foo");
        return parse_expression(expression, {}, mistakes, &names) ? std::string("none") : mistakes.at(0).message;
    };
    const std::pair<const char*, const char*> cases[] = {
        {"3 mpa", "did you mean mPa or MPa"},
        {"3 tons", "did you mean tonne or 2000 lb"},
        {"3 mil", "did you mean thou"},
        {"3 nautical miles", "did you mean nmi"},
        {"30 degre", "did you mean degree"},
        {"3 bar mpa", "did you mean mPa or MPa"},
        {"2 ft 3 in", "the sum of two is written 2 ft + 3 in"},
        {"3 foo", "an operator is missing here; if a product was meant write 3*foo"},
        {"7 % 3", "there are no remainders"},
        {"3 furlong", "neither a known unit nor a name of the scene; if a product was meant write 3*furlong"}};
    for (const auto& [typed, words] : cases) CHECK_MESSAGE(holds(said(typed), words), typed, ": ", said(typed));
    CHECK(said("100 %") == "none");
    CHECK(said("foo*5 % + 2%") == "none");
    CHECK(said("1 g0 + 2 gn + 3 pH") == "none");
}

TEST_CASE("units: what is no unit is refused, with its place") {
    const std::pair<const char*, const char*> wrong[] = {
        {"m/", "1:26"},          {"/m", "1:25"},      {"3 m", "1:25"},   {"m*2", "1:27"},   {"m^", "1:26"},
        {"m^0.5", "1:26"},       {"m^(1/2)", "1:26"}, {"m^x", "1:26"},   {"(m", "1:25"},    {"m)", "1:26"},
        {"()", "1:26"},          {"m//s", "1:27"},    {"m*/s", "1:27"},  {"<m>", "1:25"},   {"m<b>", "1:26"},
        {"[m]", "1:25"},         {"m s'", "1:28"},    {"1e3 m", "1:25"}, {"m^99", "1:26"},  {"m^0", "1:26"},
        {"km^64*km^64", "1:33"}, {" ", "1:26"},       {"degC", "1:25"},  {"W/degC", "1:27"}};
    for (const auto& [typed, place] : wrong) {
        CAPTURE(std::string(typed));
        try {
            parse_scene(
                "parameters.a = { value = 3, unit = \"" + std::string(typed) + "\" }\n[coordinates]\nx = 0\n",
                "unit.toml");
            FAIL("it is read");
        } catch (const SceneError& error) {
            REQUIRE(!error.diagnostics.empty());
            CHECK(error.diagnostics[0].place.line == 1);
            const int column = std::stoi(std::string(place).substr(2)) + 12;  // of the first quote, 36
            CHECK_MESSAGE(error.diagnostics[0].place.column == column, error.what());
        }
    }
}

TEST_CASE("units: a word that is not known is warned of once, with what was probably meant") {
    const std::pair<const char*, const char*> doubtful[] = {
        {"furlong", "the unit 'furlong' of 'a' is not known, and numbers in it stay as they are; if"},
        {"metrs", "did you mean metre"},
        {"kilometre", ""},
        {"mpa", "did you mean mPa or MPa"},
        {"mhz", "mHz or MHz"},
        {"KN", "kn or kN"},
        {"MM", "mm"},
        {"NM", "N*m"},
        {"ton", "tonne or 2000 lb or 2240 lb"},
        {"Cal", "kcal or cal"},
        {"M", "did you mean m"},
        {"S", "s or 1/ohm"},
        {"n", "did you mean N"},
        {"PA", "did you mean Pa"},
        {"EV", "did you mean eV"},
        {"year", "365 day"},
        {"kNmmm", "did you mean"},
        {"N furlong/s", "furlong"},
        {"t", "tonne"},
        {"kiloton", "did you mean 1000 tonne"},
        {"ktons", "did you mean 1000 tonne"},
        {"nautical", "did you mean nmi"},
        {"kin", "numbers in it stay as they are; if it is a unit of your own, write in a table [units]"},
        {"furlong", "write in a table [units] what it is worth, as in furlong = \"2.5 m\""},
        {"l", "litre"}};
    for (const auto& [typed, words] : doubtful) {
        CAPTURE(std::string(typed));
        const std::string said = said_of(typed);
        CHECK_MESSAGE((*words == '\0' ? said.empty() : holds(said, words)), said);
    }
    const Scene twice = parse_scene(
        "[coordinates]\nx = { initial = 1, unit = \"cubit\" }\ny = { initial = 2, unit = "
        "\"cubit\" }\n[energy]\nkinetic = \"x'^2 + y'^2\"\n",
        "unit.toml");
    CHECK(std::count_if(twice.warnings.begin(), twice.warnings.end(),
                        [](const Diagnostic& one) { return one.kind == "unknown_unit"; }) == 1);
    CHECK(twice.warnings.at(0).place.line == 2);
    CHECK(said_of("furlong", "allow = [\"unknown_unit\"]\n").find("furlong") !=
          std::string::npos);  // the verbs leave it out
}

TEST_CASE("units: those of the scene's own are declared in terms of others, or as base units") {
    const Scene scene = parse_scene(R"toml([units]
furlong = "10 chain"
chain = "66 ft"
fortnight = "14 day"
smoot = "1.7018 m"
AU = "base"
[parameters]
v = { value = 3, unit = "furlong/fortnight" }
l = { value = "2 smoot", unit = "mm" }
a = { value = 1.52, unit = "AU" }
A = { value = 2, unit = "furlong2" }
smoots = 5
[coordinates]
x = { initial = "2 furlong + 1 m", unit = "m" }
[energy]
kinetic = "(v*l*a*A + smoots)*x'^2"
)toml",
                                    "own.toml");
    for (const Diagnostic& one : scene.warnings) CHECK_MESSAGE(one.kind != "unknown_unit", one.message);
    CHECK(*value_of(scene.parameters[0].value) == doctest::Approx(3 * 201.168 / 1209600).epsilon(1e-14));
    CHECK(scene.parameters[0].unit == "m/s");
    CHECK(*value_of(scene.parameters[1].value) == doctest::Approx(3.4036).epsilon(1e-14));
    CHECK(scene.parameters[2].unit == "AU");
    CHECK(scene.parameters[2].value.text == "1.52");
    CHECK(*value_of(scene.parameters[3].value) == doctest::Approx(2 * 201.168 * 201.168).epsilon(1e-14));
    CHECK(*value_of(scene.coordinates[0].initial) == doctest::Approx(403.336).epsilon(1e-14));
    CHECK(in_si(scene, "l", "3 smoot") == "(3*(1.7018))");
    CHECK(in_si(scene, "v", "1").find("201.168") == std::string::npos);  // 10*(66*(0.3048))
    CHECK_THROWS_AS(in_si(scene, "x", "20 kg"), ModelError);
    // The unit of theta follows from the sine.
    const Scene pendulum = parse_scene(
        "[parameters]\nl = { value = 2, unit = \"m\" }\n[coordinates]\ntheta = 1\n"
        "[[particle]]\nname = \"P\"\nmass = 1\nposition = [\"l*sin(theta)\", 0]\n",
        "pendulum.toml");
    CHECK_THROWS_AS(in_si(pendulum, "theta", "20 N"), ModelError);
    CHECK(in_si(pendulum, "theta", "20 deg") == "20 deg");
    CHECK(in_si(pendulum, "theta", "20") == "20");
    CHECK_THROWS_AS(in_si(scene, "x'", "3 m"), ModelError);
    CHECK_THROWS_AS(in_si(scene, "a", "3 m"), ModelError);
    CHECK(in_si(scene, "x'", "3 furlong/day").find("/(86400)") != std::string::npos);

    // Fractions, and plurals unless they are names of the scene.
    const Scene plurals = parse_scene(
        "[units]\ncubit = \"4/3 m\"\nspan = \"1/2 cubit\"\n[parameters]\na = \"3 cubits\"\nb "
        "= { value = 6, unit = \"cubits/s\" }\nspans = 2\n[coordinates]\nx = { initial = "
        "\"3 span\", unit = \"m\" }\n[energy]\nkinetic = \"a*b*spans*x'^2\"\n",
        "plurals.toml");
    CHECK(*value_of(plurals.parameters[0].value) == doctest::Approx(4).epsilon(1e-14));
    CHECK(*value_of(plurals.parameters[1].value) == doctest::Approx(8).epsilon(1e-14));
    CHECK(*value_of(plurals.coordinates[0].initial) == doctest::Approx(2).epsilon(1e-14));

    const std::pair<const char*, const char*> wrong[] = {{"m = \"3 ft\"", "'m' is a unit already"},
                                                         {"u = 3", "a string"},
                                                         {"u = \"3 yards/\"", "nothing follows '/'"},
                                                         {"u = \"v\"\nv = \"2 u\"", "refers to itself"},
                                                         {"u = \"3 metrs\"", "did you mean metre"},
                                                         {"u = \"3\"", "expected a number and a unit"},
                                                         {"u = \"-3 m\"", "expected a number and a unit"},
                                                         {"\"a b\" = \"3 m\"", "is no word"},
                                                         {"u = \"1e300 m\"", "range"},
                                                         {"u = \"0 m\"", "expected a number and a unit"}};
    for (const auto& [line, words] : wrong) {
        const std::string said = said_of("m", "[units]\n" + std::string(line) + "\n");
        CHECK_MESSAGE(holds(said, words), line, ": ", said);
        CHECK_MESSAGE(holds(said, "unit.toml:2:"), said);
    }
}

TEST_CASE("units: a name of the scene comes before a unit that is no symbol with an everyday prefix") {
    const auto read = [](const std::string& name, const std::string& expression) {
        try {
            parse_scene("[parameters]\n" + name +
                            " = 2\n[coordinates]\nx = 1\n[energy]\nkinetic = \"x'^2\"\npotential = \"" +
                            expression + "\"\n",
                        "names.toml");
        } catch (const SceneError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    for (const char* name : {"kp", "m2", "am", "pm", "mps", "day", "Nm", "deg2"})
        CHECK_MESSAGE(holds(read(name, "x*2 " + std::string(name)), "an operator is missing"), name);
    CHECK(read("kp", "x*3 kN*kp") == "");  // kN times the parameter
    CHECK(read("q", "x*2 m2 + x*3 kNm + x*2 miles") == "");
}

}  // namespace scene_unit_words
