// SPDX-License-Identifier: MIT
// The derivatives of inverse dynamics in closed form: against dual numbers through the recursion of Newton and
// Euler, and against differentiated programs, exactly, modulo a prime.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <map>
#include <optional>
#include <random>

#include "mechanisms.hpp"
#include "model/formalism/inverse_partials.hpp"
#include "model/formalism/recursive.hpp"
#include "program/lower/lower.hpp"
#include "program/lower/robot_functions.hpp"
#include "program/lower/tree_functions.hpp"
#include "program/modular.hpp"
#include "program/partials.hpp"
#include "program/prime.hpp"

namespace generator_inverse_partials {

using namespace alembert;

namespace {

/// a + b ε with ε² = 0, modulo 2⁶¹ − 1.
struct Dual {
    Dual(int number = 0) : value(number) {}
    Dual(Prime a, Prime b = 0) : value(a), slope(b) {}
    friend Dual operator+(const Dual& a, const Dual& b) { return {a.value + b.value, a.slope + b.slope}; }
    friend Dual operator-(const Dual& a, const Dual& b) { return {a.value - b.value, a.slope - b.slope}; }
    friend Dual operator*(const Dual& a, const Dual& b) {
        return {a.value * b.value, a.value * b.slope + a.slope * b.value};
    }
    friend Dual operator/(const Dual& a, const Dual& b) {  // by constants
        return {a.value * b.value.inverse(), a.slope * b.value.inverse()};
    }
    Dual operator-() const { return {-value, -slope}; }

    Prime value, slope = 0;
};

class RandomTree {
public:
    explicit RandomTree(std::uint64_t seed) : random_(seed) {}

    /// Each link on one of the three before it or on the ground; oblique axes and turns about x; some slide.
    BodyTree<Dual> of(int n) {
        BodyTree<Dual> tree{.links = {}, .gravity = vector()};
        for (int j = 0; j < n; ++j) {
            TreeLink<Dual> link{.parent = std::max(-1, j - 1 - below(3)), .slides = below(4) == 0};
            link.about_x = below(2) == 0;
            link.R = link.about_x ? turn(any(), any(), 0, 0) : turn(any(), any(), any(), any());
            link.p = vector();
            if (link.slides) {
                link.slide = vector();
                link.shift = any();
            } else {
                const Matrix<Dual> turned = turn(any(), 0, 0, any());
                link.cosine = turned[0][0];
                link.sine = turned[1][0];
            }
            link.rate = any();
            link.bias = any();
            link.body.mass = any();
            link.body.first = vector();
            for (Dual& moment : link.body.second) moment = any();
            tree.links.push_back(link);
        }
        return tree;
    }

private:
    Prime any() { return Prime::from_bits(random_() >> 4); }
    int below(int n) { return static_cast<int>(random_() % static_cast<std::uint64_t>(n)); }
    Triple<Dual> vector() { return {any(), any(), any()}; }
    static Matrix<Dual> turn(Prime w, Prime x, Prime y, Prime z) {
        const Prime k = Prime(2) * (w * w + x * x + y * y + z * z).inverse();
        const auto one = [&](Prime a, Prime b) { return Dual(Prime(1) - k * (a * a + b * b)); };
        const auto two = [&](Prime ab, Prime wc) { return Dual(k * (ab + wc)); };
        return {Triple<Dual>{one(y, z), two(x * y, -(w * z)), two(x * z, w * y)},
                Triple<Dual>{two(x * y, w * z), one(x, z), two(y * z, -(w * x))},
                Triple<Dual>{two(x * z, -(w * y)), two(y * z, w * x), one(x, y)}};
    }

    std::mt19937_64 random_;
};

std::vector<Dual> loads(const BodyTree<Dual>& tree) {
    return joint_loads(tree, Bias<Dual>(tree).wrenches);
}

}  // namespace

TEST_CASE("inverse partials: on random trees they are those of dual numbers, whichever link's axes are common") {
    for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
        CAPTURE(seed);
        constexpr int n = 7;
        const BodyTree<Dual> tree = RandomTree(seed).of(n);
        std::vector<std::vector<Dual>> by_position, by_rate;  // a row for each joint that changes
        for (std::size_t k = 0; k < n; ++k) {
            BodyTree<Dual> moved = tree, faster = tree;
            TreeLink<Dual>& link = moved.links[k];
            if (link.slides) {
                link.shift.slope = 1;
            } else {
                link.cosine.slope = -link.sine.value;
                link.sine.slope = link.cosine.value;
            }
            faster.links[k].rate.slope = 1;
            by_position.push_back(loads(moved));
            by_rate.push_back(loads(faster));
        }
        for (int common = -1; common < n; ++common) {
            CAPTURE(common);
            const InversePartials<Dual> by(tree, common);
            for (std::size_t i = 0; i < n; ++i)
                for (std::size_t k = 0; k < n; ++k) {
                    CAPTURE(i);
                    CAPTURE(k);
                    CHECK(by.position[i][k].value == by_position[k][i].slope);
                    CHECK(by.rate[i][k].value == by_rate[k][i].slope);
                }
        }
    }
}

