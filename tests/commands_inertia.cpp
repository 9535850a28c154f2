// SPDX-License-Identifier: MIT
// Bodies fixed to a frame that turns about a line through O have the kinetic energy θ'²/2 n·I n: the tensor about
// O is compared with the energy from `eval`, about random lines.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <Eigen/Dense>
#include <nlohmann/json.hpp>
#include <random>

#include "json.hpp"
#include "program.hpp"
#include "scenes.hpp"

namespace commands_inertia {

using alembert::test::Json;
using alembert::test::json_of;
using alembert::test::run;
using alembert::test::source_path;
using alembert::test::temporary;

namespace {

std::string two_bodies(const Eigen::Vector3d& n) {
    return fmt::format(R"(
[parameters]
m = 2.5
[coordinates]
theta = {{ initial = 0, rate = 1.7 }}
[[frame]]
name = "F"
rotate = [[[{}, {}, {}], "theta"]]
[[frame]]
name = "G"
parent = "F"
rotate = [["y", 0.4], ["x", -0.9]]
[[body]]
name = "B"
frame = "F"
mass = "m"
inertia = {{ xx = 0.4, yy = 0.5, zz = 0.3, xy = 0.02, yz = -0.05, zx = 0.04 }}
position = [0.3, -0.2, 0.5]
axes = "F"
[[body]]
name = "C"
frame = "G"
mass = 1.25
inertia = {{ xx = 0.2, yy = 0.1, zz = 0.15, yz = 0.03 }}
position = [-0.1, 0.6, 0.2]
axes = "F"
[[particle]]
name = "P"
mass = 0.8
position = [0.5, 0.5, -0.4]
axes = "F"
)",
                       n[0], n[1], n[2]);
}

Json inertia(const std::string& scene, std::vector<std::string> more) {
    return json_of({"inertia", scene}, more);
}

Eigen::Matrix3d tensor_of(const Json& found) {
    Eigen::Matrix3d I;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) I(i, j) = found["tensor"][i][j].get<double>();
    return I;
}

}  // namespace

TEST_CASE("inertia: the tensor of bodies together gives the energy with which they turn about any line") {
    std::mt19937_64 random(3);
    std::normal_distribution<double> component;
    for (int k = 0; k < 8; ++k) {
        const Eigen::Vector3d n =
            Eigen::Vector3d(component(random), component(random), component(random)).normalized();
        const std::string scene = temporary("line.toml", two_bodies(n));
        const auto eval = run({"eval", scene, "--json"});
        REQUIRE(eval.exit == 0);
        const double T = Json::parse(eval.out)["kinetic"].get<double>();
        const Json found = inertia(scene, {"--about", "O"});
        CHECK(found["mass"].get<double>() == doctest::Approx(4.55).epsilon(1e-14));
        CHECK(1.7 * 1.7 / 2 * n.dot(tensor_of(found) * n) == doctest::Approx(T).epsilon(1e-12));
        // Steiner, from the common mass centre back to O.
        const Json central = inertia(scene, {});
        const Eigen::Vector3d c(central["centre"][0], central["centre"][1], central["centre"][2]);
        const Eigen::Matrix3d back =
            tensor_of(central) + 4.55 * (c.dot(c) * Eigen::Matrix3d::Identity() - c * c.transpose());
        CHECK((back - tensor_of(found)).norm() < 1e-13);
        // Principal axes: I a = A a.
        for (const Json& p : central["principal"]) {
            const Eigen::Vector3d a(p["axis"][0], p["axis"][1], p["axis"][2]);
            CHECK((tensor_of(central) * a - p["moment"].get<double>() * a).norm() < 1e-13);
        }
    }
}

TEST_CASE(
    "inertia: of a single body it is along the body's axes, in symbols, and about a point by Steiner's theorem") {
    const std::string rod = temporary("rod.toml", R"(
[parameters]
m = 3.0
l = 2.0
[coordinates]
phi = 0.7
[[frame]]
name = "F"
rotate = [["z", "phi"]]
[[body]]
name = "rod"
frame = "F"
mass = "m"
inertia = { xx = 0, yy = "m*l^2/12", zz = "m*l^2/12" }
position = ["l/2", 0, 0]
axes = "F"
)");
    const Json own = inertia(rod, {"--of", "rod"});
    CHECK(own["along"] == "rod");
    CHECK(own["text"]["tensor"][2][2] == "m*l^2/12");
    CHECK(own["text"]["centre"][0] == "l*cos(phi)/2");
    CHECK(own["tensor"][2][2].get<double>() == doctest::Approx(1).epsilon(1e-15));
    const Json about = inertia(rod, {"--of", "rod", "--about", "O"});
    CHECK(about["text"]["tensor"][2][2] == "m*l^2/3");
    CHECK(about["text"]["tensor"][0][0] == "0");
    CHECK(inertia(rod, {"--at", "phi=0"})["centre"][1].get<double>() == 0);
    CHECK(run({"inertia", rod, "--of", "rot"}).exit == 3);
    CHECK(run({"inertia", rod, "--about", "Q"}).exit == 3);
    CHECK(run({"inertia", source_path("scenes/textbook/kepler.toml"), "--of", "N"}).exit == 3);
}

}  // namespace commands_inertia
