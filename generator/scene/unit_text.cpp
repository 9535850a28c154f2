// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/unit_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>
#include <string_view>
#include <utility>

namespace alembert {

namespace {

struct KnownUnit {
    std::string_view word;
    UnitExponents exponents;
    double factor;
    std::string_view exact;  ///< as in UnitMeaning
    std::string_view si;     ///< likewise
    bool has_prefixes = false;
};

const UnitExponents length{{"m", 1}}, mass{{"kg", 1}}, duration{{"s", 1}}, angle{{"rad", 1}},
    force{{"kg", 1}, {"m", 1}, {"s", -2}}, work{{"kg", 1}, {"m", 2}, {"s", -2}},
    power{{"kg", 1}, {"m", 2}, {"s", -3}}, pressure{{"kg", 1}, {"m", -1}, {"s", -2}}, speed{{"m", 1}, {"s", -1}},
    turning{{"rad", 1}, {"s", -1}};

const double pi = std::acos(-1.0);
constexpr double pound = 0.45359237, inch = 0.0254, foot = 0.3048, gravity = 9.80665,
                 pound_force = pound * gravity;

const std::vector<KnownUnit> table{
    {"1", {}, 1, "", "1"},
    {"m", length, 1, "", "m", true},
    {"s", duration, 1, "", "s", true},
    {"g", mass, 1e-3, "0.001", "kg", true},
    {"kg", mass, 1, "", "kg"},
    {"rad", angle, 1, "", "rad", true},
    {"A", {{"A", 1}}, 1, "", "A", true},
    {"K", {{"K", 1}}, 1, "", "K", true},
    {"mol", {{"mol", 1}}, 1, "", "mol", true},
    {"cd", {{"cd", 1}}, 1, "", "cd"},
    {"N", force, 1, "", "N", true},
    {"J", work, 1, "", "J", true},
    {"W", power, 1, "", "W", true},
    {"Pa", pressure, 1, "", "Pa", true},
    {"Hz", {{"s", -1}}, 1, "", "Hz", true},
    {"C", {{"A", 1}, {"s", 1}}, 1, "", "C", true},
    {"V", {{"kg", 1}, {"m", 2}, {"s", -3}, {"A", -1}}, 1, "", "V", true},
    {"T", {{"kg", 1}, {"s", -2}, {"A", -1}}, 1, "", "T", true},
    {"F", {{"kg", -1}, {"m", -2}, {"s", 4}, {"A", 2}}, 1, "", "F", true},
    {"H", {{"kg", 1}, {"m", 2}, {"s", -2}, {"A", -2}}, 1, "", "H", true},
    {"ohm", {{"kg", 1}, {"m", 2}, {"s", -3}, {"A", -2}}, 1, "", "ohm", true},
    {"deg", angle, pi / 180, "pi/180", "rad"},
    {"°", angle, pi / 180, "pi/180", "rad"},
    {"rev", angle, 2 * pi, "2*pi", "rad"},
    {"rpm", turning, pi / 30, "pi/30", "rad/s"},
    {"in", length, inch, "0.0254", "m"},
    {"ft", length, foot, "0.3048", "m"},
    {"yd", length, 3 * foot, "0.9144", "m"},
    {"mi", length, 5280 * foot, "1609.344", "m"},
    {"min", duration, 60, "60", "s"},
    {"h", duration, 3600, "3600", "s"},
    {"lb", mass, pound, "0.45359237", "kg"},
    {"lbm", mass, pound, "0.45359237", "kg"},
    {"oz", mass, pound / 16, "0.45359237/16", "kg"},
    {"slug", mass, pound_force / foot, "0.45359237*9.80665/0.3048", "kg"},
    {"lbf", force, pound_force, "0.45359237*9.80665", "N"},
    {"kip", force, 1000 * pound_force, "453.59237*9.80665", "N"},
    {"kgf", force, gravity, "9.80665", "N"},
    {"dyn", force, 1e-5, "0.00001", "N"},
    {"erg", work, 1e-7, "0.0000001", "J"},
    {"cal", work, 4.184, "4.184", "J", true},
    {"Wh", work, 3600, "3600", "J", true},
    {"hp", power, 550 * foot* pound_force, "550*0.3048*0.45359237*9.80665", "W"},
    {"PS", power, 75 * gravity, "75*9.80665", "W"},
    {"bar", pressure, 1e5, "100000", "Pa", true},
    {"atm", pressure, 101325, "101325", "Pa"},
    {"psi", pressure, pound_force / (inch * inch), "0.45359237*9.80665/0.0254^2", "Pa"},
    {"mph", speed, 5280 * foot / 3600, "1609.344/3600", "m/s"},
    {"kmh", speed, 1 / 3.6, "1/3.6", "m/s"},
    {"kn", speed, 1852.0 / 3600, "1852/3600", "m/s"},
};

/// Other spellings.
const std::map<std::string_view, std::string_view> synonyms{
    {"meter", "m"},         {"meters", "m"},    {"metre", "m"},      {"metres", "m"},
    {"second", "s"},        {"seconds", "s"},   {"sec", "s"},        {"gram", "g"},
    {"grams", "g"},         {"kilogram", "kg"}, {"kilograms", "kg"}, {"radian", "rad"},
    {"radians", "rad"},     {"degree", "deg"},  {"degrees", "deg"},  {"newton", "N"},
    {"newtons", "N"},       {"joule", "J"},     {"joules", "J"},     {"watt", "W"},
    {"watts", "W"},         {"pascal", "Pa"},   {"hertz", "Hz"},     {"inch", "in"},
    {"inches", "in"},       {"foot", "ft"},     {"feet", "ft"},      {"pound", "lb"},
    {"pounds", "lb"},       {"lbs", "lb"},      {"minute", "min"},   {"minutes", "min"},
    {"hour", "h"},          {"hours", "h"},     {"hr", "h"},         {"revolution", "rev"},
    {"revolutions", "rev"}, {"turn", "rev"},    {"turns", "rev"},    {"Ohm", "ohm"},
    {"Ω", "ohm"},           {"º", "°"}};

struct Prefix {
    std::string_view letter;
    int ten;
};

constexpr Prefix prefixes[] = {{"da", 1}, {"n", -9}, {"u", -6}, {"µ", -6}, {"μ", -6}, {"m", -3}, {"c", -2},
                               {"d", -1}, {"h", 2},  {"k", 3},  {"M", 6},  {"G", 9},  {"T", 12}};

const KnownUnit* find_unit(std::string_view word) {
    if (const auto other = synonyms.find(word); other != synonyms.end()) word = other->second;
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

std::optional<UnitMeaning> meaning_of_word(const std::string& word) {
    if (const KnownUnit* const unit = find_unit(word)) return meaning_of(*unit);
    for (const Prefix& prefix : prefixes) {
        if (!word.starts_with(prefix.letter)) continue;
        const KnownUnit* const unit = find_unit(std::string_view(word).substr(prefix.letter.size()));
        if (unit == nullptr || !unit->has_prefixes) continue;
        UnitMeaning result = meaning_of(*unit);
        const int ten = prefix.ten - (unit->word == "g" ? 3 : 0);  // kg is the unit of the SI
        result.factor = ten == 0            ? 1
                        : unit->word == "g" ? std::pow(10.0, ten)
                                            : std::pow(10.0, ten) * unit->factor;
        result.exact = ten == 0 ? "" : power_of_ten(ten);
        if (unit->word != "g" && !unit->exact.empty()) result.exact += fmt::format("*({})", unit->exact);
        return result;
    }
    return {};
}

class UnitText {
public:
    explicit UnitText(const std::string& text) : text_(text) {}

    std::optional<UnitMeaning> meaning() {
        UnitMeaning result = product();
        if (bad_ || at_ < text_.size()) return std::nullopt;
        return result;
    }

private:
    bool take(char c) {
        if (at_ >= text_.size() || text_[at_] != c) return false;
        ++at_;
        return true;
    }

    UnitMeaning product() {
        UnitMeaning result;
        bool divides = false;
        std::size_t after = at_;  // the end of the part before, so that what joins two parts is kept
        while (at_ < text_.size() && text_[at_] != ')' && !bad_) {
            if (take(' ') || take('*') || take('.')) continue;
            if (take('/')) {
                divides = true;
                continue;
            }
            const std::string joined = text_.substr(after, at_ - after);
            UnitMeaning factor = take('(') ? in_brackets() : word();
            const std::size_t begin = at_;
            const double power = (divides ? -1 : 1) * exponent();
            const bool is_alone = result.si.empty() && begin == text_.size();
            result.si += joined + (is_compound(factor) && !is_alone ? "(" + factor.si + ")" : factor.si) +
                         text_.substr(begin, at_ - begin);
            multiply(result, factor, power);
            after = at_;
            divides = false;
        }
        return result;
    }

    UnitMeaning in_brackets() {
        UnitMeaning inside = product();
        bad_ = bad_ || !take(')');
        inside.si = "(" + inside.si + ")";
        return inside;
    }

    /// Whether its unit of the SI, unlike itself, is made of several: "rpm".
    static bool is_compound(const UnitMeaning& word) {
        return !word.si.starts_with('(') && word.si.find('/') != std::string::npos;
    }

    static void multiply(UnitMeaning& result, const UnitMeaning& factor, double power) {
        result.exponents = multiplied(std::move(result.exponents), factor.exponents, power);
        result.factor *= std::pow(factor.factor, power);
        if (factor.exact.empty()) return;
        const double size = std::abs(power);
        if (result.exact.empty() && power == 1) {
            result.exact = factor.exact;
            return;
        }
        if (result.exact.empty()) result.exact = "1";
        result.exact += fmt::format("{}({}){}", power < 0 ? "/" : "*", factor.exact,
                                    size == 1 ? "" : fmt::format("^{}", size));
    }

    double exponent() {
        if (take_text("²")) return 2;
        if (take_text("³")) return 3;
        if (!take('^')) return 1;
        const bool minus = take('-');
        int value = 0;
        const std::size_t start = at_;
        while (at_ < text_.size() && std::isdigit(static_cast<unsigned char>(text_[at_])) != 0)
            value = std::min(1000, 10 * value + (text_[at_++] - '0'));
        bad_ = bad_ || at_ == start || value > 99;
        return minus ? -value : value;
    }

    bool take_text(std::string_view words) {
        if (text_.compare(at_, words.size(), words) != 0) return false;
        at_ += words.size();
        return true;
    }

    UnitMeaning word() {
        const std::size_t start = at_;
        while (at_ < text_.size() && std::string(" *./^()").find(text_[at_]) == std::string::npos &&
               text_.compare(at_, 2, "²") != 0 && text_.compare(at_, 2, "³") != 0)
            ++at_;
        const std::string name = text_.substr(start, at_ - start);
        bad_ = bad_ || name.empty();
        if (const auto known = meaning_of_word(name)) return *known;
        return {{{name, 1}}, 1, "", name};
    }

    const std::string& text_;
    std::size_t at_ = 0;
    bool bad_ = false;
};

}  // namespace

UnitExponents multiplied(UnitExponents a, const UnitExponents& b, double exponent) {
    for (const auto& [base, power] : b)
        if ((a[base] += exponent * power) == 0) a.erase(base);
    return a;
}

bool UnitMeaning::is_si() const {
    static const std::set<std::string> bases{"kg", "m", "s", "A", "K", "mol", "cd", "rad"};
    return std::all_of(exponents.begin(), exponents.end(),
                       [](const auto& entry) { return bases.contains(entry.first); });
}

std::optional<UnitMeaning> meaning_of_unit(const std::string& text) {
    return UnitText(text).meaning();
}

bool is_known_unit(const std::string& word) {
    return meaning_of_word(word).has_value();
}

bool is_no_multiple(const std::string& word) {
    static const std::set<std::string> words{"degC",       "degF", "°C",  "°F", "celsius",
                                             "fahrenheit", "dB",   "dBA", "Np", "pH"};
    return words.contains(word);
}

}  // namespace alembert