namespace {

/// Turns about oblique axes, a slide and a point that is moved; the second frame counts from the ground, so that
/// its joint's rate is a difference.
constexpr const char* mixed = R"toml(
gravity = [0, "-g", 0]
[parameters]
m = 1.5
l = 0.7
g = 9.81
[coordinates]
a = { initial = 0.3, rate = 1 }
b = { initial = 0.4, rate = -1 }
x = { initial = 0.2, rate = 2 }
d = { initial = -0.5, rate = 1 }
[[frame]]
name = "A"
rotate = [["z", "a"]]
[[frame]]
name = "B"
rotate = [["z", "b"]]
[[frame]]
name = "D"
parent = "B"
rotate = [["x", 0.5], ["z", "d"]]
[[point]]
name = "P"
offset = ["l", 0, "0.1*sin(2*t)"]
axes = "A"
[[point]]
name = "S"
from = "P"
offset = ["x", "l", "0.2"]
axes = "B"
[[body]]
name = "first"
mass = "m"
frame = "A"
position = ["l/2", "0.1", "0.2"]
axes = "A"
inertia = { xx = 0.1, yy = 0.2, zz = 0.25, xy = 0.01 }
[[body]]
name = "second"
mass = "2*m"
frame = "B"
from = "P"
position = ["l/3", "0.2", "-0.1"]
axes = "B"
inertia = { xx = 0.3, yy = 0.2, zz = 0.35, yz = 0.02 }
[[body]]
name = "third"
mass = "m/2"
frame = "D"
from = "S"
position = ["0.1", "0.3", "l"]
axes = "D"
inertia = { xx = 0.15, yy = 0.22, zz = 0.25, zx = 0.03 }
)toml";

/// The derivatives of the loads by q and q', by elimination.
std::vector<int> eliminated(Program& program, const std::vector<int>& loads, int size) {
    const auto n = static_cast<std::size_t>(size);
    std::vector<int> inputs;
    for (const auto kind : {Variable::Kind::coordinate, Variable::Kind::rate})
        for (int i = 0; i < size; ++i) inputs.push_back(program.variable({kind, i}));
    const auto slopes = partials(program, loads, inputs, EliminationOrder::least_fill);
    REQUIRE(slopes);
    std::vector<int> values(n * 2 * n, program.number(0));
    for (const Partial& p : *slopes)
        values[static_cast<std::size_t>(p.output) * 2 * n + static_cast<std::size_t>(p.input)] = p.node;
    return values;
}

/// In closed form, if there is one, and by differentiating the recursion.
struct BothWays {
    BothWays(const Mechanism& m, const JointTree& joints) : program(begun(m)) {
        const auto lowering = lowering_into(program, m);
        const TreeFunctions tree(program, joints, LinkAxes::own, *m.z, lowering);
        closed = tree.inverse_partials();
        if (closed) expected = eliminated(program, tree.loads(TreeFunctions::Terms::inverse), m.size());
    }
    Program program;
    std::optional<std::vector<int>> closed;
    std::vector<int> expected;
};

}  // namespace

TEST_CASE("inverse partials: in closed form they are those of the differentiated recursion, modulo a prime") {
    std::map<std::string, Mechanism> list{{"mixed", test::from_text(mixed)}};
    for (const char* file : {"benchmark/trees/arm7_symbols", "benchmark/trees/pend4", "gallery/six_joint_arm",
                             "gallery/furuta_joints", "gallery/universal_double_pendulum",
                             "textbook/elastic_pendulum", "textbook/double_pendulum"})
        list.emplace(file, prepared(read_scene(test::source_path(fmt::format("scenes/{}.toml", file)))).mechanism);
    for (const auto& [name, given] : list) {
        CAPTURE(name);
        const Mechanism m = with_own_intermediates(given);
        const Possible<JointTree> joints = loaded_tree(m);
        REQUIRE(joints.exists());
        const BothWays both(m, joints.value());
        REQUIRE(both.closed);
        const std::vector<int>& closed = *both.closed;
        REQUIRE(closed.size() == both.expected.size());
        std::vector<int> all = closed;
        all.insert(all.end(), both.expected.begin(), both.expected.end());
        for (const std::uint64_t seed : {1U, 2U}) {
            const auto x = evaluate_mod(both.program, {.seed = seed}, all);
            REQUIRE(x);
            for (std::size_t i = 0; i < closed.size(); ++i) {
                CAPTURE(i);
                CHECK(x->value[closed[i]] == x->value[both.expected[i]]);
            }
        }
    }
}

TEST_CASE("inverse partials: there are none in closed form for quaternions and for links that slide on curves") {
    for (const char* file : {"textbook/heavy_top_quaternion", "textbook/bead_on_parabola"}) {
        CAPTURE(file);
        const Mechanism m = with_own_intermediates(
            prepared(read_scene(test::source_path(fmt::format("scenes/{}.toml", file)))).mechanism);
        const Possible<JointTree> joints = loaded_tree(m);
        REQUIRE(joints.exists());
        CHECK(!BothWays(m, joints.value()).closed);
    }
}

TEST_CASE(
    "inverse partials: with drives and rotors those of a robot are emitted in closed form, for fewer operations") {
    for (const char* file : {"scenes/benchmark/trees/arm7_symbols", "tests/odd/armature"}) {
        CAPTURE(file);
        const Mechanism m = prepared(read_scene(test::source_path(fmt::format("{}.toml", file)))).mechanism;
        const RobotFunctions functions(m, false);
        const Program emitted = functions.dynamics("inverse_jacobian").program;
        const std::vector<int> values = emitted.nodes_of(Group::function);
        Program other = functions.dynamics("inverse").program;
        const std::vector<int> expected = eliminated(other, other.nodes_of(Group::function), m.size());
        CHECK(emitted.count(values).total() < other.count(expected).total());
        REQUIRE(values.size() == expected.size());
        for (const std::uint64_t seed : {1U, 2U}) {
            const auto x = evaluate_mod(emitted, {.seed = seed}, values),
                       y = evaluate_mod(other, {.seed = seed}, expected);
            REQUIRE(x);
            REQUIRE(y);
            for (std::size_t i = 0; i < values.size(); ++i) {
                CAPTURE(i);
                CHECK(x->value[values[i]] == y->value[expected[i]]);
            }
        }
    }
}

}  // namespace generator_inverse_partials
