// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Makes tokens (check/written/tokens.hpp).

#include "check/written/commands.hpp"
#include "check/written/tokens.hpp"

namespace alembert {

/// Reads one text; what characters and macros stand for is read by another lexer that writes to the same list.
class WrittenLexer {
public:
    using Kind = WrittenToken::Kind;

    /// The tokens have the places of their bytes, counted from `offset`.
    WrittenLexer(std::string_view text, std::size_t offset, WrittenNotation notation, TokenContext& context,
                 std::vector<WrittenToken>& list);
    void run();

private:
    std::string_view text_;
    std::size_t offset_;
    WrittenNotation notation_;
    TokenContext& context_;
    std::vector<WrittenToken>& list_;
    std::size_t at_ = 0;
    int replaced_ = 0;       // how many replacements stand in each other
    int expansion_ = 0;      // how many macros stand in each other
    bool is_fixed_ = false;  // all tokens have the place of what was replaced
    std::size_t fixed_length_ = 0;
    bool is_tight_ = false;
    std::size_t one_digit_ = 0;  // how many numbers of one digit may come: \frac12

    char byte(std::size_t i) const { return i < text_.size() ? text_[i] : '\0'; }
    bool has_digit(std::size_t i) const { return byte(i) >= '0' && byte(i) <= '9'; }
    bool is_plain() const { return notation_ == WrittenNotation::plain; }
    std::size_t place(std::size_t i) const { return is_fixed_ ? offset_ : offset_ + i; }

    void next();
    WrittenToken& add(Kind kind, std::size_t begin, std::string_view text = {});
    void replace(const std::string& latex, std::size_t begin, WrittenNotation notation = WrittenNotation::latex);
    bool skip_space();
    void number();
    void primes();
    bool sign();
    bool old_upright(std::size_t begin);
    bool doubled_sign(std::size_t begin);
    void character();
    void scripts(char (*plain)(char32_t), std::string_view mark);
    std::string marks(std::string letter);
    void word();
    bool bare_function();
    bool abbreviated_energy();
    bool spelled_variation(std::size_t begin);
    void split_function(std::size_t begin);
    bool plain_word(std::size_t begin, const std::string& word);
    void delimiter(std::string_view which, std::size_t begin);
    void command();
    void named(const WrittenCommand& command, std::size_t begin);
    void upright(std::size_t begin);
    bool is_siunitx() const;
    void quantity(std::size_t begin, std::string_view name);
    void environment(bool begins, std::size_t begin);
    void expand(const WrittenMacro& macro, std::string_view name, std::size_t begin);
    std::string_view argument();
    void bracket_argument();
};

/// Takes \newcommand{\name}[n]{body} in, that begins at `at` in the text; moves `at` past it. False if it is of
/// another form.
bool take_in_macro(std::string_view text, std::size_t& at, TokenContext& context);

/// The end of the group that begins with { at `begin`: one past its }, or npos. Linear in what it passes over.
std::size_t end_of_group(std::string_view text, std::size_t begin);

/// The unit of siunitx in plain words: "m/s^2" for \metre\per\second\squared.
std::string plain_unit(std::string_view unit);

}  // namespace alembert
