// SPDX-License-Identifier: MIT
// Initial values are held against constraints whose terms are measured before they cancel: loops of four bars,
// turned and moved anywhere, whose angles are solved here in long double and written with 16 digits.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <random>

#include "alembert/base/error.hpp"
#include "analysis/state/assemble.hpp"
#include "analysis/state/prepared.hpp"
#include "program/lower/lower.hpp"
#include "program/rounding.hpp"
#include "scenes.hpp"

namespace start_sizes {

using namespace alembert;

namespace {

struct Bars {
    std::array<long double, 4> length;  ///< of the ground, the crank, the coupler and the rocker
    std::array<long double, 3> q, rate;
};

/// Closes the loop l2 e(q1) + l3 e(q1 + q2) + l4 e(q1 + q2 + q3) = (l1, 0) for the given crank, and its rates.
bool close(Bars& b) {
    using Vector = Eigen::Matrix<long double, 2, 1>;
    using Matrix = Eigen::Matrix<long double, 2, 2>;
    const auto sides = [&] {
        std::array<long double, 3> angle{b.q[0], b.q[0] + b.q[1], b.q[0] + b.q[1] + b.q[2]};
        std::array<Vector, 3> side;
        for (std::size_t k = 0; k < 3; ++k)
            side[k] = b.length[k + 1] * Vector(std::cos(angle[k]), std::sin(angle[k]));
        return side;
    };
    const auto turned = [](const Vector& v) { return Vector(-v[1], v[0]); };
    for (int round = 0; round < 60; ++round) {
        const auto s = sides();
        Matrix J;
        J << turned(s[1] + s[2]), turned(s[2]);
        const Vector off = s[0] + s[1] + s[2] - Vector(b.length[0], 0);
        if (std::abs(J.determinant()) < 1e-3L) return false;
        const Vector step = J.inverse() * off;
        b.q[1] -= step[0], b.q[2] -= step[1];
        const Vector rates = -J.inverse() * turned(s[0] + s[1] + s[2]) * b.rate[0];
        b.rate[1] = rates[0], b.rate[2] = rates[1];
        if (step.norm() < 1e-18L) return true;
    }
    return false;
}

struct Frame {
    Eigen::Vector3d angles, offset;
    Eigen::Matrix3d turn() const {
        return (Eigen::AngleAxisd(angles[0], Eigen::Vector3d::UnitX()) *
                Eigen::AngleAxisd(angles[1], Eigen::Vector3d::UnitY()) *
                Eigen::AngleAxisd(angles[2], Eigen::Vector3d::UnitZ()))
            .toRotationMatrix();
    }
    std::string rotate() const {
        return fmt::format(R"([["x", {:.17g}], ["y", {:.17g}], ["z", {:.17g}]])", angles[0], angles[1], angles[2]);
    }
};

/// The last joint closes the loop.
std::string loop(const Bars& b, const Frame& f) {
    const auto number = [](long double x) { return fmt::format("{:.16g}", static_cast<double>(x)); };
    const auto point = [](const Eigen::Vector3d& p) {
        return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", p[0], p[1], p[2]);
    };
    const Eigen::Vector3d far = f.offset + f.turn() * Eigen::Vector3d(static_cast<double>(b.length[0]), 0, 0);
    std::string text;
    for (int k = 0; k < 3; ++k)
        text += fmt::format("[[body]]\nname = \"k{}\"\nmass = 1\ninertia = [0.1, 0.2, 0.2]\n", k);
    for (int k = 0; k < 4; ++k) {
        const bool first = k == 0, last = k == 3;
        text += fmt::format("[[joint]]\nname = \"J{}\"\ntype = \"revolute\"\nparent = \"{}\"\nchild = \"{}\"\n", k,
                            first ? "N" : fmt::format("k{}", k - 1), last ? "N" : fmt::format("k{}", k));
        text += fmt::format("parent_point = {}\nchild_point = {}\n",
                            first ? point(f.offset) : fmt::format("[\"{}/2\", 0, 0]", number(b.length[k])),
                            last ? point(far) : fmt::format("[\"-{}/2\", 0, 0]", number(b.length[k + 1])));
        if (first) text += "parent_rotate = " + f.rotate() + "\n";
        if (last) text += "child_rotate = " + f.rotate() + "\n";
        if (!last)
            text += fmt::format("coordinates = {{ q{} = {{ initial = {}, rate = {} }} }}\n", k, number(b.q[k]),
                                number(b.rate[k]));
    }
    return text;
}

Mechanism mechanism_of(const std::string& text) {
    Scene scene = parse_scene(text, "loop.toml");
    scene.on_warning = [](const Warning&) {};
    return prepared(std::move(scene)).mechanism;
}

/// The message, or nothing where the initial values are taken; `wrong` is added to the second coordinate.
std::string refusal(const Mechanism& m, double wrong = 0) {
    Start start = start_of(m);
    if (wrong != 0) start.q.at(1) += wrong;
    try {
        assemble(start, m, lower_constraints(m), {});
    } catch (const ModelError& e) {
        return e.what();
    }
    return "";
}

}  // namespace

TEST_CASE("start: loops with 16 digits are taken wherever they stand, and refused with 6 digits") {
    const unsigned seed = 20261126;
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> any(-1, 1), length(0.1, 0.5);
    int loops = 0;
    while (loops < 16) {
        Bars b{.length = {length(random), length(random), length(random), length(random)},
               .q = {3 * any(random), any(random) + 1.5, any(random) + 1.5},
               .rate = {2 * any(random), 0, 0}};
        // Lengths as they are written.
        for (long double& l : b.length) l = std::stod(fmt::format("{:.16g}", static_cast<double>(l)));
        b.q[0] = std::stod(fmt::format("{:.16g}", static_cast<double>(b.q[0])));
        if (!close(b)) continue;
        ++loops;
        CAPTURE(loops);
        const Frame f{3 * Eigen::Vector3d(any(random), any(random), any(random)),
                      std::pow(10.0, 2 * (loops % 4)) * Eigen::Vector3d(any(random), any(random), any(random))};
        CHECK(refusal(mechanism_of(loop(b, f))) == "");
        // 1e-9 of the sizes, at the origin; half a metre and four angles at the most.
        const Frame here{f.angles, {0, 0, 0}};
        const Mechanism m = mechanism_of(loop(b, here));
        CHECK(refusal(m) == "");
        CHECK(refusal(m, 1e-6).find("off by") != std::string::npos);
    }
}

TEST_CASE("start: constraints whose terms cancel within products and functions") {
    const auto scene = [](const std::string& constraint, const std::string& off) {
        return fmt::format(R"toml(
[coordinates]
a = {{ initial = 0.7 }}
x = {{ initial = "0.1 + {}", rate = 0.3 }}
y = {{ initial = 0.2, rate = 0.4 }}
z = {{ initial = 0.3, rate = "0.7 + {}" }}
[[particle]]
name = "P"
mass = 1
position = ["x", "y", "z"]
[[body]]
name = "B"
mass = 1
inertia = 1
position = [0, 0]
frame = "F"
[[frame]]
name = "F"
rotate = [["z", "a"]]
[[constraint]]
name = "c"
{}
)toml",
                           off, off, constraint);
    };
    // Each is off by some 1e-10 of the sizes of its terms, then by 1e-7.
    for (const char* constraint :
         {"holonomic = \"cos(a)*(x + y - z)\"", "holonomic = \"sin(x + y - z)\"",
          "holonomic = \"(x + y - z)*exp(a)/7\"", "holonomic = \"sqrt(1 + (x + y - z)) - 1\"",
          "nonholonomic = \"cos(a)*(x' + y' - z')\"",
          "nonholonomic = \"sin(a)*(x' + y' - z') + a'*(x + y - z)\""}) {
        CAPTURE(constraint);
        CHECK(refusal(mechanism_of(scene(constraint, "1e-10"))) == "");
        CHECK(refusal(mechanism_of(scene(constraint, "1e-7"))).find("off by") != std::string::npos);
    }
}

