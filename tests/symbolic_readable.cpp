// SPDX-License-Identifier: GPL-2.0-or-later
#include "algebra/notation/readable.hpp"

#include <doctest/doctest.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <random>
#include <sstream>

#include "algebra/notation/latex.hpp"
#include "algebra/notation/mathml.hpp"
#include "algebra/notation/text.hpp"
#include "scene/expression.hpp"
#include "symbolic_cases.hpp"

namespace symbolic_readable {

namespace {

using namespace alembert;
using GiNaC::ex;
using test::Mechanics;

struct Derived {
    Phrase T, V;
    std::vector<ReadableEquation> equations;
};

Derived derive(const Mechanics& m) {
    Derived result{readable(fourier(m.T, m.symbols).value()), readable(fourier(m.V, m.symbols).value()), {}};
    for (int i = 0; i < static_cast<int>(m.q.size()); ++i)
        result.equations.push_back(readable_equation(fourier(m.residual(i), m.symbols).value(),
                                                     fourier(m.applied(i), m.symbols).value()));
    return result;
}

std::string equation_text(const ReadableEquation& equation) {
    return text(equation.lhs) + " = " + text(equation.rhs);
}

std::string page(const test::NamedCase& entry) {
    Mechanics m;
    entry.build(m);
    const Derived derived = derive(m);
    std::ostringstream out;
    out << "# " << entry.name << "\nT = " << text(derived.T) << "\nV = " << text(derived.V) << '\n';
    for (const ReadableEquation& equation : derived.equations) {
        out << equation_text(equation);
        if (equation.divided_by) out << "    (divided by " << text(*equation.divided_by) << ")";
        out << '\n';
    }
    return out.str();
}

std::string all_pages() {
    std::string result;
    for (const test::NamedCase& entry : test::mechanisms()) result += page(entry) + "\n";
    return result;
}

const test::NamedCase& mechanism(const std::string& name) {
    for (const test::NamedCase& entry : test::mechanisms())
        if (entry.name == name) return entry;
    throw std::out_of_range(name);
}

std::vector<std::string> equations_of(const std::string& name) {
    Mechanics m;
    mechanism(name).build(m);
    std::vector<std::string> result;
    for (const ReadableEquation& equation : derive(m).equations) result.push_back(equation_text(equation));
    return result;
}

TEST_CASE("readable: the double pendulum is equation (9) of Zhang & Qin, example 1-2") {
    const std::vector<std::string> equations = equations_of("double pendulum");
    CHECK(equations[0] ==
          "(m1+m2)*l1*theta1'' + m2*l2*theta2''*cos(theta1-theta2) + m2*l2*theta2'^2*sin(theta1-theta2) + "
          "(m1+m2)*g*sin(theta1) = F*cos(theta1)");
    CHECK(equations[1] ==
          "m2*l1*theta1''*cos(theta1-theta2) + m2*l2*theta2'' - m2*l1*theta1'^2*sin(theta1-theta2) + "
          "m2*g*sin(theta2) = F*cos(theta2)");
}

TEST_CASE("readable: the cart with a rod is equation (8) of Zhang & Qin, example 1-3") {
    const std::vector<std::string> equations = equations_of("cart with a rod");
    CHECK(equations[0] == "(m1+m2)*x'' + m2*l*phi''*cos(phi) - m2*l*phi'^2*sin(phi) = 0");
    CHECK(equations[1] == "3*x''*cos(phi) + 4*l*phi'' + 3*g*sin(phi) = 0");
}

TEST_CASE("readable: the mechanisms of textbooks print as in the golden file") {
    const std::string file = ALEMBERT_SOURCE_DIR "/tests/golden/readable.txt";
    const std::string now = all_pages();
    if (std::getenv("ALEMBERT_UPDATE")) std::ofstream(file) << now;
    std::ifstream stream(file);
    const std::string golden{std::istreambuf_iterator<char>(stream), {}};
    CHECK(now == golden);
}

/// Positive random values, so that roots and logarithms are real.
GiNaC::exmap random_point(const Mechanics& m, std::mt19937& random) {
    std::uniform_int_distribution<int> numerator(100, 900);
    GiNaC::exmap point;
    for (const GiNaC::symbol& symbol : m.symbols.all()) point[symbol] = GiNaC::numeric(numerator(random), 499);
    return point;
}

TEST_CASE("readable: the printed form equals the given one, by normal form and by 30-digit numbers") {
    const long digits_before = GiNaC::Digits;
    GiNaC::Digits = 30;
    constexpr unsigned seed = 20240607;
    std::mt19937 random(seed);
    for (const test::NamedCase& entry : test::mechanisms()) {
        CAPTURE(entry.name);
        CAPTURE(seed);
        Mechanics m;
        entry.build(m);
        const Derived derived = derive(m);
        const auto check = [&](const ex& printed, const ex& given) {
            CHECK(is_zero(fourier(printed - given, m.symbols).value()));
            for (int i = 0; i < 3; ++i) {
                const GiNaC::exmap point = random_point(m, random);
                const ex difference = (printed - given).subs(point).evalf();
                const ex size = abs(given.subs(point).evalf()) + 1;
                CAPTURE(difference);
                // 30 digits carried, sums of a few hundred terms of the size of 10³
                CHECK(GiNaC::ex_to<GiNaC::numeric>(abs(difference) / size) < GiNaC::numeric("1e-24"));
            }
        };
        check(expression(derived.T), m.T);
        check(expression(derived.V), m.V);
        for (std::size_t i = 0; i < derived.equations.size(); ++i) {
            const ReadableEquation& equation = derived.equations[i];
            const ex factor = equation.divided_by ? expression(*equation.divided_by) : ex(1);
            const int index = static_cast<int>(i);
            check(factor * (expression(equation.lhs) - expression(equation.rhs)),
                  m.residual(index) - m.applied(index));
            check(factor * expression(equation.rhs), m.applied(index));
        }
    }
    GiNaC::Digits = digits_before;
}

/// The scene language's tree in GiNaC, for the names of one mechanism.
ex translate(const Tree& tree, const Symbols& symbols) {
    std::vector<ex> args;
    for (const TreePtr& arg : tree.args) args.push_back(translate(*arg, symbols));
    switch (tree.kind) {
        case Tree::Kind::number: {
            const std::size_t point = tree.text.find('.');
            if (point == std::string::npos) return GiNaC::numeric(tree.text.c_str());
            const std::string plain = tree.text.substr(0, point) + tree.text.substr(point + 1);
            return GiNaC::numeric(plain.c_str()) / pow(ex(10), static_cast<int>(tree.text.size() - point - 1));
        }
        case Tree::Kind::name:
            for (const GiNaC::symbol& symbol : symbols.all())
                if (symbols.info(symbol).name == tree.text && symbols.info(symbol).order == tree.primes)
                    return symbol;
            if (tree.text == "pi") return GiNaC::Pi;
            throw std::out_of_range(tree.text);
        case Tree::Kind::call:
            if (tree.text == "sqrt") return sqrt(args[0]);
            return GiNaC::function(GiNaC::function::find_function(tree.text, static_cast<unsigned>(args.size())),
                                   args);
        case Tree::Kind::sum:
            return GiNaC::add(args);
        case Tree::Kind::product:
            return GiNaC::mul(args);
        case Tree::Kind::negate:
            return -args[0];
        case Tree::Kind::reciprocal:
            return 1 / args[0];
        case Tree::Kind::power:
            return pow(args[0], args[1]);
        case Tree::Kind::derivative:
            break;
    }
    throw std::invalid_argument("a derivative of a parenthesis");
}

TEST_CASE("readable: the text is read back by the scene's parser as the same expression") {
    for (const test::NamedCase& entry : test::mechanisms()) {
        CAPTURE(entry.name);
        Mechanics m;
        entry.build(m);
        const Derived derived = derive(m);
        std::vector<Phrase> phrases{derived.T, derived.V};
        for (const ReadableEquation& equation : derived.equations) {
            phrases.push_back(equation.lhs);
            phrases.push_back(equation.rhs);
            if (equation.divided_by) phrases.push_back(*equation.divided_by);
        }
        for (const Phrase& phrase : phrases) {
            std::vector<Diagnostic> diagnostics;
            const std::string printed = text(phrase);
            CAPTURE(printed);
            const Expression parsed = parse_expression(printed, {}, diagnostics);
            REQUIRE(parsed.tree);
            CHECK(is_zero(fourier(translate(*parsed.tree, m.symbols) - expression(phrase), m.symbols).value()));
        }
    }
}

/// One process of the reproducibility test: everything in all three notations. Does nothing otherwise.
TEST_CASE("readable: print all") {
    if (!std::getenv("ALEMBERT_PRINT_ALL")) return;
    std::cout << all_pages();
    for (const test::NamedCase& entry : test::mechanisms()) {
        Mechanics m;
        entry.build(m);
        for (const ReadableEquation& equation : derive(m).equations)
            std::cout << latex(equation.lhs) << " = " << latex(equation.rhs) << '\n'
                      << mathml(equation.lhs, equation.rhs) << '\n';
    }
}

std::string output_of(const std::string& command) {
    std::string result;
    FILE* pipe = popen(command.c_str(), "r");
    REQUIRE(pipe);
    std::array<char, 4096> buffer{};
    while (const std::size_t count = fread(buffer.data(), 1, buffer.size(), pipe))
        result.append(buffer.data(), count);
    CHECK(pclose(pipe) == 0);
    return result;
}

TEST_CASE("readable: eight processes print the same bytes") {
    std::array<char, 4096> self{};
    REQUIRE(readlink("/proc/self/exe", self.data(), self.size() - 1) > 0);
    const std::string command =
        "ALEMBERT_PRINT_ALL=1 '" + std::string(self.data()) + "' --test-case='readable: print all'";
    const std::string first = output_of(command);
    REQUIRE(first.size() > 10000);
    for (int run = 1; run < 8; ++run) CHECK(output_of(command) == first);
}

}  // namespace

}  // namespace symbolic_readable
