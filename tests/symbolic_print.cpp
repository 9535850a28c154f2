// SPDX-License-Identifier: GPL-2.0-or-later
#include <doctest/doctest.h>

#include <vector>

#include "algebra/notation/latex.hpp"
#include "algebra/notation/lettering.hpp"
#include "algebra/notation/mathml.hpp"
#include "algebra/notation/readable.hpp"
#include "algebra/notation/text.hpp"
#include "algebra/symbolic/functions.hpp"
#include "symbolic_cases.hpp"

namespace symbolic_print {

namespace {

using namespace alembert;
using GiNaC::cos;
using GiNaC::ex;
using GiNaC::numeric;
using GiNaC::pow;
using GiNaC::sin;
using GiNaC::sqrt;

struct Sheet {
    test::Mechanics m;
    GiNaC::symbol mass, a, b, l, g, F, t, x, theta, psi;
    Sheet()
        : mass(m.parameter("m")),
          a(m.parameter("a")),
          b(m.parameter("b")),
          l(m.parameter("l")),
          g(m.parameter("g")),
          F(m.input("F")),
          t(m.time) {
        m.coordinates({"x", "theta", "psi2"});
        x = m.q[0];
        theta = m.q[1];
        psi = m.q[2];
    }
    Phrase phrase(const ex& e) const { return readable(fourier(e, m.symbols).value()); }
    std::string printed(const ex& e) const { return text(phrase(e)); }
    std::string set(const ex& e) const { return latex(phrase(e)); }
};

TEST_CASE_FIXTURE(Sheet, "text: numbers, fractions and decimals") {
    CHECK(printed(0) == "0");
    CHECK(printed(-x / 2) == "-x/2");
    CHECK(printed(2 * mass * x / 3) == "2*m*x/3");
    CHECK(printed(x / (2 * l)) == "x/(2*l)");
    CHECK(printed(numeric(981, 100) * mass * x) == "9.81*m*x");
    CHECK(printed(numeric(981, 100) * x + x * x / 2) == "x^2/2 + 9.81*x");
    CHECK(printed(numeric(981, 100) * x + x * x * 2 / 5) == "0.4*x^2 + 9.81*x");
    CHECK(printed(numeric(1, 1000) * x) == "0.001*x");
    CHECK(printed(numeric(2, 5) * mass * l * l) == "2*m*l^2/5");
    CHECK(printed(2 * GiNaC::Pi * a * x) == "2*pi*a*x");
}

TEST_CASE_FIXTURE(Sheet, "text: powers, roots and functions") {
    CHECK(printed(1 / sqrt(x * x + a * a)) == "1/sqrt(a^2+x^2)");
    CHECK(printed(x / pow(x * x + a * a, numeric(3, 2))) == "x/(a^2+x^2)^(3/2)");
    CHECK(printed(sqrt(ex(2)) * x) == "sqrt(2)*x");
    CHECK(printed(pow(x, a)) == "x^a");
    CHECK(printed(pow(x, 2 * a - 1)) == "x^(2*a)/x");
    CHECK(printed(GiNaC::exp(-x / a)) == "exp(-x/a)");
    CHECK(printed(pow(GiNaC::tan(a), 2) * x) == "tan(a)^2*x");
    CHECK(printed(signum(x) * a) == "a*sign(x)");
    CHECK(printed(GiNaC::atan2(x, a)) == "atan2(x,a)");
}

TEST_CASE_FIXTURE(Sheet, "text: multiple angles become products where that is shorter, and only there") {
    CHECK(printed(sin(2 * theta) / 2) == "sin(theta)*cos(theta)");
    CHECK(printed((1 - cos(2 * theta)) / 2) == "sin(theta)^2");
    CHECK(printed(1 + cos(2 * theta)) == "2*cos(theta)^2");
    CHECK(printed(cos(2 * theta)) == "cos(2*theta)");
    CHECK(printed(cos(theta - psi)) == "cos(theta-psi2)");
    CHECK(printed(sin(theta) * cos(psi)) == "sin(theta)*cos(psi2)");
    CHECK(printed(cos(theta - psi) * sin(x)) == "sin(x)*cos(theta-psi2)");
    CHECK(printed(pow(sin(theta), 3)) == "sin(theta)^3");
    CHECK(printed(cos(theta) / pow(sin(theta), 3)) == "cos(theta)/sin(theta)^3");
    CHECK(printed(a * l * l * pow(cos(theta), 2) + b * l * l * pow(sin(theta), 2)) ==
          "a*l^2*cos(theta)^2 + b*l^2*sin(theta)^2");
    CHECK(printed(mass * g * l * (1 - cos(theta))) == "m*g*l*(1-cos(theta))");
    CHECK(printed(sin(a * t) * sin(a * t)) == "sin(a*t)^2");
    CHECK(printed(mass / (a + b * pow(sin(theta), 2))) == "m/(a+b*sin(theta)^2)");
}

TEST_CASE_FIXTURE(
    Sheet,
    "readable: of what depends on state, time or inputs nothing is divided out but what is positive everywhere") {
    const auto divided = [&](const ex& lhs, const ex& rhs) {
        const ReadableEquation e =
            readable_equation(fourier(lhs, m.symbols).value(), fourier(rhs, m.symbols).value());
        return text(e.lhs) + " = " + text(e.rhs) + (e.divided_by ? " by " + text(*e.divided_by) : "");
    };
    const ex& xdd = m.qddot[0];
    CHECK(divided(x * xdd, x * F) == "x*x'' = x*F");
    CHECK(divided(t * xdd, 0) == "t*x'' = 0");
    CHECK(divided(-mass * xdd, -F) == "m*x'' = F by -1");
    CHECK(divided((a + b) * l * xdd + (a + b) * l * l * x, 0) == "x'' + l*x = 0 by (a+b)*l");
    CHECK(divided(xdd / 3 + x / 2, F / 6) == "2*x'' + 3*x = F by 1/6");
    CHECK(divided(mass * xdd / l, mass * g / (l * l)) == "l*x'' = g by m/l^2");
    CHECK(divided((a * a + x * x) * xdd, (a * a + x * x) * F) == "x'' = F by a^2 + x^2");
    CHECK(divided((a + x * x) * xdd, (a + x * x) * F) == "(a+x^2)*x'' = (a+x^2)*F");
    const ex turns = 1 + pow(GiNaC::tan(theta), 2);
    CHECK(divided(mass * turns * xdd + mass * turns * GiNaC::tan(theta) * x, 0) ==
          "x'' + x*tan(theta) = 0 by m*(1+tan(theta)^2)");
    CHECK(divided(0, 0) == "0 = 0");
    CHECK(divided(0, l * F) == "0 = F by l");
}

TEST_CASE_FIXTURE(Sheet, "text: powers of differences stay powers where they are shorter") {
    const ex& y = theta;  // another coordinate
    CHECK(printed((pow(x - y, 2) - l * l).expand()) == "(x-theta)^2 - l^2");
    CHECK(printed((pow(x - y, 2) + pow(y - a, 2) - l * l).expand()) == "(x-theta)^2 + (theta-a)^2 - l^2");
    CHECK(printed((mass * pow(y - x, 3) - mass * pow(a - y, 3)).expand()) == "m*(theta-x)^3 + m*(theta-a)^3");
    CHECK(printed(sqrt((pow(x - a, 2) + pow(y - b, 2)).expand())) == "sqrt((x-a)^2+(theta-b)^2)");
    CHECK(printed(x * x + 2 * x * y + a) == "x^2 + 2*x*theta + a");
    CHECK(printed((pow(x + 2 * y, 3) + pow(y, 4) - a).expand()) == "(x+2*theta)^3 + theta^4 - a");
}

TEST_CASE_FIXTURE(Sheet, "latex: dots, indices, fractions and functions") {
    CHECK(set(mass * l * l * pow(m.qdot[2], 2) / 2) == "\\frac{1}{2} m l^{2} \\dot{\\psi}_{2}^{2}");
    CHECK(set(pow(sin(psi), 2)) == "\\sin^{2}\\psi_{2}");
    CHECK(set(sin(x)) == "\\sin x");
    CHECK(set(sin(a * t + x)) == "\\sin(x + a t)");
    CHECK(set(F * cos(theta)) == "F(t) \\cos\\theta");
    CHECK(set(x / (2 * l)) == "\\frac{x}{2 l}");
    CHECK(set(1 / sqrt(x * x + a * a)) == "\\frac{1}{\\sqrt{a^{2} + x^{2}}}");
    CHECK(set(x / pow(x * x + a * a, numeric(3, 2))) == "\\frac{x}{(a^{2} + x^{2})^{3/2}}");
    CHECK(set(GiNaC::exp(-x / a)) == "\\mathrm{e}^{-\\frac{x}{a}}");
    CHECK(set(cos(x / a)) == "\\cos\\left(\\frac{x}{a}\\right)");
    CHECK(set(GiNaC::abs(x)) == "\\left|x\\right|");
    CHECK(set(pow(GiNaC::log(x), 2)) == "(\\ln(x))^{2}");
}

TEST_CASE("latex: names") {
    const auto name = [](const std::string& text) {
        const Lettering letters = lettering(text);
        return latex_letters(letters.stem) +
               (letters.index.empty() ? "" : "_{" + latex_letters(letters.index) + "}");
    };
    CHECK(name("theta1") == "\\theta_{1}");
    CHECK(name("θ12") == "\\theta_{12}");
    CHECK(name("m_cart") == "m_{\\mathrm{cart}}");
    CHECK(name("l_a") == "l_{a}");
    CHECK(name("omega_phi") == "\\omega_{\\varphi}");
    CHECK(name("x1_a") == "x_{1,a}");
    CHECK(name("speed2") == "\\mathrm{speed}_{2}");
    CHECK(name("a_b_c") == "a_{\\mathrm{b\\_c}}");
    CHECK(name("_") == "\\mathrm{\\_}");
    CHECK(name("_x") == "\\mathrm{\\_x}");
    CHECK(name("Ω") == "\\Omega");
    CHECK(name("é") == "\\mathrm{\\text{é}}");
    CHECK(name("Δx") == "\\Delta\\mathrm{x}");
    CHECK(name("ж") == "\\mathrm{U436}");
    CHECK(name("I") == "I");
}

/// Every element is closed in order, nothing but the escapes of XML stands after an ampersand.
bool is_well_formed(const std::string& xml) {
    std::vector<std::string> open;
    for (std::size_t i = 0; i < xml.size(); ++i) {
        if (xml[i] == '&') {
            const std::size_t end = xml.find(';', i);
            const std::string entity = xml.substr(i, end - i);
            if (entity != "&amp" && entity != "&lt" && entity != "&gt" && entity != "&quot" && entity[1] != '#')
                return false;
        }
        if (xml[i] != '<') continue;
        const std::size_t end = xml.find('>', i);
        if (end == std::string::npos) return false;
        const std::string tag = xml.substr(i + 1, end - i - 1);
        if (tag[0] == '/') {
            if (open.empty() || open.back() != tag.substr(1)) return false;
            open.pop_back();
        } else {
            open.push_back(tag.substr(0, tag.find(' ')));
        }
        i = end;
    }
    return open.empty();
}

TEST_CASE("mathml: every equation of every mechanism is well formed") {
    for (const test::NamedCase& entry : test::mechanisms()) {
        CAPTURE(entry.name);
        test::Mechanics m;
        entry.build(m);
        CHECK(is_well_formed(mathml(readable(fourier(m.T, m.symbols).value()))));
        for (int i = 0; i < static_cast<int>(m.q.size()); ++i) {
            const ReadableEquation equation = readable_equation(fourier(m.residual(i), m.symbols).value(),
                                                                fourier(m.applied(i), m.symbols).value());
            CHECK(is_well_formed(mathml(equation.lhs, equation.rhs)));
        }
    }
}

TEST_CASE_FIXTURE(Sheet, "mathml: letters carry dots and indices") {
    const std::string psi2_dot_squared =
        "<msubsup><mover accent=\"true\"><mi>ψ</mi><mo>˙</mo></mover><mn>2</mn><mn>2</mn></msubsup>";
    CHECK(mathml(phrase(pow(m.qdot[2], 2))) ==
          "<math xmlns=\"http://www.w3.org/1998/Math/MathML\" display=\"block\">" + psi2_dot_squared + "</math>");
    CHECK(xml_escaped("a<b & \"c\"") == "a&lt;b &amp; &quot;c&quot;");
}

}  // namespace

}  // namespace symbolic_print
