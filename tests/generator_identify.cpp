// SPDX-License-Identifier: MIT
// Which inertial parameters motion and loads show, against inverse dynamics, textbooks and counts.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <Eigen/Dense>
#include <random>

#include "analysis/rigid/identify.hpp"
#include "analysis/state/prepared.hpp"
#include "program/lower/regressor.hpp"
#include "robot_functions.hpp"
#include "simulate/inverse.hpp"

namespace generator_identify {

using namespace alembert;
using test::check_near;
using test::random_motion;
using test::values;

TEST_CASE("identify: the regressor times the parameters is inverse dynamics without the scene's own loads") {
    const unsigned seed = 73;
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    for (const char* file :
         {"scenes/gallery/six_joint_arm", "scenes/benchmark/trees/arm7g", "scenes/textbook/double_pendulum_joints",
          "scenes/textbook/crane", "scenes/gallery/gimballed_gyroscope", "scenes/textbook/cart_rod",
          "scenes/gallery/universal_double_pendulum", "tests/odd/armature"}) {
        CAPTURE(file);
        const Scene scene = read_scene(test::source_path(fmt::format("{}.toml", file)));
        const Mechanism m = prepared(scene).mechanism;
        const State<double> state = random_motion(m, random);
        const Regressor y = regressor(scene, m, false);
        const std::vector<double> Y = values(y.function, state);
        Mechanism own = m;
        own.z = y.z;
        Program program;
        const std::vector<int> nodes = lower_expressions(program, own, y.values);
        const std::vector<double> pi = interpret(program, state);
        const RobotFunctions functions(m, false);
        const std::vector<double> tau = values(functions.dynamics("inverse"), state),
                                  loads = values(functions.dynamics("loads"), state);
        std::vector<double> by_Y(tau.size()), expected;
        for (std::size_t i = 0; i < tau.size(); ++i) {
            expected.push_back(tau[i] + loads[i]);
            for (std::size_t k = 0; k < nodes.size(); ++k)
                by_Y[i] += Y[i * nodes.size() + k] * pi[static_cast<std::size_t>(nodes[k])];
        }
        check_near(by_Y, expected);
        // The base parameters alone give the same loads.
        const Identification found = identify(scene);
        REQUIRE(found.parameters.size() == nodes.size());
        std::vector<double> by_base(tau.size());
        for (const BaseParameter& base : found.base) {
            const auto k = static_cast<std::size_t>(
                std::find(found.parameters.begin(), found.parameters.end(), base.terms[0].parameter) -
                found.parameters.begin());
            for (std::size_t i = 0; i < tau.size(); ++i) by_base[i] += Y[i * nodes.size() + k] * base.value;
        }
        check_near(by_base, expected);
    }
}

// Of the ten parameters of a link that turns about z, the mass, mz and one of xx and yy move no joint in a way of
// their own: they can be counted to the link before it, because turning about z does not move them relative to it.
// Seven remain. The first link only turns about its axis: of its seven only zz, mx and my show, and if gravity is
// along the axis zz alone. So 6 joints show 7·5 + 1 = 36 combinations, or 7·5 + 3 = 38.
TEST_CASE("identify: base parameters of arms are as many as a count gives, and their sums those of the textbook") {
    const auto scene_with = [](const char* gravity, int joints) {
        // Turning axes as those of the PUMA 560: z, then y y, then wrist axes z y z, with offsets.
        const char* const axes[] = {"z", "y", "y", "z", "y", "z"};
        const char* const points[] = {"[0, 0, 0.6]",      "[0, 0.24, 0]", "[0.43, -0.09, 0]",
                                      "[-0.02, 0, 0.43]", "[0, 0, 0]",    "[0, 0, 0]"};
        std::string text = fmt::format("gravity = {}\n", gravity);
        for (int k = 1; k <= joints; ++k)
            text += fmt::format(
                "[[body]]\nname = \"B{0}\"\nmass = 2\ninertia = [0.1, 0.12, 0.15]\n[[joint]]\nname = "
                "\"J{0}\"\ntype = "
                "\"revolute\"\nparent = \"{1}\"\nchild = \"B{0}\"\nparent_point = {2}\naxis = "
                "\"{3}\"\ncoordinates = "
                "{{ q{0} = {{ initial = 0 }} }}\n",
                k, k == 1 ? "N" : fmt::format("B{}", k - 1), points[k - 1], axes[k - 1]);
        return parse_scene(text, "arm.toml");
    };
    CHECK(identify(scene_with("[0, 0, -9.81]", 6)).base.size() == 36);
    CHECK(identify(scene_with("[0, 0, -9.81]", 6)).parameters.size() == 60);
    const Identification three = identify(scene_with("[0, 0, -9.81]", 3));
    REQUIRE(three.base.size() == 15);
    std::map<std::string, std::string> printed;  // zz(B1) + 0.48 my(B2) …: decimals, as the scene's points are
    for (const BaseTerm& term : three.base[0].terms) printed[term.parameter] = term.coefficient;
    CHECK(printed["m(B2)"] == "0.0576");                                // 0.24²
    CHECK(printed["m(B3)"] == "0.2074");                                // (0.24 − 0.09)² + 0.43²
    CHECK(printed["my(B3)"] == "0.3");                                  // 2 (0.24 − 0.09)
    CHECK(printed["my(B2)"] == "0.48");                                 // 2 · 0.24
    CHECK(identify(scene_with("[3, 0, -9.81]", 6)).base.size() == 38);  // gravity is not along the first axis
    CHECK(identify(scene_with("[0, 0, 0]", 1)).base.size() == 1);
    // A planar arm of two links: z I + m l², m x + m l.
    const Identification two = identify(parse_scene(R"(
gravity = [0, "-g"]
parameters = { l = 0.5, g = 9.81 }
body = [{ name = "upper", mass = 3, inertia = 0.06 }, { name = "lower", mass = 2, inertia = 0.03 }]
[[joint]]
name = "shoulder"
type = "revolute"
parent = "N"
child = "upper"
child_point = ["-l/2", 0]
coordinates = { q1 = { initial = 0 } }
[[joint]]
name = "elbow"
type = "revolute"
parent = "upper"
child = "lower"
parent_point = ["l/2", 0]
child_point = [-0.2, 0]
coordinates = { q2 = { initial = 0 } }
)",
                                                    "two.toml"));
    REQUIRE(two.base.size() == 6);
    std::map<std::string, std::string> coefficient;
    for (const BaseTerm& term : two.base[0].terms) coefficient[term.parameter] = term.coefficient;
    CHECK(coefficient == std::map<std::string, std::string>{{"zz(upper)", "1"}, {"m(lower)", "l^2"}});
}

