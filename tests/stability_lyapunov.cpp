// SPDX-License-Identifier: MIT
// The conclusions from a proposed Lyapunov function are compared with known answers and with solutions of
// Lyapunov's matrix equation for random linear systems; the signs of random forms are compared with a fine grid.
#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>
#include <unsupported/Eigen/KroneckerProduct>

#include "alembert/base/error.hpp"
#include "scenes.hpp"
#include "stability/signs.hpp"
#include "stability/stability.hpp"

namespace stability_lyapunov {

using namespace alembert;

namespace {

using V = StabilityVerdict;
using T = StabilityTheorem;

Stability with_function(const std::string& scene, const std::string& function) {
    return stability(parse_scene(scene, "case.toml"), {.lyapunov = function});
}

std::string one(const std::string& potential, const std::string& more = "") {
    return "[coordinates]\nx = 0\n[energy]\nkinetic = \"x'^2/2\"\npotential = \"" + potential + "\"\n" + more;
}
std::string two(const std::string& potential, const std::string& more = "") {
    return "[coordinates]\nx = 0\ny = 0\n[energy]\nkinetic = \"(x'^2 + y'^2)/2\"\npotential = \"" + potential +
           "\"\n" + more;
}
std::string rayleigh(const std::string& R) {
    return "[dissipation]\nrayleigh = \"" + R + "\"\n";
}
std::string force(const std::string& F) {
    return "[forces]\nx = \"" + F + "\"\n";
}

struct Case {
    std::string scene, function;
    V verdict;
    T theorem;
};

void check(const std::vector<Case>& cases) {
    for (const Case& c : cases) {
        CAPTURE(c.scene);
        CAPTURE(c.function);
        const Stability s = with_function(c.scene, c.function);
        CAPTURE(s.reason);
        CHECK(std::string(name_of(s.verdict)) == name_of(c.verdict));
        CHECK(std::string(name_of(s.theorem)) == name_of(c.theorem));
    }
}

}  // namespace

TEST_CASE("lyapunov: a definite V proves stability, with dV/dt definite or LaSalle's set asymptotic stability") {
    const std::string damped = rayleigh("x'^2/2");
    check({
        {one("x^2/2"), "x'^2 + x^2", V::stable, T::lyapunov_stable},
        {one("x^2/2"), "-x'^2 - x^2", V::stable, T::lyapunov_stable},
        {one("x^2/2", damped), "x'^2 + x*x' + 3/2*x^2", V::asymptotically_stable, T::lyapunov_asymptotic},
        {one("x^2/2 + x^4", damped), "x'^2/2 + x^2/2 + x^4", V::asymptotically_stable, T::lasalle},
        {one("x^4", damped), "x'^2/2 + x^4", V::asymptotically_stable, T::lasalle},
        {one("-cos(x)", damped), "x'^2/2 + 1 - cos(x)", V::asymptotically_stable, T::lasalle},
        {one("x^2/2", rayleigh("x'^6/6")), "x'^2 + x^2", V::asymptotically_stable, T::lasalle},
        {one("x^4/4", rayleigh("x'^6/6")), "x'^2/2 + x^4/4", V::asymptotically_stable, T::lasalle},
        {one("x^2/2", force("-x^2*x'")), "x'^2 + x^2", V::asymptotically_stable, T::lasalle},
        {one("x^2/2", force("-x^4*x'^3")), "x'^2 + x^2", V::asymptotically_stable, T::lasalle},
        {one("0*x", force("-x^3 - x'")), "x'^2/2 + x^4/4", V::asymptotically_stable, T::lasalle},
        // Only the difference is damped: the motion x = y never ends, and V cannot prove more than is true.
        {two("(x^2 + y^2)/2", rayleigh("(x' - y')^2/2")), "x'^2 + y'^2 + x^2 + y^2", V::stable,
         T::lyapunov_stable},
        {two("(x^2 + 4*y^2)/2", rayleigh("(x' - y')^2/2")), "x'^2 + y'^2 + x^2 + 4*y^2", V::asymptotically_stable,
         T::lasalle},
        {two("(x^2 + (x - y)^2)/2", rayleigh("y'^2/2")), "x'^2 + y'^2 + x^2 + (x - y)^2", V::asymptotically_stable,
         T::lasalle},
        {two("x^4 + (x - y)^2/2", rayleigh("y'^2/2")), "(x'^2 + y'^2)/2 + x^4 + (x - y)^2/2",
         V::asymptotically_stable, T::lasalle},
        {two("(x^2 + y^2)/2", rayleigh("y'^2/2")), "x'^2 + y'^2 + x^2 + y^2", V::stable, T::lyapunov_stable},
    });
}

TEST_CASE("lyapunov: an indefinite V proves instability by the theorems of Lyapunov and Chetaev") {
    check({
        {one("-x^2/2"), "x*x'", V::unstable, T::lyapunov_instability},
        {one("-x^4/4"), "x*x'", V::unstable, T::lyapunov_instability},
        {one("-x^4/4"), "-x*x'", V::unstable, T::lyapunov_instability},
        {one("-x^2/2"), "(x + x')^2", V::unstable, T::chetaev_instability},
        {one("-x^2/2"), "x'^2 + 3*x*x' + x^2", V::unstable, T::lyapunov_instability},
        {one("x^2/2", force("x'^3")), "x'^2 + x^2 - x*x'^3", V::undecided, T::none},
        {two("(y^2 - x^2)/2"), "x*x'", V::unstable, T::chetaev_instability},
        {two("(y^2 - x^2)/2"), "x*x' + y^2", V::undecided, T::none},
        // dV/dt = g V with g > 0 but at the state; and with a g that is zero on a line.
        {two("0*x", force("(x^2 + y^2 + x'^2 + y'^2)*x'")), "x'^2", V::unstable, T::chetaev_instability},
        {two("0*x", force("(y - x)^2*x'")), "x'^2", V::undecided, T::none},
        {two("-(x^2 + y^2)/2"), "x*x' + y*y'", V::unstable, T::lyapunov_instability},
    });
}

TEST_CASE("lyapunov: a V that proves nothing leaves the verdict open, and sampling is not reported as a proof") {
    check({
        {one("x^2/2"), "x'^2/2 - x^2/2", V::undecided, T::none},
        {one("x^2/2"), "x^2", V::undecided, T::none},
        {one("-x^2/2"), "x'^2 + x^2", V::undecided, T::none},
        {one("x^2/2", rayleigh("x'^2/2")), "abs(x) + x'^2", V::undecided, T::none},
        {one("x^2/2", rayleigh("x'^2/2")), "x^2*x'^2", V::undecided, T::none},
    });
    const Stability s = with_function(one("x^2/2", rayleigh("x'^2/2")), "sqrt(x^2 + x'^2)");
    REQUIRE(s.lyapunov);
    CHECK(s.lyapunov->sampled);
    CHECK(s.verdict == V::undecided);
    CHECK(s.lyapunov->samples.find("V > 0 at all") != std::string::npos);
    CHECK(s.reason.find("without V: asymptotically stable") != std::string::npos);
}

TEST_CASE("lyapunov: dV/dt for a pendulum on a cart follows from its equations of motion") {
    const std::string scene = R"toml(
[parameters]
m = 2
g = 3
l = 0.5
c = 0.25
[coordinates]
x = 0
theta = 0
[energy]
kinetic = "(m + 1)*x'^2/2 + m*l*x'*theta'*cos(theta) + m*l^2*theta'^2/2"
potential = "-m*g*l*cos(theta) + x^2/2"
[dissipation]
rayleigh = "c*x'^2/2"
)toml";
    const Stability s = with_function(
        scene, "(m + 1)*x'^2/2 + m*l*x'*theta'*cos(theta) + m*l^2*theta'^2/2 + m*g*l*(1 - cos(theta)) + x^2/2");
    REQUIRE(s.lyapunov);
    CHECK(s.lyapunov->rate == "-c*x'^2");  // this is the power of the damper
    CHECK(s.lyapunov->rate_sign == "negative semidefinite");
    CHECK(s.lyapunov->set == "x' = 0");
    CHECK(s.theorem == T::lasalle);
}

