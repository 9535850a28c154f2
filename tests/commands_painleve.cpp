// SPDX-License-Identifier: MIT
// Friction that changes its own normal force: where no motion exists or several do (Painlevé), and where the
// normal force grows without bound.
#include <doctest/doctest.h>

#include <fmt/format.h>
#include <cmath>
#include <string>
#include <vector>

#include "contacts.hpp"
#include "edits.hpp"
#include "files.hpp"
#include "inline_slider.hpp"

namespace commands_painleve {

using namespace alembert::test;

namespace {

std::string rod_with(const std::vector<std::pair<std::string, std::string>>& edits) {
    return temporary("painleve_changed.toml",
                     edited(contents(source_path("scenes/friction/painleve_rod.toml")), edits));
}

}  // namespace

TEST_CASE("painleve: Painlevé's rod has no motion where its determinant is negative, and the run says so") {
    const auto result = run({"simulate", rod_with({{"initial = 1.5, rate = -1", "initial = 1.1"}})});
    CHECK(result.exit == 4);
    CHECK(result.err.find("no mode of friction 'tip' is consistent") != std::string::npos);
    CHECK(result.err.find("theta = 1.1") != std::string::npos);
    CHECK(result.err.find("mu = 2") != std::string::npos);
    // With mu < 4/3 there is no such pose.
    const auto smooth = run({"simulate", rod_with({{"initial = 1.5, rate = -1", "initial = 1.1"},
                                                   {"value = 2.0, unit = \"1\"", "value = 1.2"},
                                                   {"duration = 2", "duration = 0.05"}})});
    CAPTURE(smooth.err);
    CHECK(smooth.exit == 0);
}

// A rod of length 2 l slides with its tip on the floor, which it presses with N: gap'' = b + A N/m, where
// A = 1 + 3 cos θ (cos θ − μ s sin θ), s = ±1 against the sliding, and b = l θ'² sin θ − g (Génot & Brogliato, New
// results on Painlevé paradoxes, Eur. J. Mech. A/Solids 18 (1999) 653). It stays if b < 0 < A and leaves if both
// are positive; for A < 0 < b it can do either, and for A, b < 0 neither.
TEST_CASE("painleve: a sliding rod stays, leaves, can do both or neither, as the signs of its closed form say") {
    const std::string scene = R"toml(
gravity = [0, "-g"]
[parameters]
g = 9.81
mu = 2
[coordinates]
x = { initial = "cos(TH)", rate = "SPEED - sin(TH)*OMEGA" }
y = { initial = "sin(TH)", rate = "cos(TH)*OMEGA" }
th = { initial = TH, rate = OMEGA }
[[frame]]
name = "B"
rotate = [["z", "th"]]
[[body]]
name = "rod"
mass = 1
frame = "B"
position = ["x", "y"]
inertia = "1/3"
[[unilateral]]
name = "floor"
gap = "y - sin(th)"
[[friction]]
name = "tip"
coefficient = "mu"
slip = "x' + sin(th)*th'"
on = "floor"
[simulation]
duration = 0.001
)toml";
    int told = 0;
    for (const double theta : {0.4, 0.8, 1.1, 1.4})
        for (const double omega : {0.0, 3.0, 4.5})
            for (const double speed : {3.0, -3.0}) {
                std::string one = scene;
                for (const auto& [name, number] : {std::pair("TH", theta), {"OMEGA", omega}, {"SPEED", speed}})
                    for (std::size_t at = 0; (at = one.find(name)) != std::string::npos;)
                        one.replace(at, std::string(name).size(), fmt::format("{}", number));
                const double s = speed < 0 ? 1 : -1, sine = std::sin(theta), cosine = std::cos(theta);
                const double A = 1 + 3 * cosine * (cosine - 2 * s * sine), b = omega * omega * sine - 9.81;
                INFO("theta = " << theta << ", omega = " << omega << ", speed " << speed);
                const std::string file = temporary("rod.toml", one);
                const auto result = run({"simulate", file, "--no-estimate"});
                INFO(result.err);
                CHECK(result.exit == (A > 0 ? 0 : 4));
                if (A > 0) {
                    CHECK(result.out.find(b < 0 ? "closed: floor" : "closed: no contact") != std::string::npos);
                } else if (b > 0) {
                    ++told;
                    CHECK(result.err.find("more than one contact mode is consistent at t = 0, with different "
                                          "accelerations: floor: slip " +
                                          std::string(speed > 0 ? "+" : "-") + " | floor: open") !=
                          std::string::npos);
                } else {
                    CHECK(result.err.find("no mode of friction 'tip' is consistent") != std::string::npos);
                }
            }
    CHECK(told >= 2);
}

// B slides with friction: x_B = 2 cos θ, θ being the angle of the crank (inline_slider.hpp). With the tension
// S of the rod θ'' = −2 S sin θ cos θ, and from the equation of B, S ((1 + 4 sin²θ) cos θ − μ sin θ) = 2 θ'² cos θ
// while B goes inward and S > 0. Where the factor of S becomes zero the slider jams, before it comes to the pivot.
TEST_CASE("painleve: a slider whose friction lets its normal force grow without bound stops there, and is named") {
    const std::string scene = temporary("inline_slider.toml", inline_slider() + R"toml(
[[friction]]
name = "slide"
coefficient = 0.3
slip = "xb'"
on = "guide"
)toml");
    for (const char* const method : {"verner98", "taylor", "radau"}) {
        CAPTURE(method);
        const auto result = run({"simulate", scene, "--method", method, "--json"});
        INFO(result.err);
        CHECK(result.exit == 4);
        CHECK(result.err.find("friction 'slide' jams") != std::string::npos);
        const Json end = Json::parse(result.out)["final"]["coordinates"];
        const double c = end["xa"].get<double>(), s = end["ya"].get<double>();
        // θ' behaves like the root of the time that is left, which is less than 1e-12 where the steps end.
        CHECK(std::abs((1 + 4 * s * s) * c - 0.3 * s) < 1e-6);
    }
}

}  // namespace commands_painleve
