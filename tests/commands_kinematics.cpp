// SPDX-License-Identifier: MIT
// Positions and turns are written here once more, in long double, and differentiated by differences of the sixth
// order in time: with h = 2e-3 they err by h⁶ and by rounding/h², both below 1e-12.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <Eigen/Dense>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <functional>
#include <sstream>

#include "program.hpp"

namespace commands_kinematics {

using alembert::test::run;
using alembert::test::temporary;
using Json = nlohmann::json;
using Real = long double;
using Vector = Eigen::Matrix<Real, 3, 1>;
using Matrix = Eigen::Matrix<Real, 3, 3>;

namespace {

Matrix turn(const Vector& axis, Real angle) {
    return Eigen::AngleAxis<Real>(angle, axis.normalized()).toRotationMatrix();
}

template <typename Value>
Value first(const std::function<Value(Real)>& f, Real h = 2e-3L) {
    return (45 * (f(h) - f(-h)) - 9 * (f(2 * h) - f(-2 * h)) + (f(3 * h) - f(-3 * h))) / (60 * h);
}

template <typename Value>
Value second(const std::function<Value(Real)>& f, Real h = 2e-3L) {
    return (270 * (f(h) + f(-h)) - 27 * (f(2 * h) + f(-2 * h)) + 2 * (f(3 * h) + f(-3 * h)) - 490 * f(0)) /
           (180 * h * h);
}

/// Of a skew matrix, or of the skew part of any.
Vector vector_of(const Matrix& m) {
    return Vector(m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1)) / 2;
}

/// A body on an arm of changing length on a turntable that turns as given, with a support that an input moves.
const std::string arm = R"toml(
gravity = [0, 0, -9.81]
[parameters]
l = 0.7
[inputs]
F = "0.3*sin(2*t)"
[coordinates]
theta = { initial = 0.4, rate = 1.1 }
phi = { initial = -0.3, rate = 0.8 }
s = { initial = 0.5, rate = -0.6 }
[[frame]]
name = "table"
rotate = [["z", "1.3*t + t^2/5"]]
[[frame]]
name = "A"
parent = "table"
rotate = [["y", "theta"], [[1, 2, -2], "phi*F + phi"]]
[[point]]
name = "hinge"
offset = ["l", "F", "s^2/4"]
axes = "table"
[[body]]
name = "B"
mass = 2
inertia = [0.1, 0.2, 0.25]
frame = "A"
from = "hinge"
position = ["l + s", 0.1, "-s*theta"]
axes = "A"
)toml";

struct Pose {
    Matrix R;
    Vector r;
};

Pose pose_at(Real t, Real theta, Real phi, Real s) {
    const Real F = 0.3L * std::sin(2 * t), l = 0.7L;
    const Matrix table = turn(Vector(0, 0, 1), 1.3L * t + t * t / 5);
    const Matrix A = table * turn(Vector(0, 1, 0), theta) * turn(Vector(1, 2, -2), phi * F + phi);
    return {A, table * Vector(l, F, s * s / 4) + A * Vector(l + s, 0.1L, -s * theta)};
}

/// Along q(t) with the given q, q', q''.
std::function<Pose(Real)> path(const Json& state) {
    const auto value = [&state](const char* kind, const char* name) -> Real {
        return static_cast<Real>(state[kind][name].get<double>());
    };
    const Real t0 = state["time"].get<double>();
    const auto q = [&](const char* name) {
        return [x = value("coordinates", name), v = value("rates", name),
                a = value("accelerations", name)](Real d) { return x + v * d + a * d * d / 2; };
    };
    return [t0, theta = q("theta"), phi = q("phi"), s = q("s")](Real d) {
        return pose_at(t0 + d, theta(d), phi(d), s(d));
    };
}

std::string with_outputs(const std::string& scene) {
    std::string text = scene + "[outputs]\n";
    for (const char axis : {'x', 'y', 'z'})
        text += fmt::format(
            "a{0} = \"dot(acc(B), e{0}(N))\"\nw{0} = \"dot(alpha(A), e{0}(N))\"\n"
            "own{0} = \"dot(alpha(B), e{0}(B))\"\n",
            axis);
    return text;
}

void check_equal(const Json& of, const std::string& name, const Vector& expected) {
    for (Eigen::Index k = 0; k < 3; ++k)
        CHECK(of[name + "xyz"[k]].get<double>() ==
              doctest::Approx(static_cast<double>(expected[k])).epsilon(1e-10));
}

}  // namespace

TEST_CASE("kinematics: acc(P) and alpha(B) are the accelerations that the motion has") {
    const std::string scene = temporary("arm.toml", with_outputs(arm));
    for (const char* t : {"t=0", "t=0.7", "t=3.1"}) {
        const auto result = run({"eval", scene, "--json", "--at", t});
        INFO(result.err);
        REQUIRE(result.exit == 0);
        const Json json = Json::parse(result.out);
        const auto pose = path(json);
        const Matrix R = pose(0).R;
        const Vector alpha = vector_of(second<Matrix>([&](Real d) { return pose(d).R; }) * R.transpose());
        check_equal(json["outputs"], "a", second<Vector>([&](Real d) { return pose(d).r; }));
        check_equal(json["outputs"], "w", alpha);
        check_equal(json["outputs"], "own", R.transpose() * alpha);
    }
}