TEST_CASE("lyapunov: with constraints V is judged on the states that obey them") {
    const auto on_a_circle = [](const std::string& x, const std::string& y, const std::string& more = "") {
        return "[coordinates]\nx = " + x + "\ny = " + y +
               "\n[energy]\nkinetic = \"(x'^2 + y'^2)/2\"\npotential = \"y\"\n[[constraint]]\nname = "
               "\"rod\"\nholonomic = \"x^2 + y^2 - 1\"\n" +
               more;
    };
    const std::string energy = "(x'^2 + y'^2)/2 + y + 1", damper = rayleigh("(x'^2 + y'^2)/2");
    check({
        {on_a_circle("0", "-1"), energy, V::stable, T::lyapunov_stable},
        {on_a_circle("0", "-1", damper), energy, V::stable, T::lyapunov_stable},
        {on_a_circle("0", "-1", damper), "x'^2 + x*x'/2 + 2*(y + 1)", V::asymptotically_stable,
         T::lyapunov_asymptotic},
        {on_a_circle("0", "-1", rayleigh("-(x'^2 + y'^2)/2")), "x'^2 - x*x'/2 + 2*(y + 1)", V::unstable,
         T::lyapunov_instability},
        {on_a_circle("0", "1"), "x*x'", V::unstable, T::lyapunov_instability},
        {on_a_circle("0", "1"), "-x*x'*y", V::unstable, T::lyapunov_instability},
        // Definite in x and y, but y is 1 only to second degree: on the circle 1 - y is like x^2/2.
        {on_a_circle("0", "-1"), "x'^2 + y'^2 + (y + 1)^2", V::undecided, T::none},
        {on_a_circle("0", "1"), "(x'^2 + y'^2)/2 + y - 1", V::undecided, T::none},
        // A knife edge that a damped spring turns straight, while it slides without resistance.
        {"[coordinates]\nx = 0\ny = 0\na = 0\n[energy]\nkinetic = \"(x'^2 + y'^2 + a'^2)/2\"\n"
         "potential = \"a^2/2\"\n[dissipation]\nrayleigh = \"a'^2/2\"\n[[constraint]]\nname = "
         "\"edge\"\nnonholonomic = \"y'*cos(a) - x'*sin(a)\"\n",
         "x'^2 + y'^2 + a'^2 + a^2", V::stable, T::lyapunov_stable},
    });
}

