// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/file_mistakes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "base/language/say.hpp"
#include "scene/advice.hpp"
#include "scene/keys.hpp"
#include "scene/text.hpp"
#include "scene/typed_toml.hpp"

namespace alembert {

namespace {

/// The line around a place, and where it begins.
struct SourceLine {
    std::size_t begin;
    std::string_view text;
};

SourceLine line_around(std::string_view text, std::size_t offset) {
    const std::size_t begin = offset == 0 ? 0 : text.rfind('\n', offset - 1) + 1;  // npos + 1 is 0
    return {begin, text.substr(begin, std::min(text.find_first_of("\r\n", begin), text.size()) - begin)};
}

std::string_view without_blanks(std::string_view text) {
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
    return text;
}

/// A key with another sign than = behind it.
std::string about_key(const SourceLine& line, std::size_t at) {
    const std::string_view key = without_blanks(line.text.substr(0, at)), rest = line.text.substr(at);
    const std::size_t equals = rest.find('=');
    if (key.empty() || rest.empty())
        return key.empty() ? "" : say("a value is missing; write {} = …", escaped(key));
    if ((rest[0] == '[' || rest[0] == '(') && equals != std::string_view::npos) {
        const std::size_t close = rest.find_first_of("])");
        if (close == std::string_view::npos || equals < close) return {};
        return say("a unit stands beside the value; write {} = {{ value = {}, unit = \"{}\" }}", escaped(key),
                   escaped(without_blanks(rest.substr(equals + 1)), 24), escaped(rest.substr(1, close - 1), 16));
    }
    const std::string_view value =
        without_blanks(rest[0] != ':' ? rest : rest.substr(rest.starts_with(":=") ? 2 : 1));
    if (value.empty() || equals != (rest.starts_with(":=") ? 1 : std::string_view::npos)) return {};
    return say("the sign = stands between a key and its value; write {} = {}", escaped(key), escaped(value, 40));
}

/// Whether a line begins a table or gives a key its value, and is no element of an array.
bool begins_statement(std::string_view line) {
    const std::string_view text = without_blanks(line);
    if (text.empty() || text[0] == '"' || text[0] == '\'') return false;
    const std::size_t name = text.find_first_not_of("[ ");
    std::size_t i = std::min(name, text.size());
    const bool has_name = i < text.size() && is_letter(decode(text, i));
    return has_name && (text[0] == '[' || text.find('=') != std::string_view::npos);
}

/// The bracket before `offset` that is still open; nothing if there is none. Strings of one line are skipped.
std::optional<std::size_t> open_bracket(std::string_view text, std::size_t from, std::size_t offset) {
    std::vector<std::size_t> open;
    for (std::size_t k = from; k < offset; ++k) {
        if (text[k] == '"' || text[k] == '\'') {
            const char quote = text[k];
            for (++k; k < offset && text[k] != quote && text[k] != '\n'; ++k)
                if (quote == '"' && text[k] == '\\') ++k;
        } else if (text[k] == '#') {
            k = std::min(text.find('\n', k), offset);
        } else if (text[k] == '[' || text[k] == '{') {
            open.push_back(k);
        } else if ((text[k] == ']' || text[k] == '}') && !open.empty()) {
            open.pop_back();
        }
    }
    return open.empty() ? std::nullopt : std::optional(open.front());
}

/// Looks at what stands where the parser stopped.
class Stop {
public:
    Stop(const std::string& message, const Layout& layout, const SourceText& source, std::size_t offset)
        : message_(message),
          layout_(layout),
          source_(source),
          text_(source.text()),
          offset_(offset),
          line_(line_around(text_, offset)) {}

    std::optional<Diagnostic> mistake() const {
        for (const auto look : {&Stop::escape, &Stop::comment, &Stop::other_file, &Stop::doubled_sign,
                                &Stop::missing_value, &Stop::key, &Stop::bracket})
            if (auto found = (this->*look)()) return found;
        return {};
    }

private:
    const std::string& message_;
    const Layout& layout_;
    const SourceText& source_;
    const std::string_view text_;
    const std::size_t offset_;
    const SourceLine line_;

    bool says(std::string_view words) const { return message_.find(words) != std::string::npos; }
    char at(std::size_t k) const { return k < text_.size() ? text_[k] : '\n'; }
    bool ends() const { return says("end-of-file"); }

    std::optional<Diagnostic> told(std::size_t where, std::string words) const {
        if (words.empty()) return {};
        return Diagnostic{source_.place(where), std::move(words)};
    }

    std::optional<Diagnostic> escape() const {
        if (!says("unknown escape sequence") || offset_ == 0) return {};
        const std::size_t slash = at(offset_) == '\\' ? offset_ : offset_ - 1;
        const std::string_view command = word_at(text_, slash + 1);
        const std::string advice = advice_on_command(command);
        return told(slash,
                    advice.empty()
                        ? say("a backslash in \"…\" begins a sign of TOML; write \\\\, or use '…'")
                        : say("a backslash in \"…\" begins a sign of TOML; for \\{} write {}", command, advice));
    }

    std::optional<Diagnostic> comment() const {
        for (const std::string_view sign : {"//", "/*", "--", "%", ";"})
            if (without_blanks(line_.text).starts_with(sign))
                return told(line_.begin + line_.text.find(sign), say("a comment begins with #"));
        return {};
    }

