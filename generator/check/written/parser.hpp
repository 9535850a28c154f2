// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The tokens of one side of an equation become a tree.
///
/// As mathematicians read it:
/// - A product without signs goes on to the next sign of a sum: 2 m l \cos\theta. a/b c is (a/b) c, and 1/2 m v^2
/// is
///   (1/2) m v^2; but a number and a letter written together are one divisor: p^2/2m is p^2/(2m).
/// - A function without parentheses takes numbers, then letters up to the first that can be an angle: \sin
/// 2\theta,
///   \sin\omega t, \cos\theta_1\,\dot\theta_1 = (cos θ₁) θ̇₁. With parentheses it takes these alone.
/// - d/dt without parentheses takes the whole product that follows it.
/// - A letter before parentheses is `applied`. What is raised to a power after them is F(t) or, if it is a
/// product, the
///   parentheses: m(a+b)^2.

#include <optional>
#include <utility>

#include "check/written/tokens.hpp"

namespace alembert {

/// Why a piece of mathematics was not understood, and where. Thrown inside this room.
struct NotUnderstood {
    std::size_t offset;
    std::size_t length;
    std::string message;
};

/// For each token the one that closes or opens it; `no_partner` for others. Throws BeyondLimit if they are nested
/// too deeply.
inline constexpr std::size_t no_partner = static_cast<std::size_t>(-1);
std::vector<std::size_t> partners(const std::vector<WrittenToken>& tokens);

/// What a message calls a token: "the sign '+'".
std::string described(const WrittenToken& token);

class MathParser {
public:
    /// `has_differentials`: a `d` before a letter is a differential, as in dW = Q dq.
    MathParser(const std::vector<WrittenToken>& tokens, const std::vector<std::size_t>& partner,
               bool has_differentials);

    /// The tokens from `begin` to before `end` as one expression. Throws NotUnderstood, BeyondLimit.
    MathPtr read(std::size_t begin, std::size_t end);

private:
    using Kind = WrittenToken::Kind;
    struct Window;
    struct Depth;
    struct Differential {
        bool is_partial;
        int order;
        std::size_t after;
    };
    struct Range {
        std::size_t begin, end;
    };

    const std::vector<WrittenToken>& tokens_;
    const std::vector<std::size_t>& partner_;
    const bool has_differentials_;
    bool has_variations_ = false;
    std::size_t at_ = 0, end_ = 0;
    int depth_ = 0;
    int bars_ = 0;          // open |
    bool is_bare_ = false;  // the argument of a function without parentheses
    std::size_t steps_ = 0;

    const WrittenToken& now() const { return token(at_); }
    const WrittenToken& token(std::size_t i) const;
    Kind kind(std::size_t i) const { return i < end_ ? token(i).kind : Kind::end; }
    bool is(Kind kind) const { return at_ < end_ && now().kind == kind; }
    bool is_command(std::size_t i, std::string_view name) const {
        return kind(i) == Kind::command && token(i).text == name;
    }
    [[noreturn]] void fail(std::size_t i, std::string message) const;
    [[noreturn]] void unexpected(const std::string& expected) const;
    std::size_t closing(std::size_t i) const;
    MathPtr within(std::size_t begin, std::size_t end);
    void count_levels(Math& math) const;
    MathPtr node(Math math, std::size_t begin) const;
    MathPtr placed(Math math, const Math& first, const Math& last) const;

    // parser.cpp
    MathPtr expression();
    MathPtr term();
    MathPtr divisor(const MathPtr& numerator);
    MathPtr product(std::vector<MathPtr> factors, std::string_view sign) const;
    bool begins_factor() const;
    MathPtr factor(bool may_be_negative);
    MathPtr primary();
    bool is_at_time(const Math& rate) const;
    MathPtr after_it(MathPtr node, std::size_t begin);
    MathPtr number();
    MathPtr absolute();

    // brackets.cpp
    MathPtr bracket();
    MathPtr group();
    std::vector<MathPtr> listed(std::size_t begin, std::size_t end);
    MathPtr environment();
    MathPtr quantity(const MathPtr& value, std::size_t begin);
    std::size_t unit_end(std::size_t i, std::string& unit) const;
    bool ends_product(std::size_t i) const;

    // scripts.cpp
    MathPtr letter(Letter letter, int dots, std::size_t begin);
    MathPtr accented();
    void add_index(Letter& letter, int& dots);
    bool add_raised(Letter& letter, int& dots);
    MathPtr exponent();
    Range script_range();
    std::string flat_text(std::size_t begin, std::size_t end);
    std::optional<std::string> raised_text(const Letter& letter, std::size_t begin, std::size_t end);
    bool has_arguments(const Letter& letter) const;
    MathPtr method(std::size_t begin);

    // derivatives.cpp
    std::optional<Differential> differential(std::size_t i) const;
    std::size_t end_of_letter(std::size_t i) const;
    std::optional<std::pair<Range, std::size_t>> differential_letter(std::size_t i) const;
    bool end_of_letter_inside(std::size_t i) const;
    std::optional<std::vector<Range>> variables(std::size_t begin, std::size_t end, bool is_partial) const;
    MathPtr derivative(const Differential& what, const MathPtr& operand, const std::vector<Range>& of,
                       std::size_t begin);
    MathPtr operand_of_derivative(std::size_t begin);
    MathPtr fraction();
    MathPtr slanted_derivative();
    MathPtr derivative_command();
    MathPtr rate(const MathPtr& of, int order, std::size_t begin) const;
    MathPtr partial(const MathPtr& of, std::vector<MathPtr> variables, std::string_view sign,
                    std::size_t begin) const;
    MathPtr subscripted_partial();
    MathPtr variation();

    // functions.cpp
    MathPtr function();
    MathPtr bare_argument();
    MathPtr command();
    MathPtr root();
    MathPtr absolute_command();
    MathPtr labelled_brace();
    MathPtr big_operator();
    MathPtr algebra_call();
    MathPtr algebra_derivative(const std::vector<Range>& arguments, std::size_t begin);
    std::vector<Range> argument_ranges(std::size_t begin, std::size_t end) const;
};

/// A letter `t` without anything.
bool is_time(const Math& math);

}  // namespace alembert
