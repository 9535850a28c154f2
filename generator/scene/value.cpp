// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "base/language/say.hpp"
#include "scene/advice.hpp"
#include "scene/keys.hpp"
#include "scene/text.hpp"
#include "scene/typed.hpp"
#include "scene/typed_words.hpp"

namespace alembert {
namespace {

/// A number exactly as typed, without the sign + and separators; hexadecimal, octal and binary numbers are
/// converted to decimal.
Literal read_number(const Reading& reading, const toml::node& node) {
    const std::string_view text = reading.source.text();
    std::size_t at = reading.source.offset(place_of(node));
    Literal literal;
    if (const auto* integer = node.as_integer();
        integer && text.substr(at, 3).find_first_of("xob") != std::string_view::npos) {
        literal.text = fmt::format("{}", integer->get());
        literal.places.assign(literal.text.size() + 1, place_of(node));
        return literal;
    }
    for (; at < text.size() && std::string_view("+-.0123456789eE_").find(text[at]) != std::string_view::npos;
         ++at) {
        if (text[at] == '_' || (text[at] == '+' && literal.text.empty())) continue;
        literal.text += text[at];
        literal.places.push_back(reading.source.place(at));
    }
    literal.places.push_back(reading.source.place(at));
    return literal;
}

/// The string with a place for each byte. Should the two readings of it differ, all bytes have the place of its
/// beginning.
Literal read_literal(const Reading& reading, const toml::node& node) {
    const std::string& text = node.as_string()->get();
    Literal literal = read_string(reading.source, reading.source.offset(place_of(node)));
    if (literal.text != text) literal = {text, std::vector<Place>(text.size() + 1, place_of(node))};
    return literal;
}

/// Commands of LaTeX in a string with double quotes, in which a backslash begins a sign of TOML: "\theta" is a tab
/// and "heta". False if there is one.
bool check_backslashes(const Reading& reading, const toml::node& node) {
    const std::string_view text = reading.source.text();
    std::size_t at = reading.source.offset(place_of(node));
    if (at >= text.size() || text[at] != '"') return true;
    for (++at; at < text.size() && text[at] != '"' && text[at] != '\n'; ++at) {
        if (text[at] != '\\') continue;
        const std::string_view command = word_at(text, at + 1);
        const std::string advice = advice_on_command(command);
        if (!advice.empty())
            return reading.complain(
                       reading.source.place(at),
                       say("a backslash in \"…\" begins a sign of TOML; for \\{} write {}", command, advice)),
                   false;
        ++at;
    }
    return true;
}

/// A string as an expression is read from it: in the words and signs of the language.
Literal read_words(const Reading& reading, const toml::node& node) {
    Literal literal = read_literal(reading, node);
    write_in_words(literal.text, literal.places, reading.names);
    return literal;
}

std::string mismatch(const std::string& what, const toml::node& node, std::string_view expected) {
    return say("{} is {}; expected {}", what, kind_of(node), expected);
}

}  // namespace

Place place_of(const toml::node& node) {
    const toml::source_position begin = node.source().begin;
    return {static_cast<int>(begin.line), static_cast<int>(begin.column)};
}

std::size_t Reading::mistakes() const {
    return static_cast<std::size_t>(
        std::count_if(diagnostics.begin(), diagnostics.end(),
                      [](const Diagnostic& one) { return one.severity == Severity::error; }));
}

std::string kind_of(const toml::node& node) {
    switch (node.type()) {
        case toml::node_type::string:
            return labelled(say("the string"), node.as_string()->get());
        case toml::node_type::integer:
            return say("the integer {}", node.as_integer()->get());
        case toml::node_type::floating_point: {
            const double value = node.as_floating_point()->get();
            if (std::isnan(value)) return "nan";
            if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
            return say("the number {}", value);
        }
        case toml::node_type::boolean:
            return node.as_boolean()->get() ? "true" : "false";
        case toml::node_type::array:
            return say("an array");
        case toml::node_type::table:
            return say("a table");
        case toml::node_type::date:
            return say("a date");
        case toml::node_type::time:
            return say("a time of day");
        default:
            return say("a date and time");
    }
}

Expression read_expression(const Reading& reading, const toml::node& node, const std::string& what) {
    if (node.is_string()) {
        if (!check_backslashes(reading, node)) return {};
        Literal literal = read_words(reading, node);
        return parse_expression(std::move(literal.text), std::move(literal.places), reading.diagnostics,
                                &reading.names);
    }
    if (const auto* number = node.as_floating_point(); number && !std::isfinite(number->get())) {
        reading.complain(place_of(node), mismatch(what, node, say("a finite number")));
        return {};
    }
    if (node.is_number()) {
        Literal literal = read_number(reading, node);
        return parse_expression(std::move(literal.text), std::move(literal.places), reading.diagnostics);
    }
    reading.complain(place_of(node), mismatch(what, node, say("a number or an expression in quotes")));
    return {};
}

Equality read_equality(const Reading& reading, const toml::node& node, bool rates_before) {
    if (!check_backslashes(reading, node)) return {};
    const Literal literal = read_words(reading, node);
    return parse_equality(literal.text, literal.places, reading.diagnostics, rates_before, &reading.names);
}

std::vector<Inequality> read_inequalities(const Reading& reading, const toml::node& node,
                                          const std::string& what) {
    std::vector<Inequality> result;
    const auto read = [&](const toml::node& one) {
        if (!one.is_string()) {
            reading.complain(place_of(one),
                             mismatch(what, one, say("an inequality in quotes, or an array of them")));
            return;
        }
        if (!check_backslashes(reading, one)) return;
        const Literal literal = read_words(reading, one);
        result.push_back(parse_inequality(literal.text, literal.places, reading.diagnostics, &reading.names));
    };
    if (const toml::array* const array = node.as_array())
        for (const toml::node& element : *array) read(element);
    else
        read(node);
    return result;
}

Expression zero(Place place) {
    std::vector<Diagnostic> none;
    return parse_expression("0", {place, place}, none);
}

std::optional<Name> read_name(const Reading& reading, const toml::node& node, const std::string& what) {
    if (!node.is_string()) {
        reading.complain(place_of(node), mismatch(what, node, say("a name in quotes")));
        return {};
    }
    const Literal literal = read_literal(reading, node);
    return Name{reading.names.spelled(plain_name(literal.text)), literal.places.front()};
}

std::vector<Name> read_names(const Reading& reading, const toml::node& node, const std::string& what) {
    std::vector<Name> names;
    const toml::array* array = node.as_array();
    if (!array) {
        reading.complain(place_of(node), mismatch(what, node, say("an array of names")));
        return names;
    }
    for (const toml::node& element : *array)
        if (auto name = read_name(reading, element, say("an element of {}", what)))
            names.push_back(std::move(*name));
    return names;
}

namespace {

/// [0, -9,81]: a comma between digits may be a decimal one where others have a blank behind them.
std::optional<Diagnostic> doubt_of_commas(const Reading& reading, const toml::array& array) {
    const std::string_view text = reading.source.text();
    bool has_blanks = false;
    std::size_t suspicious = 0;
    for (std::size_t i = 0; i + 1 < array.size(); ++i) {
        const std::size_t next = reading.source.offset(place_of(*array.get(i + 1)));
        const bool is_tight = next > 1 && text[next - 1] == ',';
        has_blanks = has_blanks || !is_tight;
        const bool has_digits = is_tight && is_digit(static_cast<unsigned char>(text[next - 2])) &&
                                is_digit(static_cast<unsigned char>(text[next]));
        const auto* const digits = array.get(i + 1)->as_integer();
        if (has_digits && array.get(i)->is_integer() && digits && digits->get() != 0) suspicious = i + 1;
    }
    if (!has_blanks || suspicious == 0 || array.size() < 3) return {};
    const toml::node& first = *array.get(suspicious - 1);
    return Diagnostic{place_of(first),
                      say("{0},{1} is two components; as one number it is {0}.{1}",
                          read_number(reading, first).text, read_number(reading, *array.get(suspicious)).text),
                      Severity::warning, "suspicious_number"};
}

}  // namespace

Vector read_vector(const Reading& reading, const toml::node& node, const std::string& what) {
    Vector vector;
    vector.place = place_of(node);
    const toml::array* array = node.as_array();
    if (!array) {
        const bool is_number = node.is_number();
        const std::string number = is_number ? read_number(reading, node).text : "";
        reading.complain(
            vector.place,
            mismatch(what, node, say("a vector: an array of two or three components")) +
                (is_number ? say(", as in [0, {}{}]", number.starts_with('-') ? "" : "-", number) : ""));
        return vector;
    }
    if (array->size() < 2 || array->size() > 3) {
        std::string message = say("{} has {} component{}; a vector has two or three", what, array->size(),
                                  array->size() == 1 ? "" : "s");
        if (const auto doubt = doubt_of_commas(reading, *array)) message += "; " + doubt->message;
        reading.complain(vector.place, message);
        return vector;
    }
    if (const auto doubt = doubt_of_commas(reading, *array)) reading.diagnostics.push_back(*doubt);
    for (std::size_t i = 0; i < array->size(); ++i)
        vector.component[i] = read_expression(reading, *array->get(i), say("a component of {}", what));
    if (array->size() == 2) vector.component[2] = zero(vector.place);
    return vector;
}

namespace {

/// What to write in place of a key that the table does not have.
std::string advice_on_key(std::string_view table, const std::string& key) {
    const std::span<const std::string_view> known = keys_of(table), top = keys_of("");
    std::string meant(key_meant(table, key));
    if (meant.empty() && std::find(top.begin(), top.end(), key) != top.end())
        return say("it belongs to the whole scene; write it above the first table");
    if (meant.empty()) meant = nearest(key, {known.begin(), known.end()});
    return meant.empty() ? say("it may have {}", fmt::join(known, ", ")) : say("did you mean '{}'?", meant);
}

}  // namespace

Table::Table(const Reading& reading, const toml::table& table, std::string title, Place place)
    : reading_(&reading), title_(std::move(title)), place_(place) {
    for (const auto& [key, node] : table) {
        const toml::source_position begin = key.source().begin;
        entries_.push_back({plain_name(std::string(key.str())),
                            {static_cast<int>(begin.line), static_cast<int>(begin.column)},
                            &node});
    }
    std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) { return a.place < b.place; });
}

