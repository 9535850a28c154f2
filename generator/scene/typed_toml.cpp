// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/typed_toml.hpp"

#include <algorithm>

#include "scene/text.hpp"

namespace alembert {

namespace {

/// A character that stands for a sign of TOML; 0 if it is none.
char plain_sign(char32_t c) {
    if (c >= U'！' && c <= U'～') return static_cast<char>(c - 0xFEE0);
    switch (c) {
        case U'、':
            return ',';
        case U'【':
        case U'〔':
            return '[';
        case U'】':
        case U'〕':
            return ']';
        case U'−':
        case U'–':
        case U'—':
            return '-';
        case U'\u00A0':
        case U'\u2009':
        case U'\u202F':
        case U'\u200B':
        case U'\u3000':
        case U'\uFEFF':
            return ' ';
        default:
            return 0;
    }
}

class PlainToml {
public:
    explicit PlainToml(std::string_view text) : text_(text) {}

    std::string text() {
        if (std::all_of(text_.begin(), text_.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; }))
            return std::string(text_);
        while (at_ < text_.size()) next();
        return std::move(plain_);
    }

private:
    std::string_view text_;
    std::size_t at_ = 0;
    std::string plain_;

    void keep_until(std::size_t end) {
        end = std::min(end, text_.size());
        plain_ += text_.substr(at_, end - at_);
        at_ = end;
    }

    void next() {
        const char byte = text_[at_];
        if (byte == '#') return keep_until(text_.find('\n', at_));
        if (byte == '"' || byte == '\'') return keep_until(end_of_string(byte));
        const std::size_t begin = at_;
        const char32_t c = decode(text_, at_);
        if (is_typographic_quote(c)) return quoted(begin);
        const char sign = plain_sign(c);
        if (sign == '#') {
            plain_ += sign;
            return keep_until(text_.find('\n', at_));
        }
        plain_ += sign != 0 ? std::string_view(&sign, 1) : text_.substr(begin, at_ - begin);
    }

    /// One past the string that begins here; that of one line ends with the line at the latest.
    std::size_t end_of_string(char quote) const {
        const std::string triple(3, quote);
        const bool is_long = text_.compare(at_, 3, triple) == 0;
        std::size_t k = at_ + (is_long ? 3 : 1);
        for (; k < text_.size() && (is_long || text_[k] != '\n'); ++k) {
            if (quote == '"' && text_[k] == '\\') {
                ++k;
            } else if (is_long ? text_.compare(k, 3, triple) == 0 : text_[k] == quote) {
                for (k += is_long ? 3 : 1; is_long && k < text_.size() && text_[k] == quote;) ++k;
                return k;
            }
        }
        return k;
    }

    /// A string in typographic quotes, on one line; its end may be any of them, or a plain one.
    void quoted(std::size_t begin) {
        std::size_t end = at_;
        for (std::size_t k = at_; k < text_.size() && text_[k] != '\n';) {
            end = k;
            const char32_t c = decode(text_, k);
            if (c != U'"' && !is_typographic_quote(c)) continue;
            plain_ += '"';
            keep_until(end);
            plain_ += '"';
            at_ = k;
            return;
        }
        plain_ += text_.substr(begin, at_ - begin);
    }
};

}  // namespace

bool is_typographic_quote(char32_t c) {
    return c == U'“' || c == U'”' || c == U'„' || c == U'‟' || c == U'«' || c == U'»' || c == U'「' ||
           c == U'」' || c == U'『' || c == U'』' || c == U'＂' || c == U'〝' || c == U'〞';
}

std::string with_plain_signs(std::string_view text) {
    return PlainToml(text).text();
}

}  // namespace alembert