TEST_CASE("lyapunov: solutions of Lyapunov's equation decide random linear systems as their eigenvalues do") {
    std::mt19937 random(151);
    std::uniform_int_distribution<int> whole(-6, 6);
    int stable = 0, unstable = 0;
    for (int k = 0; k < 24; ++k) {
        int c[8];
        for (int& one_of : c) one_of = whole(random);
        // With more damping and stiffness, so that stable systems occur too.
        if (k % 2 == 0) c[0] = c[5] = 7, c[2] = c[7] = 6;
        const auto row = [&](int i) {
            return std::to_string(-c[4 * i]) + "*x - (" + std::to_string(c[4 * i + 1]) + ")*y - (" +
                   std::to_string(c[4 * i + 2]) + ")*x' - (" + std::to_string(c[4 * i + 3]) + ")*y'";
        };
        Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
        A.topRightCorner<2, 2>().setIdentity();
        for (int i = 0; i < 2; ++i)
            for (int j = 0; j < 4; ++j) A(2 + i, j) = -c[4 * i + j];
        const Eigen::Vector4cd roots = A.eigenvalues();
        if (roots.real().cwiseAbs().minCoeff() < 0.05) continue;
        // AᵀP + PA = −1 is solved as 16 equations; V = xᵀPx is written with decimals.
        const Eigen::Matrix4d I = Eigen::Matrix4d::Identity();
        Eigen::MatrixXd K = Eigen::kroneckerProduct(I, A.transpose());
        K += Eigen::kroneckerProduct(A.transpose(), I);
        const Eigen::VectorXd right = -Eigen::Map<const Eigen::VectorXd>(I.data(), 16);
        const Eigen::FullPivLU<Eigen::MatrixXd> lu(K);
        if (lu.rcond() < 1e-6) continue;
        const Eigen::VectorXd P = lu.solve(right);
        const char* const names[] = {"x", "y", "x'", "y'"};
        std::string function = "0";
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < 4; ++j) {
                char number[40];
                std::snprintf(number, sizeof number, "%.9f", (P[4 * i + j] + P[4 * j + i]) / 2);
                function += std::string(" + (") + number + ")*" + names[i] + "*" + names[j];
            }
        const Stability s = with_function(
            "[coordinates]\nx = 0\ny = 0\n[energy]\nkinetic = \"(x'^2 + y'^2)/2\"\n[forces]\nx = \"" + row(0) +
                "\"\ny = \"" + row(1) + "\"\n",
            function);
        CAPTURE(function);
        CAPTURE(s.reason);
        const bool left = roots.real().maxCoeff() < 0;
        CHECK(s.verdict == (left ? V::asymptotically_stable : V::unstable));
        CHECK(s.theorem == (left ? T::lyapunov_asymptotic : T::lyapunov_instability));
        (left ? stable : unstable) += 1;
    }
    CHECK(stable >= 5);
    CHECK(unstable >= 5);
}

