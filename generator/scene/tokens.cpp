// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/tokens.hpp"

#include <fmt/format.h>

#include <charconv>
#include <string_view>
#include <utility>

#include "base/language/say.hpp"
#include "scene/text.hpp"

namespace alembert {
namespace {

constexpr int most_digits = 400;

/// What to write instead of a character that looks right but is not part of the language. (What is certain is
/// read: scene/typed.hpp.)
std::string replacement(char32_t c) {
    switch (c) {
        case U'”':
        case U'“':
        case U'"':
            return say("use '' for a second derivative");
        case U'√':
            return say("use sqrt(…)");
        case U'∞':
            return say("numbers are finite");
        case U'[':
        case U']':
        case U'{':
        case U'}':
            return say("use parentheses");
        case U'<':
        case U'>':
        case U'≤':
        case U'≥':
        case U'≠':
            return say("comparisons are not part of the language");
        case U'.':
            return say("a rate is written with a prime, x', and a decimal point stands between digits");
        case U';':
            return say("an expression stands alone; arguments are separated by commas");
        case U':':
            return say("a quotient is written with /");
        case U'|':
            return say("use abs(…)");
        case U'\\':
            return say("write functions and Greek letters without a backslash");
        case U'&':
        case U'$':
        case U'@':
            return say("use names, numbers and + - * / ^");
        case U'%':
            return say("there are no remainders; a percentage is a number with %, as in 5 %");
        case U'!':
            return say("there are no factorials");
        default:
            return {};
    }
}

class Lexer {
public:
    explicit Lexer(const std::string& text) : text_(text) {}

    std::vector<Token> tokens() {
        for (skip_space(); at_ < text_.size(); skip_space()) next();
        list_.push_back({Token::Kind::end, static_cast<int>(text_.size()), 0});
        return std::move(list_);
    }

private:
    const std::string& text_;
    std::size_t at_ = 0;
    std::vector<Token> list_;

    bool digit(std::size_t i) const { return i < text_.size() && text_[i] >= '0' && text_[i] <= '9'; }

    void skip_space() {
        while (at_ < text_.size() && std::string_view(" \t\r\n").find(text_[at_]) != std::string_view::npos) ++at_;
    }

    void add(Token::Kind kind, std::size_t begin, char symbol = 0) {
        list_.push_back({kind, static_cast<int>(begin), static_cast<int>(at_ - begin), symbol});
    }

    void next() {
        const std::size_t begin = at_;
        const char byte = text_[at_];
        if (digit(at_) || (byte == '.' && digit(at_ + 1))) return number();
        if (byte == '\'') {
            while (at_ < text_.size() && text_[at_] == '\'') ++at_;
            return add(Token::Kind::primes, begin);
        }
        if (text_.compare(at_, 2, "==") == 0)
            fail(begin, say("'==' is not part of the language; an equation has one ="));
        if (std::string_view("+-*/^(),=").find(byte) != std::string_view::npos) {
            ++at_;
            return add(Token::Kind::symbol, begin, byte);
        }
        const char32_t c = decode(text_, at_);
        if (c == U'°' || (c == U'%' && is_percentage())) return add(Token::Kind::name, begin);  // units
        if (!is_letter(c)) stray(begin, c);
        while (at_ < text_.size()) {
            std::size_t after = at_;
            const char32_t following = decode(text_, after);
            if (!is_letter(following) && !is_digit(following)) break;
            at_ = after;
        }
        add(Token::Kind::name, begin);
    }

    /// Whether the % before `at_` stands right after a number, and is no remainder: nothing follows that it
    /// divides.
    bool is_percentage() const {
        if (list_.empty() || list_.back().kind != Token::Kind::number) return false;
        std::size_t next = std::min(text_.find_first_not_of(" \t\r\n", at_), text_.size());
        if (next == text_.size()) return true;
        const char32_t c = decode(text_, next);
        return !is_letter(c) && !is_digit(c) && c != U'(';
    }

    void number() {
        const std::size_t begin = at_;
        while (digit(at_)) ++at_;
        if (at_ < text_.size() && text_[at_] == '.')
            for (++at_; digit(at_);) ++at_;
        if (static_cast<int>(at_ - begin) > most_digits)
            fail(begin, say("a number of more than {} digits", most_digits));
        if (at_ < text_.size() && (text_[at_] == 'e' || text_[at_] == 'E')) {
            const bool has_sign = at_ + 1 < text_.size() && (text_[at_ + 1] == '+' || text_[at_ + 1] == '-');
            const std::size_t digits = at_ + (has_sign ? 2 : 1);
            if (digit(digits))
                for (at_ = digits; digit(at_);) ++at_;
        }
        check_range(begin);
        if (at_ < text_.size() && (text_[at_] == '.' || (text_[at_] == '_' && digit(at_ + 1))))
            fail(begin, text_[at_] == '_'
                            ? say("digits are written together, without _, in an expression")
                            : say("{} is not a number", in_quotes(text_.substr(begin, number_like(begin)))));
        add(Token::Kind::number, begin);
    }

    std::size_t number_like(std::size_t begin) const {
        const std::size_t end = text_.find_first_not_of("0123456789.", begin);
        return (end == std::string::npos ? text_.size() : end) - begin;
    }

    /// A literal stands for an exact rational. Its value must also fit into a double, and no power of ten may be
    /// so large that its digits fill the memory.
    void check_range(std::size_t begin) const {
        const char* const end = text_.data() + at_;
        double value = 0;
        const auto result = std::from_chars(text_.data() + begin, end, value);
        const std::size_t e = text_.find_first_of("eE", begin);
        int exponent = 0;
        bool small = true;
        if (e < at_) {
            const char* const first = text_.data() + e + (text_[e + 1] == '+' ? 2 : 1);
            small =
                std::from_chars(first, end, exponent).ec == std::errc{} && std::abs(exponent) <= 2 * most_digits;
        }
        if (result.ec != std::errc{} || !small)
            fail(begin, say("the number {} is beyond the range of double precision",
                            escaped(text_.substr(begin, at_ - begin), 40)));
    }

    [[noreturn]] void stray(std::size_t begin, char32_t c) const {
        const std::string hint = replacement(c);
        std::string message = in_quotes(text_.substr(begin, at_ - begin));
        if (is_disturbing(c) || c >= 0x80) message += fmt::format(" (U+{:04X})", static_cast<unsigned>(c));
        message += say(" is not part of the expression language");
        if (!hint.empty()) message += fmt::format("; {}", hint);
        fail(begin, message);
    }

    [[noreturn]] static void fail(std::size_t offset, std::string message) {
        throw Mistake{static_cast<int>(offset), std::move(message)};
    }
};

}  // namespace

std::vector<Token> tokenize(const std::string& text) {
    return Lexer(text).tokens();
}

}  // namespace alembert
