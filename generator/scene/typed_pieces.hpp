// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The pieces of a text as people type formulas: words, numbers, primes, commands of LaTeX and signs. Unlike the
/// tokens of an expression (tokens.hpp) they are of any language, and nothing is a mistake.
///
///     const TypedPieces pieces("\\dot{x} + 2");
///     pieces.word(1);          // "{"
///     pieces[1].match;         // 3: the piece of the bracket that closes it

#include <algorithm>
#include <string_view>
#include <vector>

namespace alembert {

struct TypedPiece {
    enum class Kind { word, number, primes, command, sign, end };
    Kind kind;
    std::size_t begin, end;
    std::size_t match = 0;                 ///< of a bracket: the piece of the other one; 0 if there is none
    std::vector<std::size_t> commas = {};  ///< of an opening bracket: those directly inside
};

/// The pieces of a text, the brackets with their partners; the last is the end.
class TypedPieces {
public:
    /// The text must outlive them.
    explicit TypedPieces(std::string_view text);

    std::size_t size() const { return list_.size(); }
    const TypedPiece& operator[](std::size_t k) const { return list_[std::min(k, list_.size() - 1)]; }
    std::string_view word(std::size_t k) const {
        return text_.substr((*this)[k].begin, (*this)[k].end - (*this)[k].begin);
    }
    bool is(std::size_t k, std::string_view word) const { return this->word(k) == word; }
    bool is_word(std::size_t k) const { return (*this)[k].kind == TypedPiece::Kind::word; }
    /// An opening bracket that is closed.
    bool opens(std::size_t k, std::string_view bracket) const { return is(k, bracket) && (*this)[k].match > k; }

private:
    void add(TypedPiece::Kind kind, std::size_t begin) { list_.push_back({kind, begin, at_}); }
    bool has_digit(std::size_t i) const { return i < text_.size() && text_[i] >= '0' && text_[i] <= '9'; }
    void next();
    void letters();
    void number();
    void match();

    std::string_view text_;
    std::size_t at_ = 0;
    std::vector<TypedPiece> list_;
};

}  // namespace alembert
