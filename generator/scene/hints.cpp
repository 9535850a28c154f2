// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/hints.hpp"

#include <fmt/format.h>

#include <utility>

#include "base/language/say.hpp"
#include "scene/scene.hpp"
#include "scene/text.hpp"
#include "scene/unit_words.hpp"

namespace alembert {
namespace {

constexpr const char* about_commas =
    to_say("a comma stands only between the arguments of a function; the decimal sign is a point");
constexpr const char* about_primes = to_say("a prime stands right after a name or a parenthesis: x' or (…)'");

/// The text of the parenthesis that begins here; `(…)` if it is long or never closed.
std::string argument_text(const Words& words) {
    const int begin = words.now().offset;
    int open = 0;
    for (std::size_t k = words.at; k < words.tokens.size(); ++k) {
        const Token& token = words.tokens[k];
        open += Words::is(token, '(') - Words::is(token, ')');
        const int length = token.offset + token.length - begin;
        if (length > 24) break;
        if (open == 0) return escaped(words.text.substr(begin, length));
    }
    return "(…)";
}

/// The numbers in a call of diff are orders of derivatives or positions of arguments.
void check_derivative(const std::vector<TreePtr>& args) {
    for (std::size_t k = 1; k < args.size(); ++k) {
        const Tree& arg = *args[k];
        const bool is_whole = arg.text.size() == 1 && arg.text[0] >= '1' && arg.text[0] <= '9';
        if (arg.kind == Tree::Kind::number && !is_whole)
            stop(arg.offset,
                 say("diff takes whole numbers from 1 to 9: how often, or by which argument, is differentiated"));
    }
}

}  // namespace

void stop(int offset, std::string message) {
    throw Mistake{offset, std::move(message)};
}

void refuse_power_of_function(Words words, const Token& name) {
    ++words.at;
    const bool minus = words.at_symbol('-');
    if (minus) ++words.at;
    const std::string exponent =
        words.at_end() ? "2" : fmt::format("{}{}", minus ? "-" : "", words.word(words.now()));
    if (!words.at_end()) ++words.at;
    stop(name.offset, say("a power of a function is written after its argument: {}{}^{}", words.word(name),
                          words.at_symbol('(') ? argument_text(words) : "(…)", escaped(exponent, 20)));
}

void refuse_neighbour(const Words& words, int begin) {
    const Token& next = words.now();
    if (next.kind == Token::Kind::primes) stop(next.offset, translated(about_primes));
    const bool is_open = Words::is(next, '(');
    if (next.kind != Token::Kind::number && next.kind != Token::Kind::name && !is_open) return;
    std::string left = words.text.substr(begin, words.end() - begin);
    if (left.size() > 24) left = words.word(words.last());
    const std::string right = is_open ? argument_text(words) : words.word(next);
    const bool is_primed = is_open && words.last().kind == Token::Kind::primes;
    stop(next.offset,
         say("an operator is missing here; if a product was meant write {}*{}{}", escaped(left), escaped(right),
             is_primed ? say("; the derivative of a function of [functions] is diff(f(x), x)") : ""));
}

void refuse_unknown_unit(const Words& words, int begin) {
    const std::string word = words.word(words.now());
    const std::string before = words.text.substr(begin, words.end() - begin);
    const std::string known = unit_word(word).meant, near = known.empty() ? nearest_unit(word) : known;
    if (near.empty() && words.now().offset == words.end()) refuse_neighbour(words, begin);  // 2x
    stop(words.now().offset,
         say("'{0}' is neither a known unit nor a name of the scene{1}; if a product was meant write {2}*{0}",
             escaped(word), near.empty() ? "" : say("; did you mean {}?", near), escaped(before, 24)));
}

void refuse_second_number(const Words& words, int begin) {
    stop(words.now().offset, say("a quantity is one number with its unit; the sum of two is written {} + {}",
                                 escaped(words.text.substr(begin, words.end() - begin), 24),
                                 escaped(words.text.substr(words.now().offset), 24)));
}

void refuse_missing_operand(const Words& words) {
    const Token& now = words.now();
    if (words.at_end() && words.at > 0)
        stop(words.last().offset, say("nothing follows {}", in_quotes(words.word(words.last()))));
    if (words.at_symbol(')') || words.at_symbol('=') || words.at_symbol(',')) {
        if (words.at == 0 || Words::is(words.last(), ')')) refuse_word(words);
        stop(now.offset, say("an operand is missing between {} and {}", in_quotes(words.word(words.last())),
                             in_quotes(words.word(now))));
    }
    if (now.kind == Token::Kind::primes) stop(now.offset, translated(about_primes));
    stop(now.offset, say("an operand is missing before {}", in_quotes(words.word(now))));
}

void refuse_word(const Words& words) {
    const Token& now = words.now();
    if (words.at_symbol(')')) stop(now.offset, say("this parenthesis closes nothing: none is open here"));
    if (words.at_symbol('='))
        stop(now.offset, say("'=' is not part of an expression; only a claim is an equation"));
    if (words.at_symbol(',')) stop(now.offset, translated(about_commas));
    stop(now.offset, say("{} is not expected here", in_quotes(words.word(now))));
}

void check_arguments(const Function& function, const std::vector<TreePtr>& args, int begin) {
    const int count = static_cast<int>(args.size());
    if (count < function.least || count > function.most) {
        const bool is_open = function.most > 2, is_one = function.least == 1 && function.most == 1;
        const std::string expected =
            is_open || function.least == function.most
                ? fmt::format("{}{}", is_open ? say("at least ") : std::string(), function.least)
                : say("{} or {}", function.least, function.most);
        stop(begin, say("'{}' takes {} argument{}, not {}: {}", function.name, expected, is_one ? "" : "s", count,
                        function.usage));
    }
    if (function.takes == Function::Takes::derivative) check_derivative(args);
    if (function.takes != Function::Takes::points && function.takes != Function::Takes::frames) return;
    const std::string expected = function.takes == Function::Takes::points ? say("point") : say("frame or body");
    for (const TreePtr& arg : args)
        if (arg->kind != Tree::Kind::name || arg->primes > 0)
            stop(arg->offset, say("'{}' takes the name of a {}: {}", function.name, expected, function.usage));
}

}  // namespace alembert