TEST_CASE("lyapunov: quartic forms are called definite only where a fine grid finds one sign") {
    std::mt19937 random(3);
    std::uniform_int_distribution<int> whole(-2, 2);
    const Monomials monomials(3, 4);
    int definite = 0, both = 0;
    for (int k = 0; k < 60; ++k) {
        Expansion f(0);
        std::vector<std::pair<Monomials::Exponents, int>> terms;
        for (int i = 0; i < monomials.size(); ++i) {
            if (monomials.degree_of(i) != 4) continue;
            const Monomials::Exponents& e = monomials.exponents(i);
            const int c = whole(random) + (*std::max_element(e.begin(), e.end()) == 4 ? k / 5 : 0);
            terms.emplace_back(e, c);
            Expansion term{RealBall(c)};
            for (int v = 0; v < 3; ++v)
                for (int j = 0; j < e[v]; ++j) term *= Expansion::variable(monomials, v, 0);
            f += term;
        }
        double least = 1e9, most = -1e9;
        for (int a = 0; a < 60; ++a)
            for (int b = 0; b < 60; ++b) {
                const double x[] = {std::sin(M_PI * a / 59) * std::cos(2 * M_PI * b / 60),
                                    std::sin(M_PI * a / 59) * std::sin(2 * M_PI * b / 60),
                                    std::cos(M_PI * a / 59)};
                double sum = 0;
                for (const auto& [e, c] : terms)
                    sum += c * std::pow(x[0], e[0]) * std::pow(x[1], e[1]) * std::pow(x[2], e[2]);
                least = std::min(least, sum);
                most = std::max(most, sum);
            }
        const SignNear sign = sign_near(f, monomials);
        if (sign.definite) CHECK(least * most > 0);
        if (sign.positive && sign.negative) CHECK(least * most < 0);
        definite += sign.definite ? 1 : 0;
        both += sign.positive && sign.negative ? 1 : 0;
    }
    CHECK(definite > 10);
    CHECK(both > 10);
}

TEST_CASE("lyapunov: an expression that cannot be a Lyapunov function is refused with the reason") {
    const auto refused = [](const std::string& scene, const std::string& function, const std::string& with,
                            double period = 0) {
        std::string message;
        try {
            stability(parse_scene(scene, "case.toml"), {.period = period, .lyapunov = function});
        } catch (const ModelError& e) {
            message = e.what();
        }
        CAPTURE(message);
        CHECK(message.find(with) != std::string::npos);
    };
    const std::string oscillator = one("x^2/2");
    refused(oscillator, "x^2 + 1", "is 1 at this state; expected 0 there: subtract 1");
    refused(oscillator, "x^2 + y^2", "unknown name 'y'");
    refused(oscillator, "x^2 +", "the Lyapunov function x^2 +: ");
    refused(oscillator, "x''^2", "accelerations or multipliers");
    refused(oscillator, "x^2*cos(t)", "changes with time");
    refused(oscillator, "x^2", "leave it out for", 6);
    refused("[polynomial]\ncoefficients = [1, 2]\n", "x^2", "leave it out for");
    refused(two("(x^2)/2"), "x^2 + y^2", "it holds y, which nothing in the equations depends on");
    refused(
        "[coordinates]\ny = 1\n[energy]\nkinetic = \"y'^2/2\"\npotential = \"(y - "
        "1)^2\"\n[[unilateral]]\nname = \"floor\"\ngap = \"y\"\n",
        "(y - 1)^2", "this scene has contacts");
}

}  // namespace stability_lyapunov
