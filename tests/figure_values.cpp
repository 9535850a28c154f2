// SPDX-License-Identifier: MIT
// Figures: the points of drawings against closed forms of the mechanisms.
#include <doctest/doctest.h>

#include <cmath>
#include <set>

#include "analysis/state/assemble.hpp"
#include "present/figure/drawing.hpp"
#include "program/lower/lower.hpp"
#include "program/lower/start.hpp"
#include "scenes.hpp"

namespace figure_values {

using namespace alembert;
using alembert::test::scenes_in;
using alembert::test::source_path;
using Kind = FigureElement::Kind;
using Eigen::Vector3d;

namespace {

struct Drawn {
    Scene scene;
    Mechanism mechanism;
    Drawing figure;
    State<double> start;
    Pose pose;
};

Drawn drawn(Scene scene) {
    Mechanism mechanism = build(scene);
    Drawing figure = draw(scene, mechanism);
    Start start = start_of(mechanism);
    assemble(start, mechanism, lower_constraints(mechanism), {}, false);
    Drawn d{std::move(scene), std::move(mechanism), std::move(figure), start.state(), {}};
    if (d.figure.obstacle.empty()) d.pose = pose_at(d.figure, d.start);
    return d;
}
Drawn drawn(const std::string& file) {
    return drawn(read_scene(source_path(file)));
}

std::vector<FigureElement> of_kind(const Drawing& figure, Kind kind) {
    std::vector<FigureElement> found;
    for (const FigureElement& e : figure.elements)
        if (e.kind == kind) found.push_back(e);
    return found;
}

bool near(const Vector3d& a, const Vector3d& b) {
    return (a - b).norm() < 1e-12 * (1 + b.norm());
}

/// Does an element of the kind have its two ends there, in either order?
bool has_line(const Drawn& d, Kind kind, const Vector3d& a, const Vector3d& b, const std::string& label) {
    for (const FigureElement& e : of_kind(d.figure, kind)) {
        const Vector3d &p = d.pose[e.points[0]], &q = d.pose[e.points[1]];
        if (e.label == label && ((near(p, a) && near(q, b)) || (near(p, b) && near(q, a)))) return true;
    }
    return false;
}

bool has_point(const Drawn& d, Kind kind, const Vector3d& a) {
    for (const FigureElement& e : of_kind(d.figure, kind))
        if (near(d.pose[e.points[0]], a)) return true;
    return false;
}

const FigureElement* letter(const Drawn& d, Kind kind, const std::string& name) {
    for (const FigureElement& e : d.figure.elements)
        if (e.kind == kind && e.label == name) return &e;
    return nullptr;
}

}  // namespace

TEST_CASE(
    "figure: a double pendulum has two rods, two masses, a support, two angles from the vertical and a force") {
    Drawn d = drawn("scenes/textbook/double_pendulum.toml");
    const double l1 = 1, l2 = 0.8;
    d.start.q = {0.7, -1.9};
    d.start.t = 0.4;
    d.pose = pose_at(d.figure, d.start);
    const Vector3d O(0, 0, 0), A(l1 * std::sin(0.7), l1 * std::cos(0.7), 0),
        B = A + Vector3d(l2 * std::sin(-1.9), l2 * std::cos(-1.9), 0);
    CHECK(d.figure.is_plane);
    CHECK(near(d.figure.down, {0, 1, 0}));
    CHECK(has_line(d, Kind::rod, O, A, "l1"));
    CHECK(has_line(d, Kind::rod, A, B, "l2"));
    CHECK(of_kind(d.figure, Kind::rod).size() == 2);
    CHECK(has_point(d, Kind::disc, A));
    CHECK(has_point(d, Kind::disc, B));
    CHECK(has_point(d, Kind::support, O));
    const FigureElement* const theta2 = letter(d, Kind::angle, "theta2");
    REQUIRE(theta2 != nullptr);
    CHECK(near(d.pose[theta2->points[0]], A));
    CHECK(near(d.pose[theta2->points[1]], A + Vector3d(0, l2, 0)));
    CHECK(near(d.pose[theta2->points[2]], B));
    CHECK(letter(d, Kind::angle, "theta1") != nullptr);
    const FigureElement* const force = letter(d, Kind::force, "F");
    REQUIRE(force != nullptr);
    CHECK(near(d.pose[force->points[0]], B));
    CHECK(near(d.pose[force->points[1]], {0.5 * std::sin(1.2), 0, 0}));
}

TEST_CASE("figure: the same pendulum of joints has its angles relative to the rod before") {
    Drawn d = drawn("scenes/textbook/double_pendulum_joints.toml");
    d.start.q = {0.5, -0.7};
    d.pose = pose_at(d.figure, d.start);
    // Frames turn from x to y, and y points down: the first rod ends at (−sin q1, cos q1).
    const Vector3d O(0, 0, 0), A(-std::sin(0.5), std::cos(0.5), 0),
        B = A + 0.8 * Vector3d(-std::sin(-0.2), std::cos(-0.2), 0);
    CHECK(has_line(d, Kind::rod, O, A, "l1"));
    CHECK(has_line(d, Kind::rod, A, B, "l2"));
    const FigureElement* const q2 = letter(d, Kind::angle, "q2");
    REQUIRE(q2 != nullptr);
    CHECK(near(d.pose[q2->points[0]], A));
    CHECK(near(d.pose[q2->points[1]], A + 0.8 * A));  // straight on
    CHECK(near(d.pose[q2->points[2]], B));
}

TEST_CASE("figure: a four-bar linkage has three bars between its four hinges, closed at the start") {
    for (const char* file : {"scenes/textbook/four_bar.toml", "scenes/gallery/four_bar_joints.toml"}) {
        CAPTURE(file);
        const Drawn d = drawn(file);
        // Crank a at 0.5 rad, coupler b, rocker c, ground d: the rocker's end is where two circles meet.
        const double a = 1, b = 4, c = 3.5, ground = 3;
        const Vector3d P(a * std::cos(0.5), a * std::sin(0.5), 0), D(ground, 0, 0);
        const double k = (D - P).norm(), x = (k * k + b * b - c * c) / (2 * k), y = std::sqrt(b * b - x * x);
        const Vector3d e = (D - P) / k, n(-e[1], e[0], 0), Q = P + x * e + y * n;
        CHECK(of_kind(d.figure, Kind::bar).size() == 3);
        const auto line = [&](const Vector3d& from, const Vector3d& to) {
            for (const FigureElement& bar : of_kind(d.figure, Kind::bar))
                for (const bool turned : {false, true})
                    if ((d.pose[bar.points[turned ? 1 : 0]] - from).norm() < 1e-8 &&
                        (d.pose[bar.points[turned ? 0 : 1]] - to).norm() < 1e-8)
                        return bar.label;
            return std::string("none");
        };
        CHECK(line({0, 0, 0}, P) == "a");
        CHECK(line(P, Q) == "b");
        CHECK(line(D, Q) == "c");
        CHECK(has_point(d, Kind::support, {0, 0, 0}));
        CHECK(has_point(d, Kind::support, D));
        for (const char* name : {"alpha", "beta", "gamma"}) CHECK(letter(d, Kind::angle, name) != nullptr);
    }
}

TEST_CASE("figure: a slider-crank has a crank, a rod and a block on a horizontal guide") {
    const Drawn d = drawn("scenes/textbook/slider_crank.toml");
    const double r = 0.15, l = 0.4, alpha = 0.3, beta = std::asin(r * std::sin(alpha) / l);
    const Vector3d pin(r * std::cos(alpha), r * std::sin(alpha), 0),
        end(r * std::cos(alpha) + l * std::cos(beta), 0, 0);
    const std::vector<FigureElement> blocks = of_kind(d.figure, Kind::block), bars = of_kind(d.figure, Kind::bar);
    REQUIRE(blocks.size() == 1);
    REQUIRE(bars.size() == 2);
    CHECK((d.pose[blocks[0].points[0]] - end).norm() < 1e-9);
    CHECK(near((d.pose[blocks[0].points[1]] - d.pose[blocks[0].points[0]]).cwiseAbs(), {1, 0, 0}));
    CHECK(has_line(d, Kind::bar, {0, 0, 0}, pin, "r"));
    // The rod of mass centre l/2 and J = m l²/12 goes on to the slider.
    double best = 1;
    for (const FigureElement& bar : bars)
        for (int k = 0; k < 2; ++k)
            best = std::min(best, (d.pose[bar.points[k]] - end).norm() + (d.pose[bar.points[1 - k]] - pin).norm());
    CHECK(best < 1e-9);
    const FigureElement* const x = letter(d, Kind::length, "x");
    REQUIRE(x != nullptr);
    CHECK(near(d.pose[x->points[0]], {0, 0, 0}));
}

TEST_CASE("figure: wheels have the radius of their rolling condition, and their rim turns with them") {
    SUBCASE("on a line, by a velocity constraint") {
        Drawn d = drawn("scenes/textbook/hoop_pendulum.toml");
        d.start.q = {0.3, 0.7, 1.0};
        d.pose = pose_at(d.figure, d.start);
        const std::vector<FigureElement> rings = of_kind(d.figure, Kind::hoop);
        REQUIRE(rings.size() == 1);
        CHECK(rings[0].size == doctest::Approx(0.5));
        const Vector3d centre(0.3, 0.5, 0);
        CHECK(near(d.pose[rings[0].points[0]], centre));
        CHECK(near(d.pose[rings[0].points[1]], centre + 0.5 * Vector3d(std::cos(-0.7), std::sin(-0.7), 0)));
        CHECK(near(d.pose[rings[0].points[2]], centre + 0.5 * Vector3d(-std::sin(-0.7), std::cos(-0.7), 0)));
    }
    SUBCASE("in space, by [[rolling]]") {
        Drawn d = drawn("scenes/textbook/rolling_disc_in_space.toml");
        const double psi = 0.4, theta = 0.3, phi = 1.1, r = 0.5;
        d.start.q = {0.2, -0.1, psi, theta, phi};
        d.pose = pose_at(d.figure, d.start);
        const std::vector<FigureElement> rings = of_kind(d.figure, Kind::ring);
        REQUIRE(rings.size() == 1);
        const Vector3d up(std::sin(psi) * std::sin(theta), -std::cos(psi) * std::sin(theta), std::cos(theta)),
            contact(0.2, -0.1, 0);
        CHECK(rings[0].size == doctest::Approx(r));
        const Vector3d centre = d.pose[rings[0].points[0]], u = d.pose[rings[0].points[1]] - centre,
                       v = d.pose[rings[0].points[2]] - centre;
        CHECK(near(centre, contact + r * up));
        // The rim passes through the contact, whatever phi is.
        const double x = (contact - centre).dot(u) / (r * r), y = (contact - centre).dot(v) / (r * r);
        CHECK(near(centre + x * u + y * v, contact));
        CHECK(std::abs(u.dot(v)) < 1e-12);
    }
    SUBCASE("a constraint that is no rolling makes no wheel") {
        const Drawn d = drawn("scenes/textbook/falling_ladder.toml");
        CHECK(of_kind(d.figure, Kind::ring).empty());
        CHECK(of_kind(d.figure, Kind::bar).size() == 1);
        const FigureElement bar = of_kind(d.figure, Kind::bar)[0];
        // Half of the ladder is l = 2, and its ends touch wall and floor.
        const Vector3d a = d.pose[bar.points[0]], b = d.pose[bar.points[1]];
        CHECK((a - b).norm() == doctest::Approx(4).epsilon(1e-9));
        CHECK(std::min(std::abs(a[0]), std::abs(b[0])) < 1e-9);
        CHECK(std::min(std::abs(a[1]), std::abs(b[1])) < 1e-9);
    }
}

TEST_CASE("figure: springs along a coordinate are found between their points, strings and floors by their gaps") {
    const Drawn spring = drawn("scenes/textbook/elastic_pendulum.toml");
    const Vector3d bob(std::sin(0.7), -std::cos(0.7), 0);
    CHECK(has_line(spring, Kind::spring, {0, 0, 0}, bob, "k"));
    const Drawn string = drawn("scenes/textbook/slack_pendulum.toml");
    CHECK(of_kind(string.figure, Kind::string).size() == 1);
    const Drawn ball = drawn("scenes/textbook/bouncing_ball.toml");
    REQUIRE(of_kind(ball.figure, Kind::floor).size() == 1);
    const FigureElement floor = of_kind(ball.figure, Kind::floor)[0];
    CHECK(near(ball.pose[floor.points[0]], {0, 0, 0}));
    CHECK(near(ball.pose[floor.points[2]] - ball.pose[floor.points[0]], {0, 1, 0}));
    const Drawn rod = drawn("scenes/textbook/cartesian_pendulum.toml");
    CHECK(has_line(rod, Kind::tie, {0, 0, 0}, {1, 0, 0}, "rod"));
    const Drawn chain = drawn("scenes/textbook/coupled_oscillators.toml");
    CHECK(of_kind(chain.figure, Kind::spring).size() == 3);
    CHECK(of_kind(chain.figure, Kind::damper).size() == 1);
    CHECK(of_kind(chain.figure, Kind::wall).size() == 2);
}

TEST_CASE("figure: a body that no joint holds is round where its moment of inertia or its ropes say so") {
    const Drawn ball = drawn("scenes/textbook/sphere_on_sphere.toml");
    REQUIRE(of_kind(ball.figure, Kind::ring).size() == 1);
    CHECK(of_kind(ball.figure, Kind::ring)[0].size == doctest::Approx(0.2));  // of 2 m r²/5
    REQUIRE(of_kind(ball.figure, Kind::curve).size() == 1);                   // the sphere below it, of radius R
    const FigureElement circle = of_kind(ball.figure, Kind::curve)[0];
    for (const int k : circle.points) CHECK(ball.pose[k].norm() == doctest::Approx(1.0));
    CHECK(of_kind(ball.figure, Kind::tie).empty());
    const Drawn inside = drawn("scenes/textbook/cylinder_in_cylinder.toml");
    CHECK(of_kind(inside.figure, Kind::curve).size() == 1);
    const Drawn drum = drawn("scenes/textbook/stepped_drum.toml");
    std::set<double> radii;
    for (const FigureElement& e : of_kind(drum.figure, Kind::ring)) radii.insert(std::round(1e6 * e.size) / 1e6);
    CHECK(radii == std::set{0.15, 0.4});
    const Drawn belt = drawn("scenes/textbook/belt_drive.toml");
    CHECK(of_kind(belt.figure, Kind::ring).size() == 2);
    const Drawn stick = drawn("scenes/textbook/falling_stick.toml");
    CHECK(of_kind(stick.figure, Kind::ring).empty());
    // A ball on a floor: its gap is that of its lowest point.
    const Drawn billiards = drawn("scenes/friction/billiard_ball.toml");
    REQUIRE(of_kind(billiards.figure, Kind::floor).size() == 1);
    CHECK(near(billiards.pose[of_kind(billiards.figure, Kind::floor)[0].points[0]], {0, 0, 0}));
}

TEST_CASE("figure: a particle hangs on the centre of its circle, on its rope, or runs on its curve") {
    const Drawn two = drawn("scenes/textbook/coupled_pendulums.toml");
    CHECK(has_line(two, Kind::rod, {0.5, 0, 0}, {0.5, -1, 0}, "l"));
    CHECK(has_point(two, Kind::support, {0.5, 0, 0}));
    CHECK(letter(two, Kind::angle, "theta2") != nullptr);
    const Drawn bead = drawn("scenes/textbook/bead_on_parabola.toml");
    REQUIRE(of_kind(bead.figure, Kind::curve).size() == 1);
    const FigureElement parabola = of_kind(bead.figure, Kind::curve)[0];
    for (const int k : parabola.points) {
        const Vector3d& p = bead.pose[k];
        CHECK(p[2] == doctest::Approx(1.5 * (p[0] * p[0] + p[1] * p[1])));
    }
    const Drawn swing = drawn("scenes/textbook/swinging_atwood.toml");
    CHECK(has_line(swing, Kind::rope, {0, 0, 0}, {std::sin(1.5), -std::cos(1.5), 0}, ""));
}

TEST_CASE("figure: scenes with energies only and no scenery have none, and all others have finite points") {
    CHECK_FALSE(
        drawn(parse_scene("[coordinates]\nx = 1\n[energy]\nlagrangian = \"x'^2/2 - x^2/2\"\n", "plain.toml"))
            .figure.obstacle.empty());
    for (const char* folder :
         {"scenes/textbook", "scenes/gallery", "scenes/benchmark", "scenes/stability", "scenes/friction"})
        for (const std::string& file : scenes_in(folder)) {
            CAPTURE(file);
            const Drawn d = drawn(read_scene(file));
            CHECK(d.figure.obstacle.empty());
            CHECK_FALSE(d.figure.elements.empty());
            for (const Vector3d& p : d.pose) CHECK(p.allFinite());
        }
}

}  // namespace figure_values