void Table::allow(std::string_view name) const {
    const std::span<const std::string_view> known = keys_of(name);
    for (const Entry& entry : entries_) {
        if (std::find(known.begin(), known.end(), entry.key) != known.end()) continue;
        reading_->complain(entry.place, say("unknown key {} in {}; {}", in_quotes(entry.key), title_,
                                            advice_on_key(name, entry.key)));
    }
}

const Entry* Table::find(std::string_view key) const {
    const auto found =
        std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.key == key; });
    return found == entries_.end() ? nullptr : &*found;
}

void Table::complain(std::string_view key, const std::string& message) const {
    const Entry* const entry = find(key);
    reading_->complain(entry ? entry->place : place_, message);
}

std::string Table::what(std::string_view key) const {
    return say("'{}' of {}", escaped(key), title_);
}

void Table::entitle(const Name& name) {
    if (!name.text.empty()) title_ = labelled(title_, name.text);
}

void Table::complain_of_missing(std::initializer_list<std::string_view> keys, const std::string& message) const {
    const std::vector<Diagnostic>& told = reading_->diagnostics;
    const auto stands_for_one = [&](const Entry& entry) {
        const bool is_meant = std::any_of(keys.begin(), keys.end(), [&](std::string_view key) {
            return is_key_meant(entry.key, key) || nearest(entry.key, {std::string(key)}) == key;
        });
        return is_meant && std::any_of(told.begin(), told.end(),
                                       [&](const Diagnostic& one) { return one.place == entry.place; });
    };
    if (std::none_of(entries_.begin(), entries_.end(), stands_for_one)) reading_->complain(place_, message);
}

