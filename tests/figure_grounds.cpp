// SPDX-License-Identifier: MIT
// What a figure concludes for bodies in space, what stands beside them, and where letters stand.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "alembert/base/error.hpp"
#include "analysis/state/assemble.hpp"
#include "files.hpp"
#include "present/figure/drawing.hpp"
#include "present/report/figure.hpp"
#include "present/report/figure_screen.hpp"
#include "program/lower/lower.hpp"
#include "program/lower/start.hpp"
#include "scene/joints_file.hpp"

namespace figure_grounds {

using namespace alembert;
using alembert::test::source_path;
using Kind = FigureElement::Kind;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

struct Drawn {
    Drawing figure;
    std::vector<Pose> poses;
    std::vector<double> q;

    std::vector<FigureElement> of(Kind kind) const {
        std::vector<FigureElement> found;
        for (const FigureElement& e : figure.elements)
            if (e.kind == kind) found.push_back(e);
        return found;
    }
    const Vector3d& at(const FigureElement& e, std::size_t k, std::size_t pose = 0) const {
        return poses[pose][static_cast<std::size_t>(e.points[k])];
    }
};

Drawn drawn(const Scene& scene) {
    const Mechanism mechanism = build(scene);
    Drawing figure = draw(scene, mechanism);
    Start start = start_of(mechanism);
    try {
        Start assembled = start;
        assemble(assembled, mechanism, lower_constraints(mechanism), {}, false);
        start = assembled;
    } catch (const ModelError&) {
        REQUIRE(!scene.functions.empty());
    }
    std::vector<Pose> poses{pose_at(figure, start.state())};
    return {std::move(figure), std::move(poses), start.q};
}

/// A coin whose rules are given.
std::string coin(const std::string& z, const std::string& rules, const std::string& inertia = "m*r^2/2") {
    return "gravity = [0, 0, \"-g\"]\n[parameters]\nm = 1\ng = 9.81\nr = 0.3\nh = 0.2\n[coordinates]\nx = 1\ny = "
           "2\n"
           "phi = 0.2\ntheta = 1.1\npsi = 0\n" +
           (z == "z" ? std::string("z = { guess = 0.7 }\n") : std::string()) +
           "[[frame]]\nname = \"B\"\nrotate = [[\"z\", \"phi\"], [\"x\", \"theta\"], [\"z\", \"psi\"]]\n"
           "[[body]]\nname = \"coin\"\nmass = \"m\"\nframe = \"B\"\nposition = [\"x\", \"y\", \"" +
           z + "\"]\ninertia = [\"m*r^2/4\", \"m*r^2/4\", \"" + inertia + "\"]\n" + rules;
}

/// The corners lie in the plane z = height, about the place of the body.
void check_ground(const std::string& text, double height) {
    CAPTURE(text);
    const Drawn d = drawn(parse_scene(text, "ground.toml"));
    REQUIRE(d.of(Kind::ground_plane).size() == 1);
    const FigureElement ground = d.of(Kind::ground_plane)[0];
    Vector3d middle = Vector3d::Zero();
    for (std::size_t k = 0; k < 4; ++k) {
        CHECK(d.at(ground, k)[2] == doctest::Approx(height).epsilon(1e-9));
        middle += d.at(ground, k) / 4;
    }
    CHECK((middle - Vector3d(1, 2, height)).norm() < 1e-9);
    CHECK((d.at(ground, 1) - d.at(ground, 0)).norm() > 0.6);  // wider than the coin
    CHECK(d.of(Kind::floor).empty());
}

}  // namespace

TEST_CASE("figure: a coin in space stands on the ground that its contact, constraint or position says") {
    check_ground(coin("z", "[[unilateral]]\nname = \"table\"\ngap = \"z - h - r*sin(theta)\"\n"), 0.2);
    check_ground(coin("z", "[[constraint]]\nname = \"table\"\nholonomic = \"z - h - r*sin(theta)\"\n"), 0.2);
    check_ground(coin("h + r*sin(theta)", ""), 0.2);
}