TEST_CASE("start: the size of terms is that before they cancel") {
    Program program;
    program.coordinates = {{"phi", ""}, {"x", ""}, {"y", ""}, {"z", ""}};
    std::vector<int> q;
    for (int i = 0; i < 4; ++i) q.push_back(program.variable({Variable::Kind::coordinate, i}));
    const int sum = program.sum(0, {{1, q[1]}, {1, q[2]}, {-1, q[3]}}),
              product = program.product(1, {{program.call(Op::cos, {q[0]}), 1}, {sum, 1}}),
              squared = program.product(1, {{sum, 2}}), sine = program.call(Op::sin, {sum}),
              alone = program.call(Op::sin, {q[0]}), twice = program.sum(0, {{2, product}, {3, q[0]}});
    const std::vector<double> size =
        sizes_of_terms(program, {.parameters = {}, .q = {0.7, 0.1, 0.2, 0.3}, .qdot = {}, .qddot = {}});
    const auto of = [&](int node) { return size[static_cast<std::size_t>(node)]; };
    CHECK(of(sum) == doctest::Approx(0.6).epsilon(1e-14));
    CHECK(of(product) == doctest::Approx(0.6 * std::cos(0.7)).epsilon(1e-14));
    CHECK(of(squared) == doctest::Approx(0.36).epsilon(1e-14));
    CHECK(of(sine) == doctest::Approx(0.6).epsilon(1e-14));
    CHECK(of(alone) == doctest::Approx(std::sin(0.7)).epsilon(1e-14));
    CHECK(of(twice) == doctest::Approx(1.2 * std::cos(0.7) + 2.1).epsilon(1e-14));
}

}  // namespace start_sizes