void Table::need(std::string_view key) const {
    if (!has(key)) complain_of_missing({key}, say("{} needs '{}'", title_, key));
}

std::string Table::text(std::string_view key) const {
    const Entry* const entry = find(key);
    if (!entry) return {};
    if (const auto* string = entry->node->as_string()) return string->get();
    reading_->complain(place_of(*entry->node), mismatch(what(key), *entry->node, say("a string")));
    return {};
}

std::optional<Literal> Table::plain_text(std::string_view key) const {
    const Entry* const entry = find(key);
    if (!entry->node->is_string())
        return reading_->complain(place_of(*entry->node), mismatch(what(key), *entry->node, say("a string"))),
               std::nullopt;
    Literal literal = read_literal(*reading_, *entry->node);
    write_plainly(literal.text, literal.places);
    return literal;
}

std::string Table::unit(std::string_view key, Place& place) const {
    const std::string typed = text(key);
    if (typed.empty()) return {};
    const Literal plain = *plain_text(key);
    place = plain.places.front();
    const UnitReading unit = read_unit(plain.text, reading_->names.units());
    if (unit.meaning) return typed;
    const std::size_t offset = std::min(static_cast<std::size_t>(unit.offset), plain.places.size() - 1);
    reading_->complain(plain.places[offset], say("{} is no unit, such as \"mm\" or \"kg*m^2\": {}",
                                                 what(key) + " = " + in_quotes(typed), unit.mistake));
    return {};
}

bool Table::flag(std::string_view key) const {
    const Entry* const entry = find(key);
    if (!entry) return false;
    if (const auto* boolean = entry->node->as_boolean()) return boolean->get();
    reading_->complain(place_of(*entry->node), mismatch(what(key), *entry->node, say("true or false")));
    return false;
}

std::optional<Name> Table::name(std::string_view key) const {
    const Entry* const entry = find(key);
    return entry ? read_name(*reading_, *entry->node, what(key)) : std::nullopt;
}

std::vector<Name> Table::names(std::string_view key) const {
    const Entry* const entry = find(key);
    return entry ? read_names(*reading_, *entry->node, what(key)) : std::vector<Name>{};
}

Expression Table::expression(std::string_view key) const {
    const Entry* const entry = find(key);
    return entry ? read_expression(*reading_, *entry->node, what(key)) : Expression{};
}

std::optional<Vector> Table::vector(std::string_view key) const {
    const Entry* const entry = find(key);
    return entry ? std::optional(read_vector(*reading_, *entry->node, what(key))) : std::nullopt;
}

Name Table::needed_name(std::string_view key) const {
    need(key);
    return name(key).value_or(Name{});
}

Expression Table::needed_expression(std::string_view key) const {
    need(key);
    return expression(key);
}

Vector Table::needed_vector(std::string_view key) const {
    need(key);
    return vector(key).value_or(Vector{{}, place_});
}

}  // namespace alembert
