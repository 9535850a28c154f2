// SPDX-License-Identifier: MIT
// Free bodies and tops turned by quaternions and by angles, as a user runs them: against closed forms in elliptic
// functions, and gimbal lock.
#include <doctest/doctest.h>

#include <cmath>

#include "edits.hpp"
#include "json.hpp"
#include "program.hpp"
#include "scenes.hpp"
#include "tables.hpp"

namespace space_rotation {

using alembert::test::column;
using alembert::test::edited;
using alembert::test::Json;
using alembert::test::json_of;
using alembert::test::number;
using alembert::test::run;
using alembert::test::source_path;
using alembert::test::temporary;
using alembert::test::textbook_text;
using alembert::test::without;

namespace {

/// sn, cn, dn by descending Landen transformations (Abramowitz & Stegun, 16.4): φ_N = 2^N a_N u,
/// sin(2φ_{n−1} − φ_n) = (c_n/a_n) sin φ_n.
struct Jacobi {
    double sn, cn, dn;
};
Jacobi jacobi(double u, double m) {
    std::vector<double> a{1}, c{std::sqrt(m)};
    for (double b = std::sqrt(1 - m); std::abs(c.back()) > 1e-17 && a.size() < 12;) {
        const double next = (a.back() + b) / 2;
        c.push_back((a.back() - b) / 2);
        b = std::sqrt(a.back() * b);
        a.push_back(next);
    }
    double phi = std::ldexp(a.back() * u, static_cast<int>(a.size()) - 1);
    for (std::size_t n = a.size() - 1; n > 0; --n) phi = (phi + std::asin(c[n] / a[n] * std::sin(phi))) / 2;
    return {std::sin(phi), std::cos(phi), std::sqrt(1 - m * std::sin(phi) * std::sin(phi))};
}

}  // namespace

// Landau & Lifshitz, Mechanics, §37, for L² < 2 T B (A, B, C = 1, 2, 3): w1 = a dn, w2 = b sn, w3 = c cn of p t +
// K, where p² and m are as here; w2 starts at its largest.
TEST_CASE("space: the free body moves by Jacobi's elliptic functions, and its moment of momentum stays") {
    const double A = 1, B = 2, C = 3, w1 = 0.01, w2 = 1, T2 = A * w1 * w1 + B * w2 * w2,
                 L2 = A * A * w1 * w1 + B * B * w2 * w2;
    const double a = std::sqrt((T2 * C - L2) / (A * (C - A))), b = std::sqrt((L2 - T2 * A) / (B * (B - A))),
                 c = std::sqrt((L2 - T2 * A) / (C * (C - A))),
                 p = std::sqrt((T2 * C - L2) * (B - A) / (A * B * C)),
                 m = (C - B) * (L2 - T2 * A) / ((B - A) * (T2 * C - L2));
    const std::string scene = source_path("scenes/textbook/free_body_quaternion.toml"),
                      file = temporary("free.csv", "");
    for (const std::string t : {"5", "10", "20"}) {
        CAPTURE(t);
        const Json end = json_of({"simulate", scene, "--json", "--duration", t, "-o", file})["final"];
        const Jacobi e = jacobi(p * std::stod(t) + std::comp_ellint_1(std::sqrt(m)), m);
        CHECK(std::abs(number(end, "speeds", "w1") - a * e.dn) < 1e-10);
        CHECK(std::abs(number(end, "speeds", "w2") - b * e.sn) < 1e-10);
        CHECK(std::abs(number(end, "speeds", "w3") - c * e.cn) < 1e-10);
    }
    const Json end = json_of({"simulate", scene, "--json", "-o", file})["final"];  // by 30 digits, at t = 50
    CHECK(std::abs(number(end, "speeds", "w1") - 0.604575658803382887802411991357) < 1e-10);
    CHECK(std::abs(number(end, "speeds", "w2") - 0.796610490002771404200565729169) < 1e-10);
    CHECK(std::abs(number(end, "speeds", "w3") + 0.349004167700780922294980873671) < 1e-10);
    for (const auto& [name, value] : {std::pair("Hx", 0.01), std::pair("Hy", 2.0), std::pair("Hz", 0.0)})
        for (const double h : column(file, name)) CHECK(std::abs(h - value) < 1e-12);
}

// The same with a free joint and without speeds: four coordinates, their multiplier, and a mass centre that
// drifts.
TEST_CASE("space: a body on a free joint tumbles by Jacobi's elliptic functions") {
    const double A = 1, B = 2, C = 3, w1 = 0.3, w2 = 1, T2 = A * w1 * w1 + B * w2 * w2,
                 L2 = A * A * w1 * w1 + B * B * w2 * w2;
    const double a = std::sqrt((T2 * C - L2) / (A * (C - A))), b = std::sqrt((L2 - T2 * A) / (B * (B - A))),
                 c = std::sqrt((L2 - T2 * A) / (C * (C - A))),
                 p = std::sqrt((T2 * C - L2) * (B - A) / (A * B * C)),
                 m = (C - B) * (L2 - T2 * A) / ((B - A) * (T2 * C - L2));
    const std::string scene = temporary("tumble.toml", R"toml(
[[body]]
name = "brick"
mass = 2
inertia = [1, 2, 3]
[[joint]]
name = "flight"
type = "free"
parent = "N"
child = "brick"
coordinates = { x = { initial = 0, rate = 0.5 }, y = 0, z = 0, e0 = 1, e1 = { initial = 0, rate = 0.15 }, e2 = { initial = 0, rate = 0.5 }, e3 = 0 }
[outputs]
w1 = "dot(omega(brick), ex(brick))"
w2 = "dot(omega(brick), ey(brick))"
w3 = "dot(omega(brick), ez(brick))"
[simulation]
tolerance = 1e-13
)toml"),
                      file = temporary("tumble.csv", "");
    for (const char* by : {"routh", "schiehlen", "roberson-wittenburg"}) {
        CAPTURE(by);
        const Json end = json_of({"simulate", scene, "--json", "--duration", "20", "--by", by, "-o", file});
        const Jacobi e = jacobi(p * 20 + std::comp_ellint_1(std::sqrt(m)), m);
        CHECK(std::abs(column(file, "w1").back() - a * e.dn) < 1e-10);
        CHECK(std::abs(column(file, "w2").back() - b * e.sn) < 1e-10);
        CHECK(std::abs(column(file, "w3").back() - c * e.cn) < 1e-10);
        CHECK(std::abs(number(end["final"], "coordinates", "x") - 10) < 1e-10);
        CHECK(end["constraint_drift"].get<double>() < 1e-13);
    }
}

TEST_CASE("space: a body turned by a quaternion and by Euler angles goes through the same attitudes") {
    std::string by_e = textbook_text("free_body_quaternion");
    by_e = edited(
        without(by_e, "[[claim]]"),
        {{"e0 = 1", "e0 = \"cos(0.5)\""},
         {"e1 = 0", "e1 = \"sin(0.5)\""},
         {"initial = 0.01", "initial = 0.3"},
         {"[outputs]",
          "[outputs]\nup1 = \"dot(ex(F), ez(N))\"\nup2 = \"dot(ey(F), ez(N))\"\nside = \"dot(ex(F), ex(N))\""}});
    const std::string by_angles =
        edited(by_e, {{"quaternion = [\"e0\", \"e1\", \"e2\", \"e3\"]",
                       "rotate = [[\"z\", \"psi\"], [\"x\", \"theta\"], [\"z\", \"phi\"]]"},
                      {"e0 = \"cos(0.5)\"\ne1 = \"sin(0.5)\"\ne2 = 0\ne3 = 0", "psi = 0\ntheta = 1\nphi = 0"}});
    const auto end = [](const std::string& name, const std::string& text, const std::string& by) {
        const std::string file = temporary(name + ".csv", "");
        json_of(
            {"simulate", temporary(name + ".toml", text), "--json", "--duration", "5", "--by", by, "-o", file});
        std::vector<double> last;
        for (const char* item : {"Hx", "Hy", "Hz", "up1", "up2", "side"})
            last.push_back(column(file, item).back());
        return last;
    };
    const std::vector<double> angles = end("angles", by_angles, "kane");
    for (const char* by : {"kane", "routh"}) {  // in three speeds; with the multiplier of e·e = 1
        CAPTURE(by);
        const std::vector<double> e = end(by, by_e, by);
        for (std::size_t k = 0; k < e.size(); ++k) CHECK(std::abs(e[k] - angles[k]) < 1e-10);
    }
    const Json at = json_of({"eval", temporary("routh.toml", by_e), "--by", "routh"});
    CHECK(std::abs(number(at, "multipliers", "lambda_F")) < 1e-13);
}

// θ, φ, ψ by elliptic functions and quadratures in 30 digits.
TEST_CASE("space: the heavy top follows its elliptic solution, by Euler angles and by a quaternion") {
    const struct {
        const char* t;
        double theta, phi, psi;
    } points[] = {
        {"1", 1.32085057941545680726672145344, 0.24603306559641322029112297, 3.9107935553460414576393327},
        {"5", 1.51400137056292675729735384434, 2.4391451410679134801863664, 19.538898839500581892306919},
        {"10", 1.05359445026001034108299428212, 5.2230966662866849375478739, 39.068918627314689980628869}};
    for (const auto& point : points) {
        CAPTURE(point.t);
        const Json angles = json_of(
            {"simulate", source_path("scenes/textbook/heavy_top.toml"), "--json", "--duration", point.t})["final"];
        CHECK(std::abs(number(angles, "coordinates", "theta") - point.theta) < 1e-10);
        CHECK(std::abs(number(angles, "coordinates", "phi") - point.phi) < 1e-10);
        CHECK(std::abs(number(angles, "coordinates", "psi") - point.psi) < 1e-10);
        const std::string file = temporary("top.csv", "");
        for (const char* name : {"heavy_top_quaternion", "heavy_top_joint"}) {
            CAPTURE(name);
            const Json e = json_of({"simulate", source_path(std::string("scenes/textbook/") + name + ".toml"),
                                    "--json", "--duration", point.t, "-o", file});
            CHECK(std::abs(column(file, "height").back() - std::cos(point.theta)) < 1e-10);
            // z-x-z: e0 = cos θ/2 cos (φ+ψ)/2, e3 = cos θ/2 sin (φ+ψ)/2; both signs are the same attitude,
            // continued from the start.
            const double half = (point.phi + point.psi) / 2;
            CHECK(std::abs(number(e["final"], "coordinates", "e0") - std::cos(point.theta / 2) * std::cos(half)) <
                  1e-10);
            CHECK(std::abs(number(e["final"], "coordinates", "e3") - std::cos(point.theta / 2) * std::sin(half)) <
                  1e-10);
            for (const double v : column(file, "vertical")) CHECK(std::abs(v - 0.5 * 4 * std::cos(1.0)) < 1e-12);
        }
    }
}

TEST_CASE("space: gimbal lock is reported with the frame, and a quaternion passes through the pose") {
    const std::string by_angles = source_path("scenes/textbook/heavy_top.toml");
    const std::string upright =
        temporary("upright.toml",
                  edited(textbook_text("heavy_top"), {{"theta = { initial = 1,", "theta = { initial = 0,"}}));
    for (const auto& result : {run({"eval", by_angles, "--at", "theta=0"}), run({"simulate", upright})}) {
        CHECK(result.exit == 4);
        CHECK(result.err.find("the angles phi, theta, psi of frame 'F' are in gimbal lock") != std::string::npos);
        CHECK(result.err.find("give the frame a quaternion") != std::string::npos);
    }
    std::string joint = textbook_text("heavy_top_joint");
    joint = without(without(without(joint, "[speeds]"), "[outputs]"), "[[claim]]");
    joint = edited(joint,
                   {{"coordinates = { e0 = \"cos(theta0/2)\", e1 = \"sin(theta0/2)\", e2 = 0, e3 = 0 }",
                     "angles = \"zxz\"\ncoordinates = { phi = 0, theta = 0, psi = { initial = 0, rate = 4 } }"}});
    const auto held = run({"simulate", temporary("held.toml", joint)});
    CHECK(held.exit == 4);
    CHECK(held.err.find("give joint 'tip' a quaternion: four coordinates, { e0 = 1, e1 = 0, e2 = 0, e3 = 0 }, in "
                        "place of its three angles") != std::string::npos);
    const std::string passes = temporary(
        "passes.toml",
        edited(textbook_text("heavy_top_quaternion"), {{"theta0 = { value = 1.0", "theta0 = { value = 0.0"}}));
    const Json end = json_of({"simulate", passes, "--json"})["final"];  // the top sleeps
    CHECK(std::abs(number(end, "coordinates", "e0") - std::cos(20.0)) < 1e-10);
}

TEST_CASE("space: a singular matrix that is no gimbal lock is not called one") {
    const auto result =
        run({"eval", temporary("massless.toml",
                               "[coordinates]\nx = 0\ny = 0\n[[particle]]\nname = \"P\"\nmass = 1\n"
                               "position = [\"x + y\", 0]\n")});
    CHECK(result.exit == 4);
    CHECK(result.err.find("gimbal") == std::string::npos);
}

}  // namespace space_rotation
