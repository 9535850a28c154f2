// SPDX-License-Identifier: MIT
// Quaternions in the recursion over a tree, against Lagrange's equations with a multiplier: exactly, modulo a
// prime, at states with any e and e', which obey neither e·e = 1 nor its derivative.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <random>

#include "analysis/state/prepared.hpp"
#include "mechanisms.hpp"
#include "model/formalism/joint_tree.hpp"
#include "model/formalism/recursive.hpp"
#include "model/formalism/routh.hpp"
#include "program/interpret.hpp"
#include "program/lower/choose.hpp"
#include "program/lower/inverse.hpp"
#include "program/lower/robot_functions.hpp"
#include "program/modular.hpp"

namespace formalism_ball_joints {

using namespace alembert;
using alembert::test::from_text;

namespace {

std::string body(const std::string& name) {
    return fmt::format(
        "[[body]]\nname = \"{}\"\nmass = \"m\"\ninertia = {{ xx = 0.3, yy = 0.2, zz = 0.25, xy = 0.01, yz = "
        "-0.02, zx "
        "= 0.03 }}\n",
        name);
}

std::string joint(const std::string& type, const std::string& parent, const std::string& child,
                  const std::string& rest) {
    return fmt::format(
        "[[joint]]\nname = \"{0}_{1}_{2}\"\ntype = \"{0}\"\nparent = \"{1}\"\nchild = \"{2}\"\nparent_point = "
        "[0.1, "
        "0.2, -0.3]\nchild_point = [-0.2, 0.1, 0.3]\n{3}\n",
        type, parent, child, rest);
}

std::string quaternion(const std::string& e) {
    return fmt::format("{0}0 = 1, {0}1 = 0, {0}2 = 0, {0}3 = 0", e);
}

const std::string head = "gravity = [1, 2, -9.81]\n[parameters]\nm = 1.5\nk = 20\n";

/// A base that floats, with two arms of two links, one of them with a slide and one with a rotor.
const std::string floating =
    head + body("A") + body("B") + body("C") + body("D") + body("E") +
    joint("free", "N", "A", "coordinates = { x = 0, y = 0, z = 0, " + quaternion("e") + " }") +
    joint("revolute", "A", "B", "axis = \"x\"\ncoordinates = { b = 0.2 }\narmature = { b = 0.3 }") +
    joint("prismatic", "B", "C", "axis = [0.6, 0, 0.8]\ncoordinates = { c = 0.1 }") +
    joint("revolute", "A", "D", "axis = \"z\"\ncoordinates = { d = 0.2 }") +
    joint("revolute", "D", "E", "axis = \"z\"\ncoordinates = { f = -0.4 }") +
    "[[spring]]\nbetween = [\"C\", \"E\"]\nstiffness = \"k\"\nlength = 0.2\n" +
    "[[torque]]\non = \"D\"\nvector = [0.3, \"-0.1*b'\", 0.2]\n";

/// Two spherical joints in a row with a link between and one behind, and another at the first link.
const std::string inside = head + body("A") + body("B") + body("C") + body("D") + body("E") +
                           joint("revolute", "N", "A", "axis = \"y\"\ncoordinates = { a = 0.3 }") +
                           joint("spherical", "A", "B",
                                 "parent_rotate = [[\"x\", 0.3]]\nchild_rotate = [[\"y\", -0.4]]\n"
                                 "coordinates = { " +
                                     quaternion("e") + " }") +
                           joint("spherical", "B", "C", "coordinates = { " + quaternion("f") + " }") +
                           joint("revolute", "C", "D", "coordinates = { d = 0.1 }") +
                           joint("spherical", "A", "E", "coordinates = { " + quaternion("g") + " }");

/// A load that does work along e, so that e·e = 1 has a multiplier.
const std::string pressed = head + body("A") + body("B") +
                            joint("spherical", "N", "A", "coordinates = { " + quaternion("e") + " }") +
                            joint("revolute", "A", "B", "axis = \"x\"\ncoordinates = { b = 0.2 }") +
                            "[energy]\npotential = \"k*e1^2/2 + k*e0*b\"\n";

/// The joint of a body that is placed first is turned backwards.
const std::string backwards = head + body("A") + body("B") +
                              joint("revolute", "N", "B", "axis = \"y\"\ncoordinates = { b = 0.3 }") +
                              joint("spherical", "A", "B", "coordinates = { " + quaternion("e") + " }");

std::vector<Program> programs(const Mechanism& m, const Equations& e) {
    const Energy energy = energy_of(m);
    std::vector<Program> result{lower(m, e, energy)};
    using Solve = RecursionForm::Solve;
    for (const Solve solve : {Solve::matrix, Solve::articulated})
        for (const LinkAxes axes : {LinkAxes::own, LinkAxes::still})
            result.push_back(lower(m, e, energy, {.recursion = RecursionForm{axes, solve}}));
    result.push_back(lower(m, recursive_without_matrix(m), energy,
                           {.recursion = RecursionForm{LinkAxes::own, Solve::articulated}}));
    return result;
}

/// A root of a number that is no square has no value modulo a prime; the next seed is taken then.
void check_same(const Program& expected, const std::vector<int>& a, const Program& program,
                const std::vector<int>& b) {
    REQUIRE(a.size() == b.size());
    int met = 0;
    for (std::uint64_t seed = 1; met < 3; ++seed) {
        REQUIRE(seed < 40);
        const auto x = evaluate_mod(expected, {.seed = seed}, a), y = evaluate_mod(program, {.seed = seed}, b);
        if (!x || !y) continue;
        ++met;
        for (std::size_t i = 0; i < a.size(); ++i) {
            CAPTURE(i);
            CHECK(x->value[a[i]] == y->value[b[i]]);
        }
    }
}

/// A difference of degree d is missed with d·2⁻⁶¹.
void check_exactly(const std::string& text) {
    const Mechanism m = from_text(text);
    const Program expected = lower(m, routh(m), energy_of(m));
    const Equations e = recursive(m);
    REQUIRE(norms_alone(*e.tree, m));
    for (const Program& program : programs(m, e)) {
        CAPTURE(program.formulation);
        for (const Group group : {Group::acceleration, Group::multiplier})
            check_same(expected, expected.nodes_of(group), program, program.nodes_of(group));
    }
}

}  // namespace

TEST_CASE("ball joints: a floating base with arms accelerates as by Lagrange, for any e and e', exactly") {
    check_exactly(floating);
}

TEST_CASE("ball joints: spherical joints inside a tree accelerate as by Lagrange, for any e and e', exactly") {
    check_exactly(inside);
    check_exactly(backwards);
}

TEST_CASE("ball joints: the multiplier of e·e = 1 bears a load along e") {
    check_exactly(pressed);
    const Mechanism m = from_text(pressed);
    const Program p = lower(m, recursive(m), energy_of(m),
                            {.recursion = RecursionForm{LinkAxes::own, RecursionForm::Solve::articulated}});
    State<double> state = start_of(m).state();
    state.q = {0.6, 0.8, 0, 0, 0.5};
    // e·Q = −(k e₁² + k e₀ b), λ = −e·Q/(2 e·e)
    CHECK(interpret(p, state)[p.nodes_of(Group::multiplier)[0]] == doctest::Approx((20 * 0.64 + 20 * 0.3) / 2));
}

TEST_CASE("ball joints: loads for accelerations, M and the bias are those of Lagrange's equations, exactly") {
    for (const std::string& text : {floating, inside, pressed, backwards}) {
        const Mechanism m = from_text(text);
        const Equations e = routh(m);
        Program expected = begun(m);
        const Mechanism own = in_terms_of(e, m);
        const auto lowering = lowering_into(expected, own);
        std::vector<int> mass, loads, bias;
        for (int i = 0; i < m.size(); ++i) {
            std::vector<Program::Term> terms{{-1, lowering(e.forcing(i))}};
            bias.push_back(expected.sum(0, terms));
            for (int j = 0; j < m.size(); ++j) {
                mass.push_back(lowering(e.M(i, j)));
                terms.emplace_back(1, expected.product(1, {{mass.back(), 1}, {lowering(m.qddot[j]), 1}}));
            }
            loads.push_back(expected.sum(0, terms));
        }
        const Program inverse = lower_inverse(m);
        check_same(expected, loads, inverse, inverse.nodes_of(Group::load));
        const RobotFunctions functions(m, false);
        const auto function = [&](const char* name, const std::vector<int>& nodes) {
            CAPTURE(name);
            const Program program = functions.dynamics(name).program;
            check_same(expected, nodes, program, program.nodes_of(Group::function));
        };
        function("mass", mass);
        function("bias", bias);
        function("inverse", loads);
        CHECK_THROWS_WITH_AS(functions.dynamics("mass_inverse"), doctest::Contains("has no inertia along itself"),
                             ModelError);
    }
}

TEST_CASE("ball joints: a projection moves e along e and its rate alike, and nothing else") {
    const Mechanism m = from_text(floating);
    const Program p = choose(m, recursive(m)).program;
    const std::vector<int> to = p.nodes_of(Group::projected);
    const std::size_t n = m.q.size();
    REQUIRE(to.size() == 2 * n);
    std::mt19937_64 random(20261123);
    State<double> state = test::random_state(start_of(m), random);
    const std::array<double, 4> e{0.5, -0.1, 0.7, 0.5};  // e·e = 1
    for (std::size_t i = 0; i < 4; ++i) state.q[3 + i] = 1.0001 * e[i];
    const std::vector<double> value = interpret(p, state);
    double norm = 0, drift = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const double q = value[to[i]], rate = value[to[n + i]];
        if (i < 3 || i > 6) {
            CHECK(q == state.q[i]);
            CHECK(rate == state.qdot[i]);
            continue;
        }
        CHECK(q / e[i - 3] == doctest::Approx(value[to[3]] / e[0]).epsilon(1e-15));
        // The change of the rate is along e.
        CHECK((rate - state.qdot[i]) / e[i - 3] ==
              doctest::Approx((value[to[n + 3]] - state.qdot[3]) / e[0]).epsilon(1e-13));
        norm += q * q;
        drift += q * rate;
    }
    CHECK(std::abs(norm - 1) < 2e-8);  // Newton's method: the square of 1e-4
    CHECK(std::abs(drift) < 1e-14);
}