// A four-bar linkage. The masses of the bars on the ground do not show. Two point masses at its pins replace what
// the coupler has as m and mx, and count to the bars: of its four parameters two remain, and three of each bar.
TEST_CASE("identify: with constraints, what motion shows is found on the states that obey them") {
    const Identification body =
        identify(read_scene(test::source_path("scenes/textbook/free_body_quaternion.toml")));
    CHECK(body.base.size() == body.parameters.size() - body.without_influence.size());
    constexpr double left = 0.8, coupler = 1.1, right = 0.9;
    std::string text = "gravity = [0, -9.81]\n";
    for (const char* name : {"left", "coupler", "right"})
        text += fmt::format("[[body]]\nname = \"{}\"\nmass = 1.5\ninertia = 0.1\n", name);
    const auto joint = [&](const char* name, const char* parent, const char* child, const char* points,
                           const char* rest) {
        text +=
            fmt::format("[[joint]]\nname = \"{}\"\ntype = \"revolute\"\nparent = \"{}\"\nchild = \"{}\"\n{}\n{}",
                        name, parent, child, points, rest);
    };
    joint("a", "N", "left", "child_point = [-0.4, 0.05]", "coordinates = { qa = { guess = 0.9 } }\n");
    joint("b", "left", "coupler", "parent_point = [0.4, 0.05]\nchild_point = [-0.5, 0.1]",
          "coordinates = { qb = { guess = -0.5 } }\n");
    joint("c", "N", "right", "parent_point = [1, 0]\nchild_point = [-0.4, 0]",
          "coordinates = { qc = { guess = 1.2 } }\n");
    joint("d", "right", "coupler", "parent_point = [0.5, 0]\nchild_point = [0.6, 0.1]", "");
    const Scene scene = parse_scene(text, "bars.toml");
    const Identification bars = identify(scene);
    REQUIRE(bars.base.size() == 8);
    for (const char* mass : {"m(left)", "m(right)"})
        CHECK(std::find(bars.without_influence.begin(), bars.without_influence.end(), mass) !=
              bars.without_influence.end());
    const Mechanism m = prepared(scene).mechanism;
    const Regressor y = regressor(scene, m, false);
    Mechanism own = m;
    own.z = y.z;
    Program program;
    const std::vector<int> nodes = lower_expressions(program, own, y.values);
    for (const double a : {0.9, 1.3, 1.7}) {
        // From the crank's angle, the pin B where two circles meet; then the motion that the loop allows.
        const Eigen::Vector2d A(left * std::cos(a), left * std::sin(a)), D(1, 0), AD = D - A;
        const double d = AD.norm(), along = (d * d + coupler * coupler - right * right) / (2 * d);
        const Eigen::Vector2d across(-AD[1], AD[0]),
            AB = along / d * AD + std::sqrt(coupler * coupler - along * along) / d * across, DB = A + AB - D;
        const double beta = std::atan2(AB[1], AB[0]), gamma = std::atan2(DB[1], DB[0]);
        Eigen::Matrix2d turned;
        turned << -AB[1], DB[1], AB[0], -DB[0];
        const Eigen::Vector2d rates = turned.inverse() * Eigen::Vector2d(A[1], -A[0]);  // β', γ' at a' = 1
        State<double> state = start_of(m).state();
        state.q = {a, beta - a, gamma};
        state.qdot = {0, 0, 0};
        const std::vector<double> motion{1, rates[0] - 1, rates[1]};
        state.qddot = motion;
        const std::vector<double> Y = values(y.function, state), pi = interpret(program, state);
        double by_all = 0, by_base = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t k = 0; k < nodes.size(); ++k)
                by_all += motion[i] * Y[i * nodes.size() + k] * pi[static_cast<std::size_t>(nodes[k])];
            for (const BaseParameter& base : bars.base) {
                const auto k = static_cast<std::size_t>(
                    std::find(bars.parameters.begin(), bars.parameters.end(), base.terms[0].parameter) -
                    bars.parameters.begin());
                by_base += motion[i] * Y[i * nodes.size() + k] * base.value;
            }
        }
        CHECK(std::abs(by_all - by_base) < 1e-10 * std::abs(by_all));
    }
}

}  // namespace generator_identify
