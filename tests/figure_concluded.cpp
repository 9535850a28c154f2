// SPDX-License-Identifier: MIT
// Wedges and ropes that a figure concludes from how masses move.
#include <doctest/doctest.h>

#include <cmath>

#include "edits.hpp"
#include "files.hpp"
#include "present/figure/drawing.hpp"
#include "program/lower/start.hpp"
#include "scene/joints_file.hpp"

namespace figure_concluded {

using namespace alembert;
using alembert::test::contents;
using alembert::test::source_path;
using alembert::test::without;
using Kind = FigureElement::Kind;
using Eigen::Vector3d;

namespace {

struct Drawn {
    Drawing figure;
    Pose pose;

    std::vector<FigureElement> of(Kind kind) const {
        std::vector<FigureElement> found;
        for (const FigureElement& e : figure.elements)
            if (e.kind == kind) found.push_back(e);
        return found;
    }
    const Vector3d& at(const FigureElement& e, std::size_t k) const {
        return pose[static_cast<std::size_t>(e.points[k])];
    }
};

Drawn drawn(const std::string& text, std::vector<double> q = {}) {
    const Mechanism mechanism = build(parse_scene(text, "concluded.toml"));
    Drawing figure = draw(parse_scene(text, "concluded.toml"), mechanism);
    State<double> state = start_of(mechanism).state();
    if (!q.empty()) state.q = std::move(q);
    Pose pose = pose_at(figure, state);
    return {std::move(figure), std::move(pose)};
}

/// A scene of the repository without what it says of its looks.
std::string plain(const std::string& name) {
    std::string text = without(contents(source_path("scenes/textbook/" + name + ".toml")), "[[scenery]]");
    const std::size_t before = text.size();
    for (std::size_t at; (at = text.find("\nshape = ")) != std::string::npos;)
        text.erase(at, text.find('\n', at + 1) - at);
    REQUIRE(text.size() < before);
    return text;
}

/// How far a point is from the line through two others.
double off(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
    return (p - a).cross((b - a).normalized()).norm();
}

std::string hanging(const std::string& positions, const std::string& coordinates, const std::string& rules = "") {
    return "gravity = [0, \"-g\"]\n[parameters]\nm = 1\ng = 9.81\nR = 0.25\nl = 3\n[coordinates]\n" + coordinates +
           positions + rules;
}
std::string mass(const std::string& name, const std::string& x, const std::string& y) {
    return "[[particle]]\nname = \"" + name + "\"\nmass = \"m\"\nposition = [\"" + x + "\", \"" + y + "\"]\n";
}

}  // namespace

TEST_CASE(
    "figure: a mass that slides along an inclined line of another stands on a wedge, which stands on the floor") {
    const double X = 0.3, s = 0.4, alpha = 0.6;
    const Drawn d = drawn(plain("block_on_wedge"), {X, s});
    REQUIRE(d.of(Kind::plate).size() == 2);
    const FigureElement wedge = d.of(Kind::plate)[0], block = d.of(Kind::plate)[1];
    REQUIRE(wedge.points.size() == 3);
    const Vector3d down(std::cos(alpha), -std::sin(alpha), 0);
    const Vector3d &corner = d.at(wedge, 0), &low = d.at(wedge, 1), &top = d.at(wedge, 2);
    CHECK((low - top).normalized().dot(down) == doctest::Approx(1));
    CHECK(std::abs((top - corner)[0]) < 1e-9);
    CHECK(std::abs((low - corner)[1]) < 1e-9);
    const Vector3d place = Vector3d(X, 0, 0) + s * down;  // of the particle, which is on the slope
    CHECK(off(place, top, low) < 1e-9);
    CHECK((place - top).dot(down) > 0);
    CHECK((low - place).dot(down) > 0);
    REQUIRE(block.points.size() == 4);
    CHECK(off(d.at(block, 0), top, low) < 1e-9);
    CHECK(off(d.at(block, 1), top, low) < 1e-9);
    REQUIRE(d.of(Kind::floor).size() == 1);
    CHECK(d.at(d.of(Kind::floor)[0], 0)[1] == doctest::Approx(low[1]));
    CHECK(d.of(Kind::disc).empty());
    CHECK(d.of(Kind::block).empty());
}

TEST_CASE("figure: a wheel touches the slope on which it rolls; two blocks make a ridge") {
    const Drawn d = drawn(plain("cylinder_on_wedge"));
    REQUIRE(d.of(Kind::plate).size() == 1);
    REQUIRE(d.of(Kind::ring).size() == 1);
    const FigureElement wedge = d.of(Kind::plate)[0], wheel = d.of(Kind::ring)[0];
    CHECK(off(d.at(wheel, 0), d.at(wedge, 1), d.at(wedge, 2)) ==
          doctest::Approx((d.at(wheel, 1) - d.at(wheel, 0)).norm()));
    const Drawn two = drawn(plain("wedge_with_two_blocks"));
    REQUIRE(two.of(Kind::plate).size() == 3);
    const FigureElement ridge = two.of(Kind::plate)[0];
    REQUIRE(ridge.points.size() == 3);
    CHECK(two.at(ridge, 0)[1] == doctest::Approx(two.at(ridge, 1)[1]));
    CHECK(two.at(ridge, 2)[1] > two.at(ridge, 0)[1] + 0.1);
    for (std::size_t k : {1, 2}) {
        const FigureElement block = two.of(Kind::plate)[k];
        CHECK(std::min(off(two.at(block, 0), two.at(ridge, 0), two.at(ridge, 2)),
                       off(two.at(block, 0), two.at(ridge, 1), two.at(ridge, 2))) < 1e-9);
    }
}

TEST_CASE("figure: what moves up and down or across on a cart has no wedge, nor has a pendulum") {
    const std::string cart = mass("cart", "x", "0");
    for (const std::string& other : {mass("B", "x", "y"), mass("B", "x + y", "1"),
                                     mass("B", "x + l*sin(y)", "-l*cos(y)"), mass("B", "2*x", "y")}) {
        CAPTURE(other);
        CHECK(drawn(hanging(cart + other, "x = 0.2\ny = 0.7\n")).of(Kind::plate).empty());
    }
    CHECK(drawn(hanging(cart + mass("B", "x + y", "-y/2"), "x = 0.2\ny = 0.7\n")).of(Kind::plate).size() == 2);
}

TEST_CASE("figure: two masses that hang on one rope have a pulley between them, however the scene says it") {
    const auto check = [](const std::string& text, double half) {
        CAPTURE(text);
        const Drawn d = drawn(text);
        REQUIRE(d.of(Kind::pulley).size() == 1);
        const std::vector<FigureElement> ropes = d.of(Kind::rope);
        REQUIRE(ropes.size() == 2);
        const FigureElement pulley = d.of(Kind::pulley)[0];
        if (half > 0) CHECK((d.at(pulley, 1) - d.at(pulley, 0)).norm() == doctest::Approx(half));
        for (const FigureElement& rope : ropes) {
            const Vector3d way = d.at(rope, 1) - d.at(rope, 0);
            CHECK(way.normalized()[1] == doctest::Approx(-1));  // the mass is straight below
            CHECK((d.at(rope, 0) - d.at(pulley, 0)).norm() ==
                  doctest::Approx((d.at(pulley, 1) - d.at(pulley, 0)).norm()));
            CHECK(std::abs((d.at(rope, 0) - d.at(pulley, 0)).dot(way)) < 1e-9);
        }
        CHECK(d.of(Kind::ground).size() == 1);
    };
    check(hanging(mass("A", "-R", "-y") + mass("B", "R", "y - l"), "y = 1\n"), 0.25);
    check(hanging(mass("A", "-R", "-y1") + mass("B", "R", "-y2"), "y1 = 1\ny2 = { guess = 2 }\n",
                  "[[constraint]]\nname = \"rope\"\nholonomic = \"y1 + y2 = l\"\n"),
          0.25);
    check(hanging(mass("A", "0", "-y") + mass("B", "0", "y"), "y = 1\n"), 0);  // drawn side by side
}

TEST_CASE("figure: a mass on a table and one that hangs have a pulley at the corner") {
    const Drawn d = drawn(hanging(mass("A", "-l + y", "0") + mass("B", "0", "-y"), "y = 1\n"));
    REQUIRE(d.of(Kind::pulley).size() == 1);
    REQUIRE(d.of(Kind::rope).size() == 2);
    const FigureElement pulley = d.of(Kind::pulley)[0];
    const double r = (d.at(pulley, 1) - d.at(pulley, 0)).norm();
    CHECK((d.at(pulley, 0) - Vector3d(-r, -r, 0)).norm() < 1e-9);
    for (const FigureElement& rope : d.of(Kind::rope))
        CHECK(off(d.at(pulley, 0), d.at(rope, 0), d.at(rope, 1)) == doctest::Approx(r));
}

TEST_CASE("figure: masses that no rope can join have none") {
    for (const std::string& masses :
         {mass("A", "-R", "-y") + mass("B", "R", "-y"), mass("A", "-R", "-y") + mass("B", "R", "2*y - l"),
          mass("A", "-l + y", "0") + mass("B", "1", "-y^2"), mass("A", "-l + y", "0") + mass("B", "0.5 - y", "0"),
          mass("A", "y - 1/2", "0") + mass("B", "0", "y")}) {
        CAPTURE(masses);
        const Drawn d = drawn(hanging(masses, "y = 1\n"));
        CHECK(d.of(Kind::pulley).empty());
    }
    CHECK(drawn(hanging(mass("A", "-R", "-y1") + mass("B", "R", "-y2"), "y1 = 1\ny2 = 2\n"))
              .of(Kind::pulley)
              .empty());
    CHECK(drawn(hanging(mass("A", "-R", "-y1") + mass("B", "R", "-y2"), "y1 = 1\ny2 = { guess = 1 }\n",
                        "[[constraint]]\nname = \"bar\"\nholonomic = \"y1 - y2 = 0\"\n"))
              .of(Kind::pulley)
              .empty());
}

TEST_CASE("figure: a mass hangs from the rim of the drum that turns with it, and from no other") {
    const auto scene = [](const std::string& angle, const std::string& x) {
        return hanging("[[frame]]\nname = \"D\"\nrotate = [[\"z\", \"" + angle +
                           "\"]]\n[[body]]\nname = \"drum\"\nmass = \"2*m\"\ninertia = \"m*R^2\"\nframe = \"D\"\n"
                           "position = [0, 0]\n" +
                           mass("A", x, "-1 - y"),
                       "y = 1\n" + std::string(angle == "phi" ? "phi = 0\n" : ""));
    };
    const Drawn d = drawn(scene("y/R", "R"));
    REQUIRE(d.of(Kind::rope).size() == 1);
    CHECK((d.at(d.of(Kind::rope)[0], 0) - Vector3d(0.25, 0, 0)).norm() < 1e-9);
    CHECK((d.at(d.of(Kind::rope)[0], 1) - Vector3d(0.25, -2, 0)).norm() < 1e-9);
    CHECK(drawn(scene("phi", "R")).of(Kind::rope).empty());
    CHECK(drawn(scene("y/R", "2*R")).of(Kind::rope).empty());
    CHECK(drawn(scene("2*y/R", "R")).of(Kind::rope).empty());
}

}  // namespace figure_concluded