TEST_CASE("ball joints: trees that quaternions do not make are refused with the reason") {
    const auto reason = [](const std::string& text) {
        const Mechanism m = from_text(text);
        return obstacle_to_recursive(m).value_or("");
    };
    CHECK(reason(head + body("A") +
                 joint("spherical", "N", "A",
                       "motion = { e0 = \"cos(t)\", e1 = \"sin(t)\", e2 = \"0\", e3 = \"0\" }\ncoordinates = {}") +
                 body("B") + joint("revolute", "A", "B", "coordinates = { b = 0 }"))
              .find("prescribed") != std::string::npos);
    const std::string absolute =
        head + "[coordinates]\ne0 = 1\ne1 = 0\ne2 = 0\ne3 = 0\na = 0\n" +
        "[[frame]]\nname = \"F\"\nrotate = [[\"z\", \"a\"]]\n" +
        "[[frame]]\nname = \"G\"\nquaternion = [\"e0\", \"e1\", \"e2\", \"e3\"]\n" +
        "[[body]]\nname = \"A\"\nmass = 1\nframe = \"F\"\nposition = [1, 0, 0]\naxes = \"F\"\ninertia = 1\n" +
        "[[body]]\nname = \"B\"\nmass = 1\nframe = \"G\"\nfrom = \"A\"\nposition = [1, 0, 0]\naxes = \"G\"\n"
        "inertia = [1, 2, 2.5]\n";
    CHECK(reason(absolute).find("does not count from the body") != std::string::npos);
    const std::string twice =
        head + "[coordinates]\ne0 = 1\ne1 = 0\ne2 = 0\ne3 = 0\nx = 0\ny = 0\n" +
        "[[frame]]\nname = \"F\"\nquaternion = [\"e0\", \"e1\", \"e2\", \"e3\"]\n" +
        "[[body]]\nname = \"A\"\nmass = 1\nframe = \"F\"\nposition = [\"x\", 0, 0]\ninertia = [1, 2, 2.5]\n" +
        "[[body]]\nname = \"B\"\nmass = 1\nframe = \"F\"\nposition = [0, \"y\", 0]\ninertia = [1, 2, 2.5]\n";
    CHECK(reason(twice).find("moves more than one joint") != std::string::npos);
}

}  // namespace formalism_ball_joints
