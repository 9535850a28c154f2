// SPDX-License-Identifier: GPL-2.0-or-later
// Values in numbers, as a page has them at its end: ω = 4.47 rad/s, with the values that it states. They hold to
// the digits that are written.
#include "check/derivation/marker.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/language/say.hpp"
#include "scene/unit_text.hpp"

namespace alembert {

using GiNaC::ex;
using Kind = Math::Kind;

namespace {

/// A number as it is written, with its unit.
struct Printed {
    const Math* number = nullptr;
    std::string unit = {};
    bool is_negative = false;
    bool is_unit_of_letters = false;  ///< whether the unit stands there as letters
    bool is_rounded() const { return number != nullptr && number->text.find_first_of(".eE") != std::string::npos; }
};

struct UnitOfLetters {
    std::string text = {};
    bool is_certain = false;  ///< whether no letter of an author looks so: kg, Nm
};

/// 26.5 N of plain text, where N is a letter: letters behind a number that are a unit. They are read as one only
/// where one of them is no name of the scene.
UnitOfLetters unit_of_letters(const Math& product, const Letters& letters, bool may_be_names = false) {
    UnitOfLetters unit;
    bool is_strange = may_be_names;
    for (std::size_t k = 1; k < product.args.size(); ++k) {
        const bool is_power = product.args[k]->kind == Kind::power;
        const Math& letter = is_power ? *product.args[k]->args[0] : *product.args[k];
        if (letter.kind != Kind::letter || letter.dots > 0 || !letter.letter.index.empty()) return {};
        const bool is_known = letters.name_of(letter.letter).has_value();
        is_strange = is_strange || !is_known;
        unit.is_certain = unit.is_certain || (!is_known && letter.letter.base.size() > 1);
        unit.text += (unit.text.empty() ? "" : "*") + letter.letter.base;
        if (!is_power) continue;
        const Math& exponent = *product.args[k]->args[1];
        const bool is_negative = exponent.kind == Kind::negate;
        const Math& number = is_negative ? *exponent.args[0] : exponent;
        if (number.kind != Kind::number) return {};
        unit.text += (is_negative ? "^-" : "^") + number.text;
        unit.is_certain = unit.is_certain || is_negative;
    }
    return is_strange && meaning_of_unit(unit.text) ? unit : UnitOfLetters{};
}

Printed printed(const Math& side, const Letters& letters) {
    if (side.kind == Kind::number) return {.number = &side};
    if (side.kind == Kind::negate) {
        Printed inner = printed(*side.args[0], letters);
        inner.is_negative = !inner.is_negative;
        return inner;
    }
    if (side.kind == Kind::quantity && side.args[0]->kind == Kind::number)
        return {.number = side.args[0].get(), .unit = side.text};
    if (side.kind != Kind::product || side.args[0]->kind != Kind::number) return {};
    const UnitOfLetters unit = unit_of_letters(side, letters);
    Printed result{.number = side.args[0].get(), .unit = unit.text, .is_unit_of_letters = true};
    return (result.is_rounded() || unit.is_certain) && !unit.text.empty() ? result : Printed{};
}

}  // namespace

bool may_be_number_with_unit(const Math& side, const Letters& letters) {
    const bool is_product = side.kind == Kind::product && side.args[0]->kind == Kind::number;
    return printed(side, letters).number != nullptr ||
           (is_product && !unit_of_letters(side, letters, true).text.empty());
}

namespace {

/// What one unit of the last digit is worth.
double last_digit(const std::string& text) {
    const std::size_t power = text.find_first_of("eE"), point = text.find('.');
    const std::string mantissa = text.substr(0, power);
    const int exponent = power == std::string::npos ? 0 : std::atoi(text.c_str() + power + 1);
    const int digits = point == std::string::npos ? 0 : static_cast<int>(mantissa.size() - point) - 1;
    return std::pow(10.0, exponent - digits);
}

/// Whether another number comes from a factor or a sign that is easily lost. Otherwise a value may have been
/// read otherwise than it is meant, and so may a unit where it is a power of ten.
bool is_slip_of_number(double written, double exact, double digit) {
    constexpr double least_precision = 0.05;  // of a number of one digit any factor could have been lost
    const double pi = std::acos(-1.0);
    if (digit > least_precision * std::abs(written)) return false;
    for (const double factor :
         {-1.0, 2.0, 0.5, 4.0, 0.25, 3.0, std::sqrt(2.0), std::sqrt(0.5), pi, 1 / pi, 2 * pi, 1 / (2 * pi)})
        if (std::abs(exact * factor - written) <= std::max(digit, 2e-3 * std::abs(exact * factor))) return true;
    return false;
}

}  // namespace

bool is_rounded_value(const Math& side) {
    return side.kind == Kind::quantity || (side.kind == Kind::number && Printed{.number = &side}.is_rounded());
}

bool holds_decimals(const Math& math) {
    return (math.kind == Kind::number && Printed{.number = &math}.is_rounded()) ||
           std::any_of(math.args.begin(), math.args.end(),
                       [](const MathPtr& arg) { return holds_decimals(*arg); });
}

/// Decimals, or numbers that no coefficient has: (1100 − 981)/36.
bool holds_data(const Math& math) {
    constexpr double largest_coefficient = 100;
    return holds_decimals(math) ||
           (math.kind == Kind::number && std::atof(math.text.c_str()) > largest_coefficient) ||
           std::any_of(math.args.begin(), math.args.end(), [](const MathPtr& arg) { return holds_data(*arg); });
}

/// Of the scene's parameters.
GiNaC::exmap Marker::own_values() const {
    GiNaC::exmap own;
    for (const Mechanism::Parameter& p : system_.mechanism().parameters)
        if (p.independent) own[p.symbol] = p.number();
    return own;
}

/// l = 4 m of plain text, where m is a mass: four metres, where this is the scene's own value.
std::optional<ex> Marker::datum_of(const ex& parameter, const Math& stated) {
    constexpr double least_difference = 1e-9;
    if (stated.kind != Kind::product || stated.args[0]->kind != Kind::number) return std::nullopt;
    const auto unit = meaning_of_unit(unit_of_letters(stated, letters_, true).text);
    const GiNaC::exmap own = own_values();
    const auto known = own.find(parameter);
    if (!unit || known == own.end()) return std::nullopt;
    const double there = GiNaC::ex_to<GiNaC::numeric>(known->second).to_double(),
                 value = std::atof(stated.args[0]->text.c_str()) * unit->factor;
    if (std::abs(there - value) > least_difference * std::abs(value)) return std::nullopt;
    return truth_.value(fmt::format("{}*({})", stated.args[0]->text, unit->exact.empty() ? "1" : unit->exact));
}

/// Nothing of what is no real number with these values.
std::optional<double> Marker::in_numbers(const ex& value, const GiNaC::exmap& values) const {
    ex there;
    try {
        there = system_.mechanism().z->expand(value).subs(values, GiNaC::subs_options::no_pattern).evalf();
    } catch (const std::domain_error&) {  // a division by zero, also GiNaC's pole_error
        return std::nullopt;
    } catch (const std::overflow_error&) {
        return std::nullopt;
    }
    if (!GiNaC::is_a<GiNaC::numeric>(there) || !GiNaC::ex_to<GiNaC::numeric>(there).is_real()) return std::nullopt;
    return GiNaC::ex_to<GiNaC::numeric>(there).to_double();
}

/// (1.2 · 9.81)/50 m: of numbers alone, with data among them.
std::optional<double> Marker::value_of_numbers(const Math& side) {
    std::map<Letter, int> all;
    collect_letters(side, all);
    if (!holds_data(side)) return std::nullopt;
    const bool may_have_unit = side.kind == Kind::product && side.args.size() == 2 &&
                               side.args[1]->kind == Kind::letter && side.args[1]->letter.index.empty() &&
                               all.size() == 1;
    if (may_have_unit && meaning_of_unit(side.args[1]->letter.base)) {  // (1.2 · 9.81)/50 m, whatever m is
        const std::optional<double> number = value_of_numbers(*side.args[0]);
        return number ? std::optional(*number * meaning_of_unit(side.args[1]->letter.base)->factor) : std::nullopt;
    }
    if (!all.empty()) return std::nullopt;
    return in_numbers(truth_.value(claim_text(side, as_written()).text), {});
}

/// ω_1² + ω_2² = 3 ω_0² where ω_1 is 0.618 ω_0: of constants, with the scene's values.
bool Marker::holds_to_digits(const Sides& sides) {
    constexpr double rounding_on_the_way = 2e-3;
    const auto is_rounded = [&](const std::string& name) { return rounded_.contains(name); };
    if (std::none_of(sides.left.names.begin(), sides.left.names.end(), is_rounded) &&
        std::none_of(sides.right.names.begin(), sides.right.names.end(), is_rounded))
        return false;
    const GiNaC::exmap own = own_values();
    const auto left = in_numbers(truth_.value(sides.left.text), own),
               right = in_numbers(truth_.value(sides.right.text), own);
    return left && right &&
           std::abs(*left - *right) <= rounding_on_the_way * std::max(std::abs(*left), std::abs(*right));
}

bool Marker::holds_letters_that_move(const Math& math) const {
    std::map<Letter, int> all;
    collect_letters(math, all);
    return std::any_of(all.begin(), all.end(), [&](const auto& item) {
        return letters_.moves(letters_.name_of(item.first).value_or(""));
    });
}

/// m g/k = (1.2 · 9.81)/50 m: numbers put in. Not judged where they are not those that the page or the scene has.
bool Marker::judge_calculation(MarkedLine& line, const Math& formula, double written) {
    constexpr double rounding_on_the_way = 2e-3;
    std::map<Letter, int> all;
    collect_letters(formula, all);
    for (const auto& [letter, dots] : all)
        if (!letters_.name_of(letter)) return false;
    const ex truth = truth_.value(claim_text(formula, as_written()).text);
    const auto fits = [&](const GiNaC::exmap& values) {
        const std::optional<double> exact = in_numbers(truth, values);
        return exact && std::abs(*exact - written) <= rounding_on_the_way * std::abs(*exact);
    };
    const bool holds = fits(special_.all()) || fits(own_values());
    line.status = holds ? LineStatus::right : LineStatus::not_about_scene;
    line.reason =
        holds ? say("to the digits that are written") : say("a value in numbers; lines are judged for all values");
    return true;
}

/// Whether one side is a value in numbers; then it is held against the other with the values that the derivation
/// states, else with those of the scene.
bool Marker::judge_value(MarkedLine& line, const Math& lhs, const Math& rhs, Relation relation) {
    constexpr double rounding_on_the_way = 2e-3;
    const Printed left = printed(lhs, letters_), right = printed(rhs, letters_);
    const std::optional<double> by_left = value_of_numbers(lhs), by_right = value_of_numbers(rhs);
    if (left.number == nullptr && right.number == nullptr && by_left.has_value() != by_right.has_value())
        return judge_calculation(line, by_left ? rhs : lhs, by_left ? *by_left : *by_right);
    if ((left.number == nullptr) == (right.number == nullptr)) return false;
    const Printed& value = left.number != nullptr ? left : right;
    const Math& other = left.number != nullptr ? rhs : lhs;
    const bool may_be_rounded = relation == Relation::approximately && value.number->text != "0" &&
                                !holds_rates(other) && !holds_letters_that_move(other);
    if (!value.is_rounded() && value.unit.empty() && !may_be_rounded) return false;
    std::map<Letter, int> all;
    collect_letters(other, all);
    const bool is_known = std::all_of(all.begin(), all.end(),
                                      [&](const auto& item) { return letters_.name_of(item.first).has_value(); });
    const bool is_rounded = value.is_rounded() || relation == Relation::approximately;
    if ((all.empty() && !is_rounded) || (!is_known && lone_letter(other).letter != nullptr))
        return false;  // it defines the letter
    const auto unit = value.unit.empty() || value.unit == "deg" ? std::nullopt : meaning_of_unit(value.unit);
    const double scale = value.unit == "deg" ? std::acos(-1.0) / 180 : unit ? unit->factor : 1;
    const double written = (value.is_negative ? -1 : 1) * std::atof(value.number->text.c_str()) * scale;
    const double digit = last_digit(value.number->text) * scale;
    const bool is_short = std::abs(written) < 100 * digit;  // 8 m/s says less than 8.00 m/s, and is rounded once
    const double in_last_digit = is_short ? 0.6 : 2;
    line.status = LineStatus::not_about_scene;
    line.reason = say("a value in numbers; lines are judged for all values");
    if (!is_known) return true;
    const ex truth = truth_.value(claim_text(other, as_written()).text);
    const auto fits = [&](const GiNaC::exmap& values) -> std::optional<bool> {
        const std::optional<double> exact = in_numbers(truth, values);
        if (!exact) return std::nullopt;
        return std::abs(*exact - written) <=
               std::max(in_last_digit * digit, rounding_on_the_way * std::abs(*exact));
    };
    const std::optional<bool> stated = fits(special_.all());
    if (!stated && fits(own_values()) != true) return true;
    const std::optional<double> exact = in_numbers(truth, special_.all());
    const bool is_slip =
        stated == false && is_slip_of_number(written, *exact, std::max(in_last_digit * digit, 0.0));
    line.status = stated != false ? LineStatus::right : is_slip ? LineStatus::mistake : LineStatus::undecided;
    line.reason = stated == false ? say("with the values that stand above it is {:.6g}", *exact / scale)
                  : value.is_unit_of_letters
                      ? say("to the digits that are written; {} is read as a unit", value.unit)
                      : say("to the digits that are written");
    notes_.back().is_sure = line.status == LineStatus::mistake;
    if (line.status == LineStatus::mistake)
        line.claim = claim_text(other, as_written()).text + fmt::format(" = {:.6g}", written);
    return true;
}

}  // namespace alembert
