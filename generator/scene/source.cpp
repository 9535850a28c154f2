// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "base/language/say.hpp"
#include "scene/text.hpp"

namespace alembert {
namespace {

constexpr std::size_t largest_scene = 1024 * 1024;

/// Reads one TOML string from its opening quotes on and appends its value byte by byte.
class StringReader {
public:
    StringReader(const SourceText& source, std::size_t begin)
        : source_(source), text_(source.text()), at_(begin) {}

    Literal read() {
        const char quote = text_[at_];
        const std::string triple(3, quote);
        const bool is_long = text_.compare(at_, 3, triple) == 0;
        at_ += is_long ? 3 : 1;
        if (is_long && at_ < text_.size() && text_[at_] == '\r') ++at_;
        if (is_long && at_ < text_.size() && text_[at_] == '\n') ++at_;
        while (at_ < text_.size() && !closes(quote, is_long)) {
            if (quote == '"' && text_[at_] == '\\')
                escape();
            else
                plain();
        }
        result_.places.push_back(source_.place(std::min(at_, text_.size())));
        return std::move(result_);
    }

private:
    const SourceText& source_;
    const std::string_view text_;
    std::size_t at_;
    Literal result_;

    /// A long string may end in up to two more quotes that belong to it.
    bool closes(char quote, bool is_long) const {
        if (text_[at_] != quote) return false;
        if (!is_long) return true;
        return text_.compare(at_, 3, std::string(3, quote)) == 0 &&
               (at_ + 3 >= text_.size() || text_[at_ + 3] != quote);
    }

    void add(std::string_view bytes, Place place) {
        result_.text += bytes;
        result_.places.insert(result_.places.end(), bytes.size(), place);
    }

    void plain() {
        const std::size_t begin = at_;
        if (text_[at_] == '\r') ++at_;  // every line end becomes a single \n
        const std::size_t from = at_;
        if (at_ < text_.size()) decode(text_, at_);
        add(text_.substr(from, at_ - from), source_.place(begin));
    }

    void escape() {
        const Place place = source_.place(at_);
        const char kind = ++at_ < text_.size() ? text_[at_++] : '\\';
        switch (kind) {
            case 'b':
                return add("\b", place);
            case 't':
                return add("\t", place);
            case 'n':
                return add("\n", place);
            case 'f':
                return add("\f", place);
            case 'r':
                return add("\r", place);
            case 'e':
                return add("\x1B", place);
            case 'x':
                return add(encode(hexadecimal(2)), place);
            case 'u':
                return add(encode(hexadecimal(4)), place);
            case 'U':
                return add(encode(hexadecimal(8)), place);
            case ' ':
            case '\t':
            case '\r':
            case '\n':
                while (at_ < text_.size() &&
                       std::string_view(" \t\r\n").find(text_[at_]) != std::string_view::npos)
                    ++at_;
                return;
            default:
                return add(std::string_view(&kind, 1), place);
        }
    }

    char32_t hexadecimal(int digits) {
        char32_t value = 0;
        for (; digits > 0 && at_ < text_.size(); --digits, ++at_) {
            const char c = text_[at_];
            value = value * 16 + static_cast<char32_t>(c <= '9' ? c - '0' : (c | 0x20) - 'a' + 10);
        }
        return value;
    }
};

}  // namespace

SourceText::SourceText(std::string_view text) : text_(text), lines_{0} {
    characters_.reserve(text.size() + 1);
    for (std::size_t i = 0; i < text.size();) {
        characters_.push_back(i);
        if (decode(text, i) == U'\n') lines_.push_back(characters_.size());
    }
    characters_.push_back(text.size());
}

std::size_t SourceText::offset(Place place) const {
    const auto line = static_cast<std::size_t>(std::max(place.line, 1)) - 1;
    if (line >= lines_.size()) return text_.size();
    const std::size_t character = lines_[line] + static_cast<std::size_t>(std::max(place.column, 1)) - 1;
    return characters_[std::min(character, characters_.size() - 1)];
}

Place SourceText::place(std::size_t offset) const {
    const auto after = std::upper_bound(characters_.begin(), characters_.end(), offset);
    const auto character = static_cast<std::size_t>(std::prev(after) - characters_.begin());
    const auto line = std::prev(std::upper_bound(lines_.begin(), lines_.end(), character));
    return {static_cast<int>(line - lines_.begin()) + 1, static_cast<int>(character - *line) + 1};
}

Literal read_string(const SourceText& source, std::size_t begin) {
    return StringReader(source, begin).read();
}

std::vector<Diagnostic> check_bytes(std::string_view text) {
    std::vector<Diagnostic> found;
    if (text.size() > largest_scene) {
        found.push_back({{}, say("the scene has {} bytes; the limit is {} (1 MiB)", text.size(), largest_scene)});
        return found;
    }
    bool has_invalid = false, has_control = false, has_return = false;
    Place place{1, 1};
    const auto tell = [&](bool& told, std::string message) {
        if (!told) found.push_back({place, std::move(message)});
        told = true;
    };
    for (std::size_t i = 0; i < text.size();) {
        const auto byte = static_cast<unsigned char>(text[i]);
        const char32_t c = decode(text, i);
        if (c == invalid_character)
            tell(has_invalid, say("the byte 0x{:02X} is not UTF-8 here; save the file as UTF-8", byte));
        else if (c == U'\r' && (i >= text.size() || text[i] != '\n'))
            tell(has_return, say("a carriage return without a line feed; end lines with LF or CR LF"));
        else if ((c < 0x20 && c != U'\n' && c != U'\t' && c != U'\r') || c == 0x7F)
            tell(has_control, say("the control character 0x{:02X} is not allowed in a scene", byte));
        place = c == U'\n' ? Place{place.line + 1, 1} : Place{place.line, place.column + 1};
    }
    return found;
}

}  // namespace alembert