TEST_CASE("figure: what no ground carries has none") {
    // The height over the ground is another one than that of the coin's lowest point.
    CHECK(drawn(parse_scene(coin("z", "[[constraint]]\nname = \"c\"\nholonomic = \"z - h - r*cos(theta)\"\n"),
                            "a.toml"))
              .of(Kind::ground_plane)
              .empty());
    CHECK(drawn(parse_scene(coin("h + r*cos(theta)", ""), "a.toml")).of(Kind::ground_plane).empty());
    CHECK(drawn(parse_scene(coin("z", ""), "a.toml")).of(Kind::ground_plane).empty());
    for (const char* name : {"textbook/gyrocompass", "textbook/heavy_top", "textbook/ball_on_turntable",
                             "textbook/spherical_pendulum"}) {
        CAPTURE(name);
        CHECK(drawn(read_scene(source_path("scenes/" + std::string(name) + ".toml")))
                  .of(Kind::ground_plane)
                  .empty());
    }
}

TEST_CASE("figure: a ball with a quaternion lies on its table, and the ground reaches as far as it rolls") {
    Drawn d = drawn(read_scene(source_path("scenes/friction/billiard_ball_struck.toml")));
    REQUIRE(d.of(Kind::ground_plane).size() == 1);
    const FigureElement ground = d.of(Kind::ground_plane)[0];
    const auto ball = static_cast<std::size_t>(ground.points[4]);
    d.poses.push_back(d.poses[0]);
    d.poses[1][ball] += Vector3d(3, -1, 0);
    stretch_grounds(d.figure, d.poses);
    for (std::size_t pose : {0, 1}) {
        CHECK((d.at(ground, 1, pose) - d.at(ground, 0, pose)).norm() == doctest::Approx(3 + 2 * ground.size));
        CHECK((d.at(ground, 3, pose) - d.at(ground, 0, pose)).norm() == doctest::Approx(1 + 2 * ground.size));
        CHECK(d.at(ground, 0, pose)[2] == doctest::Approx(0).epsilon(1e-12));
    }
}

TEST_CASE("figure: a body that a joint leads along a line is a block on a guide") {
    const Drawn d = drawn(read_scene(source_path("scenes/gallery/slider_crank_joints.toml")));
    REQUIRE(d.of(Kind::block).size() == 1);
    CHECK(d.of(Kind::guide).size() == 1);
    CHECK(d.of(Kind::bar).size() == 2);
    CHECK(std::abs(d.at(d.of(Kind::block)[0], 0)[1]) < 1e-9);
}

