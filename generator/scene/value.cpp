// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "language/say.hpp"
#include "scene/keys.hpp"
#include "scene/text.hpp"

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

std::string mismatch(const std::string& what, const toml::node& node, std::string_view expected) {
    return say("{} is {}; expected {}", what, kind_of(node), expected);
}

}  // namespace

Place place_of(const toml::node& node) {
    const toml::source_position begin = node.source().begin;
    return {static_cast<int>(begin.line), static_cast<int>(begin.column)};
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
        Literal literal = read_literal(reading, node);
        return parse_expression(std::move(literal.text), std::move(literal.places), reading.diagnostics);
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
    const Literal literal = read_literal(reading, node);
    return parse_equality(literal.text, literal.places, reading.diagnostics, rates_before);
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
        const Literal literal = read_literal(reading, one);
        result.push_back(parse_inequality(literal.text, literal.places, reading.diagnostics));
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
    return Name{literal.text, literal.places.front()};
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

Vector read_vector(const Reading& reading, const toml::node& node, const std::string& what) {
    Vector vector;
    vector.place = place_of(node);
    const toml::array* array = node.as_array();
    if (!array) {
        reading.complain(vector.place, mismatch(what, node, say("a vector: an array of two or three components")));
        return vector;
    }
    if (array->size() < 2 || array->size() > 3) {
        reading.complain(vector.place, say("{} has {} component{}; a vector has two or three", what, array->size(),
                                           array->size() == 1 ? "" : "s"));
        return vector;
    }
    for (std::size_t i = 0; i < array->size(); ++i)
        vector.component[i] = read_expression(reading, *array->get(i), say("a component of {}", what));
    if (array->size() == 2) vector.component[2] = zero(vector.place);
    return vector;
}

Table::Table(const Reading& reading, const toml::table& table, std::string title, Place place)
    : reading_(&reading), title_(std::move(title)), place_(place) {
    for (const auto& [key, node] : table) {
        const toml::source_position begin = key.source().begin;
        entries_.push_back(
            {std::string(key.str()), {static_cast<int>(begin.line), static_cast<int>(begin.column)}, &node});
    }
    std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) { return a.place < b.place; });
}

void Table::allow(std::string_view name) const {
    const std::span<const std::string_view> known = keys_of(name);
    for (const Entry& entry : entries_) {
        if (std::find(known.begin(), known.end(), entry.key) != known.end()) continue;
        const std::string meant = nearest(entry.key, {known.begin(), known.end()});
        const std::string hint =
            meant.empty() ? say("it may have {}", fmt::join(known, ", ")) : say("did you mean '{}'?", meant);
        reading_->complain(entry.place, say("unknown key {} in {}; {}", in_quotes(entry.key), title_, hint));
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

void Table::need(std::string_view key) const {
    if (!has(key)) reading_->complain(place_, say("{} needs '{}'", title_, key));
}

std::string Table::text(std::string_view key) const {
    const Entry* const entry = find(key);
    if (!entry) return {};
    if (const auto* string = entry->node->as_string()) return string->get();
    reading_->complain(place_of(*entry->node), mismatch(what(key), *entry->node, say("a string")));
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
