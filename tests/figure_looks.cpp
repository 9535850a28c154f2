// SPDX-License-Identifier: MIT
// What a scene says of its looks: shapes and their moments of inertia, and scenery.
#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "alembert/base/error.hpp"
#include "codegen/emit/emit.hpp"
#include "files.hpp"
#include "model/formalism/formalisms.hpp"
#include "model/formalism/routh.hpp"
#include "present/figure/drawing.hpp"
#include "program/lower/choose.hpp"
#include "program/lower/start.hpp"
#include "scene/joints_file.hpp"
#include "scene/looks.hpp"
#include "scenes.hpp"

namespace figure_looks {

using namespace alembert;
using alembert::test::source_path;
using Kind = FigureElement::Kind;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

constexpr double mass = 3;

/// The tensor of the only body of a scene with that shape, by the program.
Matrix3d tensor_of(const std::string& shape) {
    const std::string text =
        "[coordinates]\npsi = 0\ntheta = 0.5\nphi = 0\n[parameters]\nm = 3\na = 0.7\nb = 0.4\nc = 1.1\n"
        "[[frame]]\nname = \"B\"\nrotate = [[\"z\", \"psi\"], [\"x\", \"theta\"], [\"z\", \"phi\"]]\n"
        "[[body]]\nname = \"body\"\nmass = \"m\"\nframe = \"B\"\nat = \"O\"\n"
        "inertia = \"from shape\"\nshape = " +
        shape + "\n";
    const Scene scene = parse_scene(text, "shape.toml");
    build(scene);
    const Inertia& inertia = *scene.bodies[0].inertia;
    // The parameters are numbers, so that their values follow by replacing the names.
    std::array<double, 6> e{};
    for (std::size_t k = 0; k < 6; ++k) {
        std::string formula = inertia.tensor[k].text;
        for (const auto& [name, value] :
             {std::pair('m', "3"), std::pair('a', "0.7"), std::pair('b', "0.4"), std::pair('c', "1.1")})
            for (std::size_t at = 0; (at = formula.find(name, at)) != std::string::npos; ++at)
                formula.replace(at, 1, value);
        std::vector<Diagnostic> mistakes;
        const std::optional<double> value = value_of(parse_expression(formula, {}, mistakes));
        REQUIRE(mistakes.empty());
        REQUIRE(value);
        e[k] = *value;
    }
    Matrix3d J;
    J << e[0], e[3], e[5], e[3], e[1], e[4], e[5], e[4], e[2];
    return J;
}

/// A mass is spread over weighted points; its tensor about its centroid.
class Spread {
public:
    void add(const Vector3d& p, double weight) {
        whole_ += weight;
        first_ += weight * p;
        second_ += weight * p * p.transpose();
    }
    Matrix3d tensor() const {
        const Vector3d middle = first_ / whole_;
        const Matrix3d about = second_ / whole_ - middle * middle.transpose();
        return mass * (about.trace() * Matrix3d::Identity() - about);
    }

private:
    double whole_ = 0;
    Vector3d first_ = Vector3d::Zero();
    Matrix3d second_ = Matrix3d::Zero();
};

constexpr int steps = 400;

/// A solid of revolution about z from `low` to `high`, by the midpoints of rings and slices; flat if these are
/// equal.
Matrix3d turned(double low, double high, const std::function<double(double)>& radius) {
    Spread spread;
    const int slices = high > low ? steps : 1;
    for (int i = 0; i < slices; ++i) {
        const double z = low + (high - low) * (i + 0.5) / slices, r = radius(z);
        for (int j = 0; j < steps; ++j)
            for (int k = 0; k < 8; ++k) {
                const double s = r * (j + 0.5) / steps, angle = 2 * std::numbers::pi * k / 8;
                spread.add({s * std::cos(angle), s * std::sin(angle), z}, s * r);
            }
    }
    return spread.tensor();
}

/// A flat figure, by the midpoints of small squares inside it (even–odd rule).
Matrix3d flat(const std::vector<std::pair<double, double>>& corners) {
    Spread spread;
    constexpr int fine = 1200;
    constexpr double low = -2, high = 3;
    for (int i = 0; i < fine; ++i)
        for (int j = 0; j < fine; ++j) {
            const double x = low + (high - low) * (i + 0.5) / fine, y = low + (high - low) * (j + 0.5) / fine;
            bool inside = false;
            for (std::size_t k = 0; k < corners.size(); ++k) {
                const auto [x1, y1] = corners[k];
                const auto [x2, y2] = corners[(k + 1) % corners.size()];
                if ((y1 > y) != (y2 > y) && x < x1 + (x2 - x1) * (y - y1) / (y2 - y1)) inside = !inside;
            }
            if (inside) spread.add({x, y, 0}, 1);
        }
    return spread.tensor();
}

void agree(const std::string& shape, const Matrix3d& integral, double part = 2e-5) {
    CAPTURE(shape);
    const Matrix3d J = tensor_of(shape);
    CAPTURE(J);
    CAPTURE(integral);
    CHECK((J - integral).norm() < part * integral.norm());
}

struct Drawn {
    Scene scene;
    Mechanism mechanism;
    Drawing figure;
    Pose pose;