TEST_CASE("figure: an ellipsoid is seen with the outline that its points have") {
    const Drawn d = drawn(parse_scene(
        "[coordinates]\nx = 0.5\n[parameters]\nm = 1\na = 1.2\n[[frame]]\nname = \"B\"\nrotate = [[\"z\", 0.7], "
        "[\"x\", 0.4]]\n[[particle]]\nname = \"P\"\nmass = \"m\"\nposition = [\"x\", 0.1, 0.2]\nshape = { "
        "ellipsoid = [\"a\", 0.5, 0.3], axes = \"B\" }\n",
        "ellipsoid.toml"));
    REQUIRE(d.of(Kind::ellipsoid).size() == 1);
    const FigureElement e = d.of(Kind::ellipsoid)[0];
    CHECK((d.at(e, 1) - d.at(e, 0)).norm() == doctest::Approx(1.2));
    CHECK((d.at(e, 3) - d.at(e, 0)).norm() == doctest::Approx(0.3));
    const FigureShapes shapes = shapes_of(d.figure, d.poses, {d.q});
    const FigureScreen screen(shapes, d.poses[0], d.q);
    const auto hull = std::find_if(shapes.shapes.begin(), shapes.shapes.end(),
                                   [](const FigureShape& s) { return s.kind == FigureShape::Kind::hull; });
    REQUIRE(hull != shapes.shapes.end());
    const std::vector<FigureScreen::Place> outline = screen.outline(*hull);
    REQUIRE(outline.size() == 48);
    // In each direction no point of the surface is farther than the outline, and one nearly as far.
    const Vector2d middle = screen.place(hull->vertices[0], *hull);
    for (int k = 0; k < 12; ++k) {
        const double angle = 0.5 * k;
        const Vector2d n(std::cos(angle), std::sin(angle));
        double far = 0, seen = 0;
        for (const FigureScreen::Place& p : outline) seen = std::max(seen, (p.at - middle).dot(n));
        for (int i = 0; i <= 60; ++i)
            for (int j = 0; j < 120; ++j) {
                const double u = std::numbers::pi * i / 60, v = std::numbers::pi * j / 60;
                const Vector3d p = std::sin(u) * std::cos(v) * (d.at(e, 1) - d.at(e, 0)) +
                                   std::sin(u) * std::sin(v) * (d.at(e, 2) - d.at(e, 0)) +
                                   std::cos(u) * (d.at(e, 3) - d.at(e, 0));
                far = std::max(far, Vector2d(p.dot(shapes.right), -p.dot(shapes.up)).dot(n) * shapes.scale);
            }
        CHECK(seen == doctest::Approx(far).epsilon(4e-3));
    }
}

TEST_CASE("figure: a constraint with functions that the scene leaves open does not keep it from its figure") {
    const std::string svg = figure_of(read_scene(source_path("scenes/functions/bead_on_any_curve.toml")));
    CHECK(svg.find("class=\"curve\"") != std::string::npos);
    CHECK(svg.find("class=\"mass\"") != std::string::npos);
}

TEST_CASE("figure: letters stand clear of each other, inside the picture, and there are some") {
    for (const char* name :
         {"benchmark/andrews", "benchmark/flyball_governor", "benchmark/large/chain_64",
          "benchmark/large/four_bars_40", "benchmark/trees/pend32", "gallery/stewart", "friction/braking_box",
          "friction/falling_tripod", "textbook/epicyclic_train", "textbook/turntable_particle",
          "textbook/double_atwood_ropes", "textbook/double_pendulum", "textbook/coupled_oscillators"}) {
        CAPTURE(name);
        const Drawn d = drawn(read_scene(source_path("scenes/" + std::string(name) + ".toml")));
        const FigureShapes shapes = shapes_of(d.figure, d.poses, {d.q});
        const FigureScreen screen(shapes, d.poses[0], d.q);
        std::vector<std::pair<std::string, Vector2d>> letters;
        for (const FigureShape& shape : shapes.shapes)
            if (is_text(shape) && !screen.is_hidden(shape))
                letters.emplace_back(shape.text, screen.middle_of_text(shape) + shape.nudge);
        CHECK(letters.size() >= 5);
        for (std::size_t i = 0; i < letters.size(); ++i) {
            const auto& [text, place] = letters[i];
            CAPTURE(text);
            CHECK(place[0] > 0);
            CHECK(place[0] < shapes.width);
            CHECK(place[1] > 0);
            CHECK(place[1] < shapes.height);
            for (std::size_t j = i + 1; j < letters.size(); ++j) {
                CAPTURE(letters[j].first);
                const Vector2d apart = (place - letters[j].second).cwiseAbs();
                CHECK((apart[0] > 8 || apart[1] > 12));
            }
        }
        // A mark of a coordinate has its letter.
        for (const FigureShape& shape : shapes.shapes) {
            if (shape.style != "angle") continue;
            CHECK(std::any_of(shapes.shapes.begin(), shapes.shapes.end(), [&](const FigureShape& other) {
                return other.style == "angle-name" && other.element == shape.element;
            }));
        }
    }
}

}  // namespace figure_grounds