    /// JSON and XML, at the beginning of the file.
    std::optional<Diagnostic> other_file() const {
        const std::size_t first = text_.find_first_not_of(" \t\r\n");
        if (first != offset_ || (at(first) != '{' && at(first) != '<')) return {};
        return told(first, at(first) == '{'
                               ? say("a scene is a TOML file, and this looks like JSON; write key = value")
                               : say("a scene is a TOML file, and this looks like XML; descriptions of robots are "
                                     "read by 'alembert import'"));
    }

    /// x == 1
    std::optional<Diagnostic> doubled_sign() const {
        if (offset_ == 0 || at(offset_) != '=' || at(offset_ - 1) != '=') return {};
        const std::string_view key = without_blanks(line_.text.substr(0, offset_ - 1 - line_.begin));
        const std::string_view value = without_blanks(line_.text.substr(offset_ + 1 - line_.begin));
        return told(offset_, say("the sign = stands between a key and its value; write {} = {}", escaped(key),
                                 escaped(value, 40)));
    }

    std::optional<Diagnostic> missing_value() const {
        const bool is_at_end = ends() && without_blanks(line_.text).ends_with('=');
        if (!is_at_end && (!says("expected value, saw") ||
                           std::string_view("\r\n#").find(at(offset_)) == std::string_view::npos))
            return {};
        return told(offset_, say("a value is missing after the sign ="));
    }

    std::optional<Diagnostic> key() const {
        if (!says("expected '=', saw")) return {};
        const std::size_t comma = text_.find_last_not_of("0123456789", offset_ == 0 ? 0 : offset_ - 1);
        if (comma != std::string_view::npos && comma > line_.begin && text_[comma] == ',') {
            const std::size_t begin = text_.find_last_not_of("0123456789+-", comma - 1) + 1;
            if (auto found = told(begin, advice_on_comma(text_.substr(begin, offset_ - begin)))) return found;
        }
        return told(offset_, about_key(line_, offset_ - line_.begin));
    }

    std::optional<Diagnostic> bracket() const {
        if (!says(" or closing '") && !ends()) return {};
        const auto after =
            std::upper_bound(layout_.statements.begin(), layout_.statements.end(), offset_,
                             [](std::size_t where, const Layout::Statement& s) { return where < s.begin; });
        if (after == layout_.statements.begin()) return {};
        const std::optional<std::size_t> open = open_bracket(text_, std::prev(after)->begin, offset_);
        if (!open) return {};
        if (ends() || (*open < line_.begin && (at(offset_) == '\n' || begins_statement(line_.text))))
            return told(*open, text_[*open] == '[' ? say("this array is not closed; a ] is missing")
                                                   : say("this table is not closed; a }} is missing"));
        return at(offset_) == ':' ? std::nullopt : told(offset_, say("a comma is missing here"));
    }
};

}  // namespace

std::optional<Diagnostic> familiar_mistake(const std::string& message, const Layout& layout,
                                           const SourceText& source, std::size_t offset) {
    return Stop(message, layout, source, offset).mistake();
}

std::optional<Diagnostic> mistake_in_header(const SourceText& source, std::size_t offset) {
    const SourceLine line = line_around(source.text(), offset);
    const std::string_view header = without_blanks(line.text.substr(0, line.text.find('#')));
    const std::size_t open = std::min(header.find_first_not_of('['), header.size());
    const std::string_view rest = header.substr(open);
    const std::string name(rest.substr(0, rest.find(']')));
    const std::size_t closed = rest.size() - name.size();
    const TableKeys* const table = std::find_if(std::begin(table_keys), std::end(table_keys),
                                                [&](const TableKeys& one) { return one.table == name; });
    if (open == 0 || open == closed || table == std::end(table_keys) ||
        rest.substr(name.size()).find_first_not_of(']') != std::string_view::npos)
        return {};
    const bool is_list = table->shape == TableKeys::Shape::list;
    return Diagnostic{source.place(line.begin + line.text.find('[')),
                      say("the brackets of this table do not fit; write {}{}{}", is_list ? "[[" : "[", name,
                          is_list ? "]]" : "]")};
}

bool has_typographic_quote(const SourceText& source, std::size_t offset) {
    const std::string_view line = line_around(source.text(), offset).text;
    for (std::size_t k = 0; k < line.size();)
        if (is_typographic_quote(decode(line, k))) return true;
    return false;
}

bool is_number_like(std::string_view text) {
    return text.find_first_of("0123456789") != std::string_view::npos &&
           text.find_first_not_of("+-.0123456789eE_") == std::string_view::npos;
}

std::string advice_on_comma(std::string_view text) {
    const std::size_t comma = text.find(',');
    if (comma == 0 || comma + 1 >= text.size() || comma == std::string_view::npos) return {};
    std::string with_point(text), whole(text);
    with_point[comma] = '.';
    whole.erase(comma, 1);
    if (!is_number_like(with_point) || !is_digit(static_cast<unsigned char>(text[comma + 1])) ||
        std::count(with_point.begin(), with_point.end(), '.') != 1)
        return {};
    const bool is_group = text.size() - comma == 4 && text.find_first_of("eE") == std::string_view::npos;
    return is_group ? say("the decimal sign is a point, and digits have no commas between them; write {} or {}",
                          with_point, whole)
                    : say("the decimal sign is a point; write {}", with_point);
}

}  // namespace alembert
