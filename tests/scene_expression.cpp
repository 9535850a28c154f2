// SPDX-License-Identifier: GPL-2.0-or-later
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <random>

#include "scene/expression.hpp"

namespace scene_expression {

using namespace alembert;

namespace {

/// The tree as an s-expression, which shows the precedence unambiguously.
std::string shape(const Tree& tree) {
    const auto list = [&](const std::string& head) {
        std::string text = head;
        for (const TreePtr& arg : tree.args) text.append(" ").append(shape(*arg));
        return fmt::format("({})", text);
    };
    const std::string primes(static_cast<std::size_t>(tree.primes), '\'');
    switch (tree.kind) {
        case Tree::Kind::number:
            return tree.text;
        case Tree::Kind::name:
            return tree.text + primes;
        case Tree::Kind::call:
            return list(tree.text);
        case Tree::Kind::sum:
            return list("+");
        case Tree::Kind::product:
            return list("*");
        case Tree::Kind::negate:
            return list("-");
        case Tree::Kind::reciprocal:
            return list("/");
        case Tree::Kind::power:
            return list("^");
        case Tree::Kind::derivative:
            return list("d" + primes);
    }
    return "?";
}

std::string read(const std::string& text) {
    std::vector<Diagnostic> diagnostics;
    const Expression e = parse_expression(text, {}, diagnostics);
    return e ? shape(*e.tree) : diagnostics.at(0).message;
}

/// The message, followed by its column.
std::string mistake(const std::string& text) {
    std::vector<Place> places;
    for (int i = 0; i <= static_cast<int>(text.size()); ++i) places.push_back({1, i + 1});
    std::vector<Diagnostic> diagnostics;
    const Expression e = parse_expression(text, places, diagnostics);
    if (e) return "no mistake: " + shape(*e.tree);
    return std::to_string(diagnostics.at(0).place.column) + ": " + diagnostics.at(0).message;
}

std::string repeat(const std::string& text, int times) {
    std::string result;
    for (int i = 0; i < times; ++i) result += text;
    return result;
}

}  // namespace

TEST_CASE("expression: precedence is that of written mathematics") {
    CHECK(read("-x^2") == "(- (^ x 2))");
    CHECK(read("a^b^c") == "(^ a (^ b c))");
    CHECK(read("a^-b") == "(^ a (- b))");
    CHECK(read("a^-b^c") == "(^ a (- (^ b c)))");
    CHECK(read("2*-x") == "(* 2 (- x))");
    CHECK(read("a-b-c") == "(+ a (- b) (- c))");
    CHECK(read("a/b*c/d") == "(* a (/ b) c (/ d))");
    CHECK(read("-a*b") == "(* (- a) b)");
    CHECK(read("a - -b") == "(+ a (- (- b)))");
    CHECK(read("+a") == "a");
    CHECK(read("(a+b)*c") == "(* (+ a b) c)");
    CHECK(read(" ( ( x ) ) ") == "x");
    CHECK(read("sin(x)^2") == "(^ (sin x) 2)");
    CHECK(read("x'^2") == "(^ x' 2)");
}

TEST_CASE("expression: numbers are kept as typed") {
    for (const char* number :
         {"2", ".5", "2e3", "2.", "1.50", "2E-3", "2.e+03", "0.1", "1e308", "123456789012345678901234567890"})
        CHECK(read(number) == number);
    CHECK(read("2*e") == "(* 2 e)");
}

TEST_CASE("expression: names are letters of any script") {
    for (const char* name :
         {"x", "_", "theta1", "θ", "θ1_β", "ускорение", "角度", "I", "E", "lambda", "new", "double", "int"})
        CHECK(read(name) == name);
    CHECK(read("θ''*μ'") == "(* θ'' μ')");
}

TEST_CASE("expression: primes differentiate names and parentheses") {
    CHECK(read("x''") == "x''");
    CHECK(read("(x*y)'") == "(d' (* x y))");
    CHECK(read("(x)''^2") == "(^ (d'' x) 2)");
    CHECK(read("(sin(x))'") == "(d' (sin x))");
}

TEST_CASE("expression: functions check their arguments") {
    CHECK(read("atan2(y, x)") == "(atan2 y x)");
    CHECK(read("min(a,b,c)") == "(min a b c)");
    CHECK(read("dot(vel(P), ex(A))") == "(dot (vel P) (ex A))");
    CHECK(read("norm(pos(P,Q) + 2*cross(omega(B), pos(P)))") ==
          "(norm (+ (pos P Q) (* 2 (cross (omega B) (pos P)))))");
    CHECK(mistake("sin()") == "1: 'sin' takes 1 argument, not 0: sin(x)");
    CHECK(mistake("sin(x, y)") == "1: 'sin' takes 1 argument, not 2: sin(x)");
    CHECK(mistake("atan2(x)") == "1: 'atan2' takes 2 arguments, not 1: atan2(y, x)");
    CHECK(mistake("max(x)") == "1: 'max' takes at least 2 arguments, not 1: max(x, y)");
    CHECK(mistake("norm(pos(P,Q,R))") == "6: 'pos' takes 1 or 2 arguments, not 3: pos(P) or pos(P, Q)");
    CHECK(mistake("norm(pos(x+1))") == "10: 'pos' takes the name of a point: pos(P) or pos(P, Q)");
    CHECK(mistake("norm(vel(P'))") == "10: 'vel' takes the name of a point: vel(P)");
    CHECK(mistake("norm(ex(2))") == "9: 'ex' takes the name of a frame or body: ex(B)");
}

TEST_CASE("expression: nearly right text gets a hint") {
    CHECK(mistake("1 + sin^2(x)") == "5: a power of a function is written after its argument: sin(x)^2");
    CHECK(mistake("2x") == "2: an operator is missing here; if a product was meant write 2*x");
    CHECK(mistake("2(x+1)") == "2: an operator is missing here; if a product was meant write 2*(x+1)");
    CHECK(mistake("x y") == "3: an operator is missing here; if a product was meant write x*y");
    CHECK(mistake("(a+b)(c)") == "6: an operator is missing here; if a product was meant write (a+b)*(c)");
    CHECK(mistake("x'(y)") ==
          "3: an operator is missing here; if a product was meant write x'*(y); the derivative of a function of "
          "[functions] is diff(f(x), x)");
    CHECK(mistake("diff(V(r), r, 0)") ==
          "15: diff takes whole numbers from 1 to 9: how often, or by which argument, is differentiated");
    CHECK(mistake("sin x") == "1: 'sin' needs its argument in parentheses: sin(x)");
    CHECK(mistake("2*sin") == "3: 'sin' needs its argument in parentheses: sin(x)");
    CHECK(mistake("sin'(x)") == "4: a function has no prime; differentiate what it gives: (sin(x))'");
    CHECK(mistake("sin(x)'") == "7: a function's value is differentiated in parentheses of its own: (sin(x))'");
    CHECK(mistake("x == 2") == "3: '==' is not part of the language; an equation has one =");
    CHECK(mistake("x = 2") == "3: '=' is not part of an expression; only a claim is an equation");
    CHECK(mistake("[x]") == "1: '[' is not part of the expression language; use parentheses");
    CHECK(mistake("x; y") ==
          "2: ';' is not part of the expression language; an expression stands alone; arguments "
          "are separated by commas");
    CHECK(mistake("0,5") ==
          "2: a comma stands only between the arguments of a function; the decimal sign is a point");
    CHECK(mistake("2'") == "2: a number has no derivative");
    CHECK(mistake("x''''") ==
          "2: at most three primes: third derivatives are the highest, and stand in claims alone");
    CHECK(mistake("'x") == "1: a prime stands right after a name or a parenthesis: x' or (…)'");
    CHECK(mistake("1.2.3") == "1: '1.2.3' is not a number");
    CHECK(mistake("1_000") == "1: digits are written together, without _, in an expression");
}

TEST_CASE("expression: what is typed otherwise is read where its meaning is certain") {
    CHECK(read("a·b × c⋅d") == "(* a b c d)");
    CHECK(read("a − b – c") == "(+ a (- b) (- c))");
    CHECK(read("x÷y") == "(* x (/ y))");
    CHECK(read("x**2 + y²") == "(+ (^ x 2) (^ y 2))");
    CHECK(read("x⁻² + y¹⁰") == "(+ (^ x (- 2)) (^ y 10))");
    CHECK(read("θ\u0308 + x′ + y″") == "(+ θ'' x' y'')");
    CHECK(read("½*m*v²") == "(* (* 1 (/ 2)) m (^ v 2))");
    CHECK(read("√(x₁ + 2)") == "(sqrt (+ x1 2))");
    CHECK(read("（ａ＋ｂ）＊２") == "(* (+ a b) 2)");
    CHECK(read("sin（x，y") == mistake("sin(x,y").substr(mistake("sin(x,y").find(' ') + 1));
    CHECK(mistake("x·*y") == "4: an operand is missing before '*'");
    CHECK(mistake("x ≤ 1").find("comparisons") != std::string::npos);
    std::vector<Diagnostic> none;
    CHECK(parse_equality("x″ ＝ −g", {}, none).rhs.text == " -g");
    CHECK(parse_inequality("λ·x ＞ 0", {}, none).greater.text == "λ*x ");
}

TEST_CASE("expression: incomplete text is reported with its place") {
    CHECK(mistake("") == "1: the expression is empty");
    CHECK(mistake("  ") == "1: the expression is empty");
    CHECK(mistake("x +") == "3: nothing follows '+'");
    CHECK(mistake("* x") == "1: an operand is missing before '*'");
    CHECK(mistake("x * / y") == "5: an operand is missing before '/'");
    CHECK(mistake("(x + )") == "6: an operand is missing between '+' and ')'");
    CHECK(mistake("a*(x + (y)") == "3: this parenthesis is never closed");
    CHECK(mistake("sin(x") == "4: this parenthesis is never closed");
    CHECK(mistake("x)") == "2: this parenthesis closes nothing: none is open here");
    CHECK(mistake("()") == "1: there is nothing in these parentheses");
}

TEST_CASE("expression: limits hold, and each has its message") {
    CHECK(mistake("9^9^9") == "3: the exponent 387420489 is beyond the limit of 64");
    CHECK(mistake("(1+x)^100000") == "7: the exponent 100000 is beyond the limit of 64");
    CHECK(mistake("x^-(65)") == "3: the exponent -65 is beyond the limit of 64");
    CHECK(mistake("x^1e3") == "3: the exponent 1000 is beyond the limit of 64");
    CHECK(mistake("x^(60+5)") == "3: the exponent 65 is beyond the limit of 64");
    CHECK(mistake("2^2^2^2^2^2").find("is beyond the limit of 64") != std::string::npos);
    CHECK(mistake("((x^8)^8)^2") == "11: the exponents multiply to 128, beyond the limit of 64");
    CHECK(mistake("(10^60)^0.5*10^60*1e300") == "1: a number beyond the range of double precision");
    CHECK(read("x^64") == "(^ x 64)");
    CHECK(read("x^100.5") == "(^ x 100.5)");
    CHECK(read("x^(-n)") == "(^ x (- n))");
    CHECK(mistake("1/0") == "2: a division by zero");
    CHECK(mistake("1e400") == "1: the number 1e400 is beyond the range of double precision");
    CHECK(mistake("0e99999999999") == "1: the number 0e99999999999 is beyond the range of double precision");
    CHECK(mistake(repeat("1", 401)) == "1: a number of more than 400 digits");
    CHECK(read(repeat("(", 200) + "x" + repeat(")", 200)) == "x");
    CHECK(mistake(repeat("(", 201) + "x" + repeat(")", 201)) == "201: nested more than 200 levels deep");
    CHECK(mistake(repeat("(", 10000) + "x" + repeat(")", 10000)) == "201: nested more than 200 levels deep");
    CHECK(mistake(repeat("-", 10000) + "x") == "201: nested more than 200 levels deep");
    CHECK(mistake(repeat("x^", 10000) + "x").find("nested more than 200 levels deep") != std::string::npos);
    CHECK(mistake(repeat("sin(", 1000)).find("nested more than 200 levels deep") != std::string::npos);
    CHECK(mistake(repeat("x+", 40000) + "x") == "1: an expression of 80001 bytes; the limit is 65536 (64 KiB)");
    CHECK(read(repeat("x+", 32767) + "x").size() > 65536);
    CHECK(read(repeat("x*", 32767) + "x").size() > 65536);
}

TEST_CASE("expression: nodes know their places") {
    std::vector<Diagnostic> none;
    const Expression e = parse_expression("a + sin(b)*(c+d)''", {}, none);
    REQUIRE(e);
    const Tree& product = *e.tree->args[1];
    CHECK(e.text.substr(product.offset, product.length) == "sin(b)*(c+d)''");
    CHECK(e.text.substr(product.args[0]->offset, product.args[0]->length) == "sin(b)");
    CHECK(e.text.substr(product.args[1]->offset, product.args[1]->length) == "(c+d)''");
}

TEST_CASE("expression: an equation has one equals sign, and rates before an impact only where they make sense") {
    std::vector<Diagnostic> diagnostics;
    const Equality e = parse_equality("m*x'' = F - k*x", {}, diagnostics);
    REQUIRE(diagnostics.empty());
    CHECK(shape(*e.lhs.tree) == "(* m x'')");
    CHECK(shape(*e.rhs.tree) == "(+ F (- (* k x)))");
    for (const char* wrong : {"x", "x = y = z", "x == y", "= x", "x =", "x = 2y"}) {
        parse_equality(wrong, {}, diagnostics);
        CHECK_MESSAGE(diagnostics.size() == 1, wrong);
        diagnostics.clear();
    }
    const Equality impact = parse_equality("x' = -e*x'(-)", {}, diagnostics, true);
    REQUIRE(diagnostics.empty());
    CHECK(shape(*impact.rhs.tree) == "(* (- e) ((-) x'))");
    parse_equality("x' = -e*x'(-)", {}, diagnostics);
    REQUIRE(diagnostics.size() == 1);
    CHECK(diagnostics[0].message ==
          "x'(-), a rate before the impact, stands only in a claim with at = \"impact\"");
}

TEST_CASE("expression: any sequence of words is read or refused") {
    const std::vector<std::string> words{"x", "sin", "atan2", "pos",   "2",  ".5",   "1e9",  "+", "-", "*",
                                         "/", "^",   "(",     ")",     ",",  "'",    "''",   "=", " ", "θ",
                                         "·", "((",  "))",    "x'(-)", "**", "\x01", "\xC3", "_", "e"};
    constexpr unsigned seed = 20240229;
    std::mt19937 random(seed);
    for (int i = 0; i < 4000; ++i) {
        std::string text;
        const unsigned length = random() % 24;
        for (unsigned k = 0; k < length; ++k) text += words[random() % words.size()];
        std::vector<Diagnostic> diagnostics;
        const Expression e = parse_expression(text, {}, diagnostics);
        CHECK_MESSAGE(static_cast<bool>(e) == diagnostics.empty(), "seed ", seed, " case ", i, ": ", text);
        parse_equality(text, {}, diagnostics, i % 2 == 0);
    }
}

}  // namespace scene_expression
