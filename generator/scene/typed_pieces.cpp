// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/typed_pieces.hpp"

#include "scene/text.hpp"

namespace alembert {

TypedPieces::TypedPieces(std::string_view text) : text_(text) {
    while (at_ < text_.size()) next();
    list_.push_back({TypedPiece::Kind::end, text_.size(), text_.size()});
    match();
}

void TypedPieces::next() {
    const std::size_t begin = at_;
    const char byte = text_[at_];
    if (byte == ' ' || byte == '\t' || byte == '\n' || byte == '\r') {
        ++at_;
    } else if (has_digit(at_) || (byte == '.' && has_digit(at_ + 1))) {
        number();
        add(TypedPiece::Kind::number, begin);
    } else if (byte == '\'') {
        while (at_ < text_.size() && text_[at_] == '\'') ++at_;
        add(TypedPiece::Kind::primes, begin);
    } else if (byte == '\\') {
        ++at_;
        while (at_ < text_.size() && ((text_[at_] | 0x20) >= 'a' && (text_[at_] | 0x20) <= 'z')) ++at_;
        if (at_ == begin + 1 && at_ < text_.size()) decode(text_, at_);
        add(TypedPiece::Kind::command, begin);
    } else if (is_letter(decode(text_, at_))) {
        letters();
        add(TypedPiece::Kind::word, begin);
    } else {
        add(TypedPiece::Kind::sign, begin);
    }
}

void TypedPieces::letters() {
    for (std::size_t after = at_; at_ < text_.size(); at_ = after) {
        const char32_t c = decode(text_, after);
        if (!is_letter(c) && !is_digit(c)) return;
    }
}

void TypedPieces::number() {
    while (has_digit(at_) || (at_ < text_.size() && text_[at_] == '.')) ++at_;
    if (at_ >= text_.size() || (text_[at_] != 'e' && text_[at_] != 'E')) return;
    const bool has_sign = at_ + 1 < text_.size() && (text_[at_ + 1] == '+' || text_[at_ + 1] == '-');
    const std::size_t digits = at_ + (has_sign ? 2 : 1);
    if (!has_digit(digits)) return;
    for (at_ = digits; has_digit(at_);) ++at_;
}

void TypedPieces::match() {
    std::vector<std::size_t> open;
    for (std::size_t k = 0; k < list_.size(); ++k) {
        if (is(k, "(") || is(k, "{")) open.push_back(k);
        if (is(k, ",") && !open.empty()) list_[open.back()].commas.push_back(k);
        if ((!is(k, ")") && !is(k, "}")) || open.empty()) continue;
        list_[k].match = open.back();
        list_[open.back()].match = k;
        open.pop_back();
    }
}

}  // namespace alembert
