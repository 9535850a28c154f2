// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/syntax.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include "base/language/libraries.hpp"
#include "base/language/say.hpp"
#include "scene/file_mistakes.hpp"
#include "scene/text.hpp"

namespace alembert {
namespace {

/// The messages of toml++ for a value that begins with no quote or bracket and is no number, date or boolean.
constexpr std::string_view of_values[] = {"could not determine value type",
                                          "expected digit",
                                          "expected decimal digit",
                                          "expected expected digit",
                                          "expected value-terminator",
                                          "expected 'true'",
                                          "expected 'false'",
                                          "expected 'nan'",
                                          "expected 'inf'",
                                          "expected month",
                                          "expected day",
                                          "expected a comment or whitespace",
                                          "leading zeroes",
                                          "expected '-'",
                                          "expected ':'",
                                          "could not be interpreted",
                                          "is not representable in 64 bits"};

/// Messages of toml++, and what is said instead.
constexpr std::pair<std::string_view, std::string_view> rewordings[] = {
    {"unescaped control characters", to_say("this string is not closed on its line")},
    {"encountered end-of-file", to_say("the file ends here, but a string, an array or a table is still open")},
    {"blank bare keys", to_say("a table needs a name between its brackets")},
    {"exceeded maximum nested value depth", to_say("arrays or tables nested too deep")},
};

struct Value {
    std::size_t begin;
    std::string_view text;
};

/// The bare word around `offset` that stands where a value should: after `=`, or between the commas of an array.
std::optional<Value> value_around(std::string_view text, std::size_t offset) {
    const std::size_t line = offset == 0 ? 0 : text.rfind('\n', offset - 1) + 1;  // npos + 1 is 0
    const std::size_t before = text.substr(line, offset - line).find_last_of("=[,{");
    if (before == std::string_view::npos) return {};
    const std::size_t begin = text.find_first_not_of(" \t", line + before + 1);
    if (begin == std::string_view::npos || begin > offset) return {};
    const bool in_array = text[line + before] != '=';
    std::size_t end = std::min(text.find_first_of(in_array ? "\r\n#,]}" : "\r\n#}", begin), text.size());
    while (end > begin && (text[end - 1] == ' ' || text[end - 1] == '\t')) --end;
    const std::string_view value = text.substr(begin, end - begin);
    const bool is_other_bracket = value.starts_with('<') || value.starts_with('(');
    if (value.empty() || (!is_other_bracket && value.find_first_of("\"'[]{}=") != std::string_view::npos))
        return {};
    return Value{begin, value};
}

/// What a value is that stands without quotes and is no number; empty if it may be an expression.
std::string known_value(std::string_view value) {
    if (const std::string number = advice_on_comma(value); !number.empty()) return number;
    if (value.starts_with("‘") || value.starts_with("’")) return say("a string stands in plain quotes: \"…\"");
    if (value.find("//") != std::string_view::npos) return say("a comment begins with #");
    if (value.ends_with(';')) return say("a line ends without a sign; leave out the semicolon");
    if (value.ends_with(',')) return say("a line ends without a sign; leave out the comma");
    for (const std::string_view word : {"True", "TRUE", "yes", "Yes", "on", "On"})
        if (value == word) return say("write true");
    for (const std::string_view word : {"False", "FALSE", "no", "No", "off", "Off"})
        if (value == word) return say("write false");
    if (value.starts_with('<') || value.starts_with('('))
        return say("the components of a vector stand between square brackets: [0, \"-g\"]");
    return {};
}

std::string about_value(std::string_view value, std::string_view message) {
    const std::string shown = escaped(value, 40);
    if (const std::string known = known_value(value); !known.empty()) return known;
    if (message.find("64 bits") != std::string_view::npos || message.find("interpreted") != std::string_view::npos)
        return say("the number {} is beyond the range of {}", shown,
                   value.find_first_of(".eE") == std::string_view::npos
                       ? say("64-bit integers; write it with a point")
                       : say("double precision"));
    if (is_number_like(value))
        return say("{} is not a number in TOML, where .5 is 0.5, 5. is 5.0 and 05 is 5", shown);
    return say("not a plain number; an expression or a name stands in quotes: \"{}\"", shown);
}

std::string without_framing(std::string message) {
    if (message.rfind("Error while parsing ", 0) == 0)
        if (const std::size_t colon = message.find(": "); colon != std::string::npos) message.erase(0, colon + 2);
    return message;
}

}  // namespace

Diagnostic syntax_mistake(const toml::parse_error& error, const Layout& layout, const SourceText& source) {
    const toml::source_position at = error.source().begin;
    const Place place{static_cast<int>(at.line), static_cast<int>(at.column)};
    const std::string message = without_framing(std::string(error.description()));
    if (message.rfind("cannot redefine existing table", 0) == 0) {
        const std::size_t first = message.find('\''), last = message.rfind('\'');
        const std::string name = first < last ? message.substr(first + 1, last - first - 1) : "";
        if (const auto header = layout.headers.find(name); header != layout.headers.end())
            return {place,
                    say("the table [{}] is given twice; first on line {}", escaped(name), header->second.line)};
    }
    const auto says = [&](std::string_view words) { return message.find(words) != std::string::npos; };
    if (auto header = mistake_in_header(source, source.offset(place))) return *std::move(header);
    if (says("unescaped control characters") && has_typographic_quote(source, source.offset(place)))
        return {place, say("this string is not closed: a typographic quote is no end of one that begins with \"")};
    if (std::any_of(std::begin(of_values), std::end(of_values), says))
        if (const auto value = value_around(source.text(), source.offset(place)))
            return {source.place(value->begin), about_value(value->text, message)};
    if (auto familiar = familiar_mistake(message, layout, source, source.offset(place)))
        return *std::move(familiar);
    for (const auto& [theirs, ours] : rewordings)
        if (says(theirs)) return {place, say("not valid TOML: {}", translated(ours))};
    return {place, say("not valid TOML: {}", escaped(translated_from_toml(message), 200))};
}

}  // namespace alembert
