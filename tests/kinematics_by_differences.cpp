// SPDX-License-Identifier: MIT
// The test computes positions and orientations a second time, in long double, and differentiates them by
// differences of the sixth order in time. With h = 2e-3 their errors are h⁶ and rounding/h², both below 1e-12.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <Eigen/Dense>
#include <cmath>
#include <fstream>
#include <functional>
#include <sstream>

#include "json.hpp"

namespace kinematics_by_differences {

using alembert::test::Json;
using alembert::test::json_of;
using alembert::test::run;
using alembert::test::temporary;
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

/// The vector of a skew matrix, or of the skew part of any matrix.
Vector vector_of(const Matrix& m) {
    return Vector(m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1)) / 2;
}

/// A body on an arm of variable length. The arm is on a turntable with a given rotation, and an input moves the
/// support.
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

/// The pose along a motion q(t) with the given q, q', q''.
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

Vector numbers(const Json& list) {
    Vector v;
    for (Eigen::Index k = 0; k < 3; ++k) v[k] = list[static_cast<std::size_t>(k)].get<double>();
    return v;
}

void check_near(const Vector& found, const Vector& expected, double tolerance = 1e-10) {
    for (Eigen::Index k = 0; k < 3; ++k) CHECK(static_cast<double>(std::abs(found[k] - expected[k])) < tolerance);
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

TEST_CASE("kinematics: values are the derivatives of positions and turns along any motion") {
    const std::string scene = temporary("arm.toml", arm);
    for (const std::vector<std::string>& given :
         {std::vector<std::string>{},
          {"--at", "theta''=0.7", "--at", "phi''=-1.3", "--at", "s''=2", "--at", "t=0.9"}}) {
        std::vector<std::string> args{scene, "--steps"};
        args.insert(args.end(), given.begin(), given.end());
        const Json json = json_of({"kinematics"}, args);
        if (!given.empty()) CHECK(json["accelerations"]["phi"].get<double>() == -1.3);
        const auto pose = path(json);
        const Matrix R = pose(0).R;
        const auto turned = [&](Real d) { return pose(d).R; };
        const auto placed = [&](Real d) { return pose(d).r; };
        const Vector omega = vector_of(first<Matrix>(turned) * R.transpose()),
                     alpha = vector_of(second<Matrix>(turned) * R.transpose());
        for (const char* name : {"A", "B"}) {
            const Json& values = json["frames"][name]["values"];
            for (Eigen::Index i = 0; i < 3; ++i)
                check_near(numbers(values["direction_cosines"][static_cast<std::size_t>(i)]), R.row(i).transpose(),
                           1e-14);
            check_near(numbers(values["omega"]), omega);
            check_near(numbers(values["alpha"]), alpha);
            check_near(numbers(values["own"]["omega"]), R.transpose() * omega);
            check_near(numbers(values["own"]["alpha"]), R.transpose() * alpha);
            CHECK((turn(numbers(values["axis"]), values["angle"].get<double>()) - R).norm() < 1e-14);
        }
        const Json& values = json["points"]["B"]["values"];
        const Vector v = first<Vector>(placed), a = second<Vector>(placed);
        check_near(numbers(values["position"]), placed(0), 1e-14);
        check_near(numbers(values["velocity"]), v);
        check_near(numbers(values["acceleration"]), a);
        CHECK(json["points"]["B"]["own"]["along"] == "A");
        check_near(numbers(values["own"]["position"]), R.transpose() * placed(0), 1e-14);
        check_near(numbers(values["own"]["velocity"]), R.transpose() * v);
        check_near(numbers(values["own"]["acceleration"]), R.transpose() * a);
    }
}

}  // namespace kinematics_by_differences