TEST_CASE("kinematics: simulate records accelerations of points") {
    const std::string scene = temporary("swing.toml", R"toml(
gravity = [0, "-g"]
[parameters]
g = 9.81
l = 1.7
[coordinates]
theta = { initial = 0.8, rate = 1 }
[definitions]
a = "acc(M)"
outward = ["sin(theta)", "-cos(theta)"]
[[frame]]
name = "rod"
rotate = [["z", "theta"]]
[[particle]]
name = "M"
mass = 2
position = ["l*sin(theta)", "-l*cos(theta)"]
[outputs]
along = "dot(a, ex(rod))"
centripetal = "-dot(a, outward) - l*theta'^2"
spin = "dot(alpha(rod), ez(rod)) + g*sin(theta)/l"
)toml");
    const std::string table = temporary("swing.csv", "");
    REQUIRE(run({"simulate", scene, "--duration", "1", "-o", table}).exit == 0);
    std::ifstream rows(table);
    std::string line;
    std::getline(rows, line);
    CHECK(line == "t,theta,theta',energy,along,centripetal,spin");
    int count = 0;
    for (; std::getline(rows, line); ++count) {
        std::istringstream cells(line);
        std::vector<double> value;
        for (std::string cell; std::getline(cells, cell, ',');) value.push_back(std::stod(cell));
        REQUIRE(value.size() == 7);
        CHECK(value[4] == doctest::Approx(-9.81 * std::sin(value[1])).epsilon(1e-14));
        CHECK(std::abs(value[5]) < 1e-13);
        CHECK(std::abs(value[6]) < 1e-13);
    }
    CHECK(count > 100);
}

TEST_CASE("kinematics: claims are decided without masses, and told to be kinematics") {
    const std::string frames = R"toml(
[parameters]
l = 1.5
[coordinates]
theta = 0.3
phi = 0.2
[definitions]
r = ["l*sin(theta)", "l*cos(theta)"]
[[frame]]
name = "A"
rotate = [["z", "-theta"]]
[[frame]]
name = "B"
parent = "A"
rotate = [["x", "phi"]]
[[point]]
name = "P"
offset = ["l*sin(theta)", "l*cos(theta)"]
)toml";
    const auto judged = [](const std::string& scene, const std::vector<std::string>& claims) {
        std::string text = scene;
        for (const std::string& claim : claims) text += "[[claim]]\nequation = \"" + claim + "\"\n";
        const auto result = run({"check", temporary("claims.toml", text), "--json"});
        INFO(result.err);
        REQUIRE((result.exit == 0 || result.exit == 1));
        return Json::parse(result.out)["claims"];
    };
    const std::vector<std::string> right{"dot(acc(P), ex(A)) = l*theta''",
                                         "dot(acc(P), ey(A)) = -l*theta'^2",
                                         "dot(alpha(B), ey(N)) = -phi''*sin(theta) - phi'*theta'*cos(theta)",
                                         "dot(alpha(B), ex(B)) = phi''",
                                         "norm(acc(P))^2 = l^2*(theta''^2 + theta'^4)",
                                         "dot(r, vel(P)) = 0",
                                         "norm(pos(P) - r) = 0"};
    const std::vector<std::string> wrong{"dot(acc(P), ex(A)) = l*theta'^2", "dot(acc(P), ey(A)) = l*theta'^2",
                                         "dot(alpha(B), ey(N)) = -phi''*sin(theta)", "dot(alpha(B), ex(B)) = 0"};
    const auto heavy = [&](const std::string& inertia) {
        return frames + "[[body]]\nname = \"D\"\nat = \"P\"\nframe = \"B\"\nmass = \"l\"\ninertia = " + inertia +
               "\n";
    };
    const std::string turning = heavy("[1, 2, 3]"), symmetric = heavy("[1, 2, 2]");
    for (const std::string& scene : {frames, turning}) {
        for (const Json& claim : judged(scene, right)) {
            INFO(claim["equation"].get<std::string>());
            CHECK(claim["verdict"] == "proved");
            CHECK(claim["kinematic"] == true);
            CHECK_FALSE(claim["reason"].get<std::string>().empty());
        }
        for (const Json& claim : judged(scene, wrong)) {
            INFO(claim["equation"].get<std::string>());
            CHECK(claim["verdict"] == "refuted");
            CHECK(claim["kinematic"] == false);
            CHECK_FALSE(claim["counterexample"].empty());
        }
    }
    // What needs a force is no kinematics; what a constraint implies is.
    const Json pushed = judged(symmetric + "[forces]\nphi = \"l\"\n", {"phi'' = l", "phi'' - l = 0*theta''"});
    CHECK(pushed[0]["verdict"] == "proved");
    CHECK(pushed[0]["kinematic"] == false);
    const Json bound = judged(turning + "[[constraint]]\nname = \"gear\"\nholonomic = \"phi = 2*theta\"\n",
                              {"dot(alpha(B), ex(B)) = 2*theta''", "phi'' = 2*theta''"});
    for (const Json& claim : bound) {
        CHECK(claim["verdict"] == "proved");
        CHECK(claim["kinematic"] == true);
    }
}

}  // namespace commands_kinematics