    std::vector<FigureElement> of(Kind kind) const {
        std::vector<FigureElement> found;
        for (const FigureElement& e : figure.elements)
            if (e.kind == kind) found.push_back(e);
        return found;
    }
    bool has_line(Kind kind, const Vector3d& a, const Vector3d& b) const {
        for (const FigureElement& e : of(kind))
            for (const bool turned : {false, true})
                if ((pose[e.points[turned ? 1 : 0]] - a).norm() < 1e-9 &&
                    (pose[e.points[turned ? 0 : 1]] - b).norm() < 1e-9)
                    return true;
        return false;
    }
};

Drawn drawn(Scene scene, std::vector<double> q = {}) {
    Mechanism mechanism = build(scene);
    Drawing figure = draw(scene, mechanism);
    State<double> state = start_of(mechanism).state();
    if (!q.empty()) state.q = std::move(q);
    REQUIRE_MESSAGE(figure.obstacle.empty(), figure.obstacle);
    Pose pose = pose_at(figure, state);
    return {std::move(scene), std::move(mechanism), std::move(figure), std::move(pose)};
}
Drawn drawn(const std::string& file, std::vector<double> q = {}) {
    return drawn(read_scene(source_path(file)), std::move(q));
}

std::string mistakes_of(const std::string& text) {
    try {
        parse_scene(text, "looks.toml");
    } catch (const SceneError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("looks: the moments of inertia from a shape are those of a numerical integral") {
    agree("{ disc = \"a\" }", turned(0, 0, [](double) { return 0.7; }));
    agree("{ ball = \"a\" }", turned(-0.7, 0.7, [](double z) { return std::sqrt(0.49 - z * z); }));
    agree("{ cylinder = [\"a\", \"c\"] }", turned(-0.55, 0.55, [](double) { return 0.7; }));
    agree("{ cone = [\"a\", \"c\"] }", turned(0, 1.1, [](double z) { return 0.7 * (1 - z / 1.1); }));
    Spread hoop, rod, box;
    for (int k = 0; k < 12; ++k)
        hoop.add({0.7 * std::cos(std::numbers::pi * k / 6), 0.7 * std::sin(std::numbers::pi * k / 6), 0}, 1);
    agree("{ ring = \"a\" }", hoop.tensor());
    for (int k = 0; k < 1000; ++k) rod.add({1.1 * ((k + 0.5) / 1000 - 0.5), 0, 0}, 1);
    agree("{ rod = \"c\" }", rod.tensor());
    for (int i = 0; i < 120; ++i)
        for (int j = 0; j < 120; ++j)
            for (int k = 0; k < 120; ++k)
                box.add(
                    {0.7 * ((i + 0.5) / 120 - 0.5), 0.4 * ((j + 0.5) / 120 - 0.5), 1.1 * ((k + 0.5) / 120 - 0.5)},
                    1);
    agree("{ box = [\"a\", \"b\", \"c\"] }", box.tensor(), 1e-4);
    Spread ellipsoid;
    for (int i = 0; i < 100; ++i)
        for (int j = 0; j < 100; ++j)
            for (int k = 0; k < 100; ++k) {
                const Vector3d p((2 * i + 1) / 100.0 - 1, (2 * j + 1) / 100.0 - 1, (2 * k + 1) / 100.0 - 1);
                if (p.norm() < 1) ellipsoid.add({0.7 * p[0], 0.4 * p[1], 1.1 * p[2]}, 1);
            }
    agree("{ ellipsoid = [\"a\", \"b\", \"c\"] }", ellipsoid.tensor(), 1e-3);
    // Turned axes: x in place of z.
    Matrix3d x = turned(-0.55, 0.55, [](double) { return 0.7; });
    std::swap(x(0, 0), x(2, 2));
    agree("{ cylinder = [\"a\", \"c\"], axis = \"x\" }", x);
    agree("{ box = [\"a\", \"b\"] }", flat({{0, 0}, {0.7, 0}, {0.7, 0.4}, {0, 0.4}}), 1e-2);
    agree("{ wedge = [\"c\", \"a\"] }", flat({{0, 0}, {1.1, 0}, {0, 0.7}}), 5e-3);
    // An angle with unequal legs, which has a product of inertia, in either sense and from any origin.
    const std::vector<std::pair<double, double>> angle{{0.5, 0.2}, {2.5, 0.2}, {2.5, 0.6},
                                                       {0.9, 0.6}, {0.9, 1.6}, {0.5, 1.6}};
    agree("{ polygon = [[0.5, 0.2], [2.5, 0.2], [2.5, 0.6], [0.9, 0.6], [0.9, 1.6], [0.5, 1.6]] }", flat(angle),
          5e-3);
    agree("{ polygon = [[0.5, 1.6], [0.9, 1.6], [0.9, 0.6], [2.5, 0.6], [2.5, 0.2], [0.5, 0.2]] }", flat(angle),
          5e-3);
    CHECK(std::abs(flat(angle)(0, 1)) > 0.1);
}

TEST_CASE("looks: a word with its sizes beside it means what the table means") {
    for (const auto& [word, table] :
         {std::pair("\"box\"\nsize = [\"a\", \"b\", \"c\"]", "{ box = [\"a\", \"b\", \"c\"] }"),
          std::pair("\"box\"\nsize = [\"a\", 2]", "{ box = [\"a\", 2] }"),
          std::pair("\"ellipsoid\"\nsize = [\"a\", \"b\", \"c\"]", "{ ellipsoid = [\"a\", \"b\", \"c\"] }"),
          std::pair("\"wedge\"\nsize = [\"a\", \"b\"]", "{ wedge = [\"a\", \"b\"] }"),
          std::pair("\"disc\"\nradius = \"a\"", "{ disc = \"a\" }"),
          std::pair("\"ring\"\nradius = \"a\"", "{ ring = \"a\" }"),
          std::pair("\"ball\"\nradius = \"a + b\"", "{ ball = \"a + b\" }"),
          std::pair("\"rod\"\nlength = \"c\"", "{ rod = \"c\" }"),
          std::pair("\"cylinder\"\nradius = \"a\"\nheight = \"b\"", "{ cylinder = [\"a\", \"b\"] }"),
          std::pair("\"cone\"\nheight = \"b\"\nradius = \"a\"", "{ cone = [\"a\", \"b\"] }"),
          std::pair("[[0, 0], [\"a\", 0], [0, \"b\"]]", "{ polygon = [[0, 0], [\"a\", 0], [0, \"b\"]] }")}) {
        CAPTURE(word);
        const Matrix3d J = tensor_of(word);
        CHECK(J.norm() > 0);
        CHECK(J == tensor_of(table));
        // The same figure, of a particle too.
        const std::string particle =
            "[coordinates]\nx = 0.5\n[parameters]\nm = 1\na = 0.7\nb = 0.4\nc = 1.1\n"
            "[[particle]]\nname = \"P\"\nmass = \"m\"\nposition = [\"x\", 2]\nshape = ";
        const Drawn one = drawn(parse_scene(particle + word + "\n", "word.toml")),
                    other = drawn(parse_scene(particle + table + "\n", "table.toml"));
        REQUIRE(one.figure.elements.size() == other.figure.elements.size());
        for (std::size_t k = 0; k < one.pose.size(); ++k) CHECK((one.pose[k] - other.pose[k]).norm() < 1e-12);
    }
}

TEST_CASE("looks: a scene with looks has the same program as without, byte for byte") {
    for (const char* name :
         {"block_on_wedge", "rotating_hoop", "wedge_with_two_blocks", "rolling_disc", "stepped_drum"}) {
        CAPTURE(name);
        std::string text = test::contents(source_path("scenes/textbook/" + std::string(name) + ".toml"));
        const std::string full = text;
        for (std::size_t at; (at = text.find("\nshape = ")) != std::string::npos;)
            text.erase(at, text.find('\n', at + 1) - at);
        if (const std::size_t at = text.find("[[scenery]]"); at != std::string::npos) text.erase(at);
        REQUIRE(text != full);
        const auto program = [&](const std::string& of) {
            const Mechanism m = build(parse_scene(of, "same.toml"));
            return emit(choose(m, routh(m)).program).text;
        };
        CHECK(program(text) == program(full));
    }
}

TEST_CASE("looks: a wedge, and a block on it") {
    const double X = 0.3, s = 0.4, alpha = 0.6;
    const Drawn d = drawn("scenes/textbook/block_on_wedge.toml", {X, s});
    const std::vector<FigureElement> plates = d.of(Kind::plate);
    REQUIRE(plates.size() == 2);
    REQUIRE(plates[0].points.size() == 3);
    CHECK((d.pose[plates[0].points[0]] - Vector3d(X, 0, 0)).norm() < 1e-12);
    CHECK((d.pose[plates[0].points[1]] - Vector3d(X + 1.2 * std::cos(alpha), -1.2 * std::sin(alpha), 0)).norm() <
          1e-12);
    // Two corners of the block are on the slope, the others 0.2 above it.
    REQUIRE(plates[1].points.size() == 4);
    const Vector3d out(std::sin(alpha), std::cos(alpha), 0);
    for (int k = 0; k < 4; ++k)
        CHECK((d.pose[plates[1].points[k]] - Vector3d(X, 0, 0)).dot(out) == doctest::Approx(k < 2 ? 0 : 0.2));
    CHECK(d.of(Kind::disc).empty());
    CHECK(d.of(Kind::floor).size() == 1);
}

TEST_CASE("looks: a rope leaves a pulley along its tangents") {
    const double x = 0.2, y = -0.1;
    const Drawn d = drawn("scenes/textbook/double_atwood.toml", {x, y});
    // The upper pulley has radius 0.5 and its axle at (0, 0.2).
    CHECK(d.has_line(Kind::rope, {-0.5, -x - 1.5, 0}, {-0.5, 0.2, 0}));
    CHECK(d.has_line(Kind::rope, {0.5, 0.2, 0}, {0.5, x - 0.9, 0}));
    CHECK(d.of(Kind::pulley).size() == 2);
    const Drawn slanted =
        drawn(parse_scene("[coordinates]\nq = 0.5\n[energy]\nkinetic = \"q'^2/2\"\n[[scenery]]\npulley = 0.3\n"
                          "name = \"P\"\nat = [0, 1]\n[[scenery]]\nrope = [[\"-1 - q\", 0], \"P\", [2, -1]]\n",
                          "rope.toml"));
    REQUIRE(slanted.of(Kind::rope).size() == 2);
    const Vector3d centre(0, 1, 0);
    for (const FigureElement& piece : slanted.of(Kind::rope)) {
        const Vector3d a = slanted.pose[piece.points[0]], b = slanted.pose[piece.points[1]];
        const Vector3d touching = (a - centre).norm() < (b - centre).norm() ? a : b;
        CHECK((touching - centre).norm() == doctest::Approx(0.3));
        CHECK(std::abs((touching - centre).dot(b - a)) < 1e-9);
        CHECK(touching[1] > 1);  // over the pulley
    }
}

TEST_CASE("looks: a bead on a hoop is on no rod, and the hoop turns with its frame") {
    const Drawn d = drawn("scenes/textbook/rotating_hoop.toml");
    CHECK(d.of(Kind::rod).empty());
    REQUIRE(d.of(Kind::hoop).size() == 1);
    const FigureElement hoop = d.of(Kind::hoop)[0];
    const Vector3d u = d.pose[hoop.points[1]] - d.pose[hoop.points[0]],
                   v = d.pose[hoop.points[2]] - d.pose[hoop.points[0]];
    CHECK(u.cross(v).normalized().cwiseAbs()[1] == doctest::Approx(1));
    const Drawn plain = drawn("scenes/textbook/spherical_pendulum.toml");
    CHECK(plain.of(Kind::rod).size() == 1);
}

TEST_CASE("looks: a scene of energies has the figure of its scenery") {
    const double x = 0.7, phi = 2, r = 0.3, beta = 0.4;
    const Drawn d = drawn("scenes/textbook/rolling_disc.toml", {x, phi});
    REQUIRE(d.of(Kind::ring).size() == 1);
    const FigureElement disc = d.of(Kind::ring)[0];
    const Vector3d along(std::cos(beta), -std::sin(beta), 0), out(std::sin(beta), std::cos(beta), 0);
    CHECK((d.pose[disc.points[0]] - (x * along + r * out)).norm() < 1e-12);
    CHECK((d.pose[disc.points[1]] - d.pose[disc.points[0]] -
           r * Vector3d(std::cos(-beta - phi), std::sin(-beta - phi), 0))
              .norm() < 1e-12);
    REQUIRE(d.of(Kind::ground).size() == 1);
}

TEST_CASE("looks: faces of solids look outwards, and those that face the viewer are filled") {
    for (const char* shape : {"{ box = [1, 2, 3] }", "{ cylinder = [0.5, 1] }", "{ cone = [0.5, 1] }",
                              "{ cone = [0.5, -1], axis = \"x\" }"}) {
        CAPTURE(shape);
        const Drawn d = drawn(
            parse_scene("[coordinates]\nz = 0.5\n[parameters]\nm = 1\n[[particle]]\nname = \"P\"\nmass = \"m\"\n"
                        "position = [1, 2, \"z\"]\nshape = " +
                            std::string(shape) + "\n",
                        "solid.toml"));
        REQUIRE(d.of(Kind::solid).size() == 1);
        const FigureElement solid = d.of(Kind::solid)[0];
        Vector3d middle = Vector3d::Zero(), sum = Vector3d::Zero();
        for (const int k : solid.points) middle += d.pose[k] / static_cast<double>(solid.points.size());
        for (const std::vector<int>& face : solid.faces) {
            const auto at = [&](std::size_t k) { return d.pose[solid.points[static_cast<std::size_t>(face[k])]]; };
            Vector3d area = Vector3d::Zero();
            for (std::size_t k = 1; k + 1 < face.size(); ++k) area += (at(k) - at(0)).cross(at(k + 1) - at(0)) / 2;
            CHECK(area.dot(at(0) - middle) > 0);
            sum += area;
        }
        CHECK(sum.norm() < 1e-9);  // they close
    }
}

TEST_CASE("looks: a ladder stands on the floor and leans on the wall that its constraints or contacts say") {
    const std::string ladder =
        "gravity = [0, \"-g\"]\n[parameters]\nm = 1\ng = 9.81\nl = 2\n[coordinates]\nx = { guess = 1 }\ny = { "
        "guess = 2 }\n"
        "phi = 1.1\n[[frame]]\nname = \"L\"\nrotate = [[\"z\", \"-phi\"]]\n[[body]]\nname = \"ladder\"\nmass = "
        "\"m\"\n"
        "inertia = \"m*l^2/3\"\nframe = \"L\"\nposition = [\"x\", \"y\"]\n";
    const auto lines = [](const Drawn& d) {
        std::vector<std::pair<Vector3d, Vector3d>> found;  // a point, and the way out
        for (const FigureElement& e : d.of(Kind::floor))
            found.emplace_back(d.pose[e.points[0]], d.pose[e.points[2]] - d.pose[e.points[0]]);
        return found;
    };
    for (const char* rules : {"[[constraint]]\nname = \"floor\"\nholonomic = \"y + 1/2 - "
                              "l*sin(phi)\"\n[[constraint]]\nname = \"wall\"\nholonomic = \"x - l*cos(phi)\"\n",
                              "[[unilateral]]\nname = \"floor\"\ngap = \"y + 1/2 - "
                              "l*sin(phi)\"\n[[unilateral]]\nname = \"wall\"\ngap = \"x - l*cos(phi)\"\n"}) {
        CAPTURE(rules);
        const auto found = lines(drawn(parse_scene(ladder + rules, "ladder.toml")));
        REQUIRE(found.size() == 2);
        CHECK(found[0].first[1] == doctest::Approx(-0.5));
        CHECK((found[0].second - Vector3d(0, 1, 0)).norm() < 1e-12);
        CHECK(std::abs(found[1].first[0]) < 1e-9);
        CHECK((found[1].second - Vector3d(1, 0, 0)).norm() < 1e-12);
    }
    const std::string other = "[[constraint]]\nname = \"bond\"\nholonomic = \"x + y - l*cos(phi)\"\n";
    CHECK(lines(drawn(parse_scene(ladder + other, "ladder.toml"))).empty());
}

TEST_CASE("looks: a mass on a vertical spring hangs from a ceiling") {
    const Drawn d =
        drawn(parse_scene("gravity = [0, \"-g\"]\n[parameters]\nm = 1\ng = 9.81\nk = 10\n[coordinates]\ny = -0.3\n"
                          "[[particle]]\nname = \"P\"\nmass = \"m\"\nposition = [0, \"y\"]\n[[spring]]\nalong = "
                          "\"y\"\nstiffness = \"k\"\n",
                          "hanging.toml"));
    REQUIRE(d.of(Kind::spring).size() == 1);
    REQUIRE(d.of(Kind::wall).size() == 1);
    const FigureElement spring = d.of(Kind::spring)[0];
    CHECK(d.pose[spring.points[0]][1] > d.pose[spring.points[1]][1]);
    CHECK((d.pose[d.of(Kind::wall)[0].points[0]] - d.pose[spring.points[0]]).norm() < 1e-12);
}

TEST_CASE("looks: mistakes are told where they are") {
    const std::string start =
        "[coordinates]\nx = 0\n[parameters]\nm = 1\n[[particle]]\nname = \"P\"\nmass = \"m\"\nposition = [\"x\", "
        "0]\n";
    CHECK(mistakes_of(start + "shape = { box = 1 }\n").find("looks.toml:9") != std::string::npos);
    CHECK(mistakes_of(start + "shape = { disc = 1, ball = 2 }\n").find("both 'disc' and 'ball'") !=
          std::string::npos);
    CHECK(mistakes_of(start + "shape = { disc = \"radius\" }\n").find("'radius'") != std::string::npos);
    CHECK(mistakes_of(start + "shape = { disk = 1 }\n").find("disk") != std::string::npos);
    CHECK(mistakes_of(start + "[[scenery]]\nlabel = \"a\"\n").find("does not say what is drawn") !=
          std::string::npos);
    CHECK(mistakes_of(start + "[[scenery]]\nrope = [\"P\", \"Q\"]\n").find("'Q'") != std::string::npos);
    CHECK(mistakes_of(start + "[[scenery]]\nbox = [1, 1]\n").find("'at'") != std::string::npos);
    CHECK(mistakes_of(start + "[scenery]\nfloor = [[0, 0], [1, 0]]\n").find("[[scenery]]") != std::string::npos);
    CHECK(mistakes_of("[coordinates]\nx = 0\n[[body]]\nname = \"B\"\nmass = 1\nposition = [\"x\", 0]\ninertia = "
                      "\"from shape\"\n")
              .find("there is no 'shape'") != std::string::npos);
    CHECK(mistakes_of(start + "[[scenery]]\nrope = [\"P\", [\"2*x\", 1]]\n").empty());
    const auto tells = [&](const std::string& shape, const std::string& words) {
        CAPTURE(shape);
        const std::string told = mistakes_of(start + shape);
        CAPTURE(told);
        CHECK(told.find(words) != std::string::npos);
    };
    tells("shape = \"box\"\n", "shape = \"box\" needs 'size'");
    tells("shape = \"box\"\nsize = 1\n", "needs its sizes: size = [\"a\", \"b\"]");
    tells("shape = \"ellipsoid\"\nsize = [1, 2]\n", "needs its sizes: size = [\"a\", \"b\", \"c\"]");
    tells("shape = \"cylinder\"\nradius = 1\n", "shape = \"cylinder\" needs 'radius' and 'height'");
    tells("shape = \"disc\"\nradius = 1\nheight = 2\n", "a disc has no 'height': its sizes are 'radius'");
    tells("shape = \"disk\"\nradius = 1\n", "there is no shape 'disk'");
    tells("shape = \"polygon\"\n", "there is no shape 'polygon'");
    tells("shape = { disc = 1 }\nradius = 1\n", "leave out 'radius'");
    tells("shape = [[0, 0], [1, 0], [0, 1]]\nsize = [1, 1]\n", "leave out 'size'");
    tells("shape = [[0, 0], [1, 0]]\n", "needs its sizes");
    tells("radius = 1\n", "there is no 'shape'");
    tells("shape = \"ball\"\nradius = [1, 2]\n", "'radius'");
    tells("shape = \"ball\"\nradius = \"rho\"\n", "'rho'");
    tells("shape = 3\n", "expected a solid and its sizes");
}

}  // namespace figure_looks
