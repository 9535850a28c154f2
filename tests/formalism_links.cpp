// SPDX-License-Identifier: MIT
// The same mechanisms written in different ways: the same accelerations, and as few operations.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <random>

#include "analysis/derive/derived.hpp"
#include "link_scenes.hpp"
#include "mechanisms.hpp"
#include "model/formalism/joint_tree.hpp"
#include "model/formalism/lagrange.hpp"
#include "model/formalism/recursive.hpp"
#include "program.hpp"
#include "program/modular.hpp"

namespace formalism_links {

using namespace alembert;
using alembert::test::from_text;

namespace {

Choice fastest(const std::string& scene) {
    return lowered(derived(parse_scene(scene, "scene.toml"), {.use = Use::run}), false);
}
int operations(const std::string& scene) {
    return fastest(scene).cost.operations;
}

/// A tree of masses in a plane: which one carries each, −1 for the cart, and the signs of its sine and cosine.
struct Tree {
    std::vector<int> parent;
    std::vector<std::array<int, 2>> sign;

    int size() const { return static_cast<int>(parent.size()); }
};

Tree chain(int n) {
    Tree tree;
    for (int i = 0; i < n; ++i) {
        tree.parent.push_back(i - 1);
        tree.sign.push_back({-1, 1});
    }
    return tree;
}

Tree random_tree(int n, std::mt19937_64& random) {
    Tree tree;
    for (int i = 0; i < n; ++i) {
        tree.parent.push_back(static_cast<int>(random() % static_cast<unsigned>(i + 1)) - 1);
        tree.sign.push_back({random() % 2 == 0 ? 1 : -1, random() % 2 == 0 ? 1 : -1});
    }
    return tree;
}

std::string head(const Tree& tree, bool with_coordinates = true) {
    std::string text = "gravity = [0, \"-g\"]\n[parameters]\ng = 9.81\nm = 2\n";
    for (int i = 0; i < tree.size(); ++i) text += fmt::format("m{0} = 1.{0}\nl{0} = 0.{1}\n", i, i + 3);
    if (!with_coordinates) return text;
    text += "[coordinates]\nx = 0.2\n";
    for (int i = 0; i < tree.size(); ++i) text += fmt::format("q{} = 0.{}\n", i, i + 1);
    return text + "[[particle]]\nname = \"cart\"\nmass = \"m\"\nposition = [\"x\", \"0.1\"]\n";
}

enum class Angles { absolute, relative };

std::string angle(const Tree& tree, int i, Angles angles) {
    std::string sum = fmt::format("q{}", i);
    for (int up = tree.parent[i]; angles == Angles::relative && up >= 0; up = tree.parent[up])
        sum = fmt::format("q{}+", up) + sum;
    return sum;
}

std::array<std::string, 2> step(const Tree& tree, int i, Angles angles) {
    const auto& [s, c] = tree.sign[i];
    const std::string phi = angle(tree, i, angles);
    return {fmt::format("{}l{}*sin({})", s < 0 ? "-" : "+", i, phi),
            fmt::format("{}l{}*cos({})", c < 0 ? "-" : "+", i, phi)};
}

std::string particle(int i, const std::string& from, const std::string& x, const std::string& y) {
    return fmt::format("[[particle]]\nname = \"P{0}\"\nmass = \"m{0}\"\n{1}position = [\"{2}\", \"{3}\"]\n", i,
                       from.empty() ? "" : fmt::format("from = \"{}\"\n", from), x, y);
}

std::string from_the_one_before(const Tree& tree, Angles angles = Angles::absolute) {
    std::string text = head(tree);
    for (int i = 0; i < tree.size(); ++i) {
        const int up = tree.parent[i];
        const auto [x, y] = step(tree, i, angles);
        text += particle(i, up < 0 ? "cart" : fmt::format("P{}", up), x, y);
    }
    return text;
}

std::string from_the_origin(const Tree& tree, Angles angles = Angles::absolute) {
    std::string text = head(tree);
    std::vector<std::array<std::string, 2>> at;
    for (int i = 0; i < tree.size(); ++i) {
        const int up = tree.parent[i];
        at.push_back(up < 0 ? std::array<std::string, 2>{"x", "0.1"} : at[up]);
        const auto [x, y] = step(tree, i, angles);
        at[i] = {at[i][0] + x, at[i][1] + y};
        text += particle(i, "", at[i][0], at[i][1]);
    }
    return text;
}

std::string in_frames(const Tree& tree) {
    std::string text = head(tree);
    for (int i = 0; i < tree.size(); ++i) {
        const int up = tree.parent[i];
        const auto& [s, c] = tree.sign[i];
        text += fmt::format("[[frame]]\nname = \"F{0}\"\nrotate = [[\"z\", \"{1}q{0}\"]]\n", i, s == c ? "-" : "");
        text +=
            particle(i, up < 0 ? "cart" : fmt::format("P{}", up), "0", fmt::format("{}l{}", c < 0 ? "-" : "", i)) +
            fmt::format("axes = \"F{}\"\n", i);
    }
    return text;
}

/// The signs must be those of a chain.
std::string by_joints(const Tree& tree) {
    std::string text = head(tree, false);
    text += R"toml([[body]]
name = "cart"
mass = "m"
[[joint]]
name = "rail"
type = "prismatic"
axis = "x"
parent = "N"
parent_point = [0, 0.1, 0]
child = "cart"
coordinates = { x = 0.2 }
)toml";
    for (int i = 0; i < tree.size(); ++i)
        text += fmt::format(
            "[[body]]\nname = \"P{0}\"\nmass = \"m{0}\"\ninertia = 0\n"
            "[[joint]]\nname = \"J{0}\"\ntype = \"revolute\"\nparent = \"{1}\"\nchild = \"P{0}\"\n"
            "child_point = [0, \"-l{0}\"]\ncoordinates = {{ q{0} = 0.{2} }}\n",
            i, tree.parent[i] < 0 ? "cart" : fmt::format("P{}", tree.parent[i]), i + 1);
    return text;
}

using Residues = std::vector<Prime>;

/// Modulo 2⁶¹ − 1 at random states and parameters, which are the same for scenes with the same names.
Residues accelerations(const Program& program, std::uint64_t seed) {
    const std::vector<int> nodes = program.nodes_of(Group::acceleration);
    const auto at = evaluate_mod(program, {.seed = seed}, nodes);
    REQUIRE(at);
    Residues result;
    for (const int node : nodes) result.push_back(at->value[node]);
    return result;
}

/// In long double at random states: turned axes take angles by arcus tangents, which are unknown modulo a prime.
void check_close(const std::string& scene) {
    const Mechanism m = from_text(scene);
    const Program expected = lower(m, lagrange(m), energy_of(m)), recursion = choose(m, recursive(m)).program,
                  best = fastest(scene).program;
    const unsigned seed = 20260303;
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    for (int trial = 0; trial < 10; ++trial) {
        const State<double> at = test::random_state(start_of(m), random);
        const State<long double> state{.parameters = {at.parameters.begin(), at.parameters.end()},
                                       .t = at.t,
                                       .q = {at.q.begin(), at.q.end()},
                                       .qdot = {at.qdot.begin(), at.qdot.end()},
                                       .qddot = {}};
        const auto accelerations_of = [&](const Program& program) {
            const std::vector<long double> value = interpret(program, state);
            std::vector<long double> result;
            for (const int node : program.nodes_of(Group::acceleration)) result.push_back(value[node]);
            return result;
        };
        const std::vector<long double> a = accelerations_of(expected);
        long double largest = 0;
        for (const long double x : a) largest = std::max(largest, std::abs(x));
        for (const Program* program : {&recursion, &best}) {
            CAPTURE(program->formulation);
            const std::vector<long double> b = accelerations_of(*program);
            // Rounding of 10⁻¹⁹ times the conditioning of M, below 10⁵.
            for (std::size_t i = 0; i < a.size(); ++i) CHECK(std::abs(a[i] - b[i]) < 1e-13L * largest);
        }
    }
}

/// Do the fastest programs of the scenes accelerate as Lagrange's equations of the first, exactly, and also to
/// 10⁻¹² in doubles?
void check_same(const std::vector<std::string>& scenes) {
    const Mechanism first = from_text(scenes.at(0));
    const Program expected = lower(first, lagrange(first), energy_of(first));
    const State<double> state = start_of(first).state();
    for (const std::string& scene : scenes) {
        CAPTURE(scene);
        const Mechanism m = from_text(scene);
        const Program recursion = choose(m, recursive(m)).program, best = fastest(scene).program;
        for (const Program* program : {&recursion, &best}) {
            CAPTURE(program->formulation);
            for (const std::uint64_t seed : {1U, 2U})
                CHECK(accelerations(*program, seed) == accelerations(expected, seed));
            CHECK(test::relative_distance(test::group(*program, state, Group::acceleration),
                                          test::group(expected, state, Group::acceleration)) < 1e-12);
        }
    }
}

}  // namespace

TEST_CASE("links: a chain takes as few operations by particles, by positions from the origin and by joints") {
    for (const int n : {5, 10, 30}) {
        CAPTURE(n);
        const int joints = operations(by_joints(chain(n)));
        CHECK(joints < 70 * n);
        for (const Angles angles : {Angles::absolute, Angles::relative})
            for (const std::string& scene :
                 {from_the_one_before(chain(n), angles), from_the_origin(chain(n), angles)})
                CHECK(operations(scene) <= 1.15 * joints);
    }
    const auto [ten, twenty, thirty] =
        std::array{operations(from_the_origin(chain(10))), operations(from_the_origin(chain(20))),
                   operations(from_the_origin(chain(30)))};
    CHECK(thirty - twenty == twenty - ten);
}

TEST_CASE("links: random trees accelerate the same however they are written") {
    const unsigned seed = 20260301;
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    for (int trial = 0; trial < 8; ++trial) {
        Tree tree = random_tree(2 + trial % 4, random);
        check_same({from_the_origin(tree), from_the_one_before(tree), in_frames(tree)});
        for (auto& sign : tree.sign) sign = {-1, 1};
        check_same({from_the_origin(tree, Angles::relative), from_the_one_before(tree, Angles::relative),
                    by_joints(tree)});
    }
}

TEST_CASE("links: a tree of many masses written in three ways takes the same operations, within 15 %") {
    const unsigned seed = 20260302;
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    for (int trial = 0; trial < 3; ++trial) {
        Tree tree = random_tree(15, random);
        for (auto& sign : tree.sign) sign = {-1, 1};
        const int joints = operations(by_joints(tree));
        for (const std::string& scene : {from_the_origin(tree), from_the_one_before(tree), in_frames(tree),
                                         from_the_origin(tree, Angles::relative)})
            CHECK(operations(scene) <= 1.15 * joints);
    }
}

namespace {

const char* const rods = R"toml(gravity = [0, "-g"]
[parameters]
g = 9.81
l = 0.7
[coordinates]
x = 0.2
a = 0.3
b = -0.4
[[frame]]
name = "A"
rotate = [["z", "a"]]
[[frame]]
name = "B"
parent = "A"
rotate = [["z", "b"]]
[[particle]]
name = "cart"
mass = 2
position = ["x", 0]
[[body]]
name = "first"
mass = 1.1
frame = "A"
position = ["x + l/2*cos(a)", "l/2*sin(a)"]
inertia = 0.3
[[body]]
name = "second"
mass = 0.8
frame = "B"
position = ["x + l*cos(a) + l/2*sin(a + b)", "l*sin(a) - l/2*cos(a + b)"]
inertia = 0.2
)toml";

}  // namespace

TEST_CASE(
    "links: beads on curves, spherical pendulums and polar coordinates are a tree that accelerates as by "
    "Lagrange") {
    const Possible<JointTree> tree = joint_tree(from_text(test::on_curves));
    REQUIRE(tree.exists());
    CHECK(tree.value().joints.size() == 7);
    check_close(test::on_curves);
}

TEST_CASE("links: bodies whose mass centres are written out turn with their own frames") {
    const Possible<JointTree> tree = joint_tree(from_text(rods));
    REQUIRE(tree.exists());
    CHECK(tree.value().joints.size() == 3);
    check_same({rods});
}

namespace {

/// A chain with masses besides each other, with bodies at rest, or in a plane of space.
std::string hanging(int n, const std::string& besides, const std::string& at_rest, bool in_space) {
    std::string text = fmt::format("gravity = {}\n[parameters]\ng = 9.81\nalpha = 0.3\n",
                                   in_space ? "[0, 0, \"-g\"]" : "[0, \"-g\"]");
    for (int i = 1; i <= n; ++i) text += fmt::format("m{0} = 1\nk{0} = 0.5\nl{0} = 0.7\n", i);
    text += "[coordinates]\n";
    for (int i = 1; i <= n; ++i) text += fmt::format("q{} = 0.{}\n", i, i);
    text += at_rest;
    for (int i = 1; i <= n; ++i) {
        text += fmt::format(
            "[[particle]]\nname = \"P{0}\"\nmass = \"m{0}\"\nposition = [\"l{0}*sin(q{0})\", "
            "{1}\"-l{0}*cos(q{0})\"]\n",
            i, in_space ? "0, " : "");
        if (i > 1) text += fmt::format("from = \"P{}\"\n", i - 1);
        text += fmt::format(fmt::runtime(besides), i);
    }
    return text;
}

}  // namespace

TEST_CASE("links: masses at one point, bodies at rest and a third dimension add no operation") {
    for (const int n : {2, 4, 10}) {
        CAPTURE(n);
        const int alone = operations(hanging(n, "", "", false));
        CHECK(operations(hanging(n, "[[particle]]\nname = \"R{0}\"\nmass = \"k{0}\"\nat = \"P{0}\"\n", "",
                                 false)) == alone);
        CHECK(operations(hanging(n, "",
                                 "[[particle]]\nname = \"S\"\nmass = 3\nposition = [1, 2]\n"
                                 "[[body]]\nname = \"B\"\nmass = 2\nposition = [2, 1]\ninertia = 1\n",
                                 false)) == alone);
        CHECK(operations(hanging(n, "", "", true)) == alone);
    }
}

TEST_CASE("links: what was found is told") {
    const auto emitted = [](const std::string& scene, const std::vector<std::string>& options = {}) {
        std::vector<std::string> args{"emit", test::temporary("scene.toml", scene), "-o",
                                      test::temporary("to", "") + ".d"};
        args.insert(args.end(), options.begin(), options.end());
        const test::Run run = test::run(args);
        REQUIRE(run.exit == 0);
        return run.out;
    };
    const std::string scene = hanging(10, "[[particle]]\nname = \"R{0}\"\nmass = \"k{0}\"\nat = \"P{0}\"\n",
                                      "[[particle]]\nname = \"S\"\nmass = 3\nposition = [1, 2]\n", true);
    const std::string page = emitted(scene);
    for (const char* line :
         {"the positions of the masses are those of a tree of 10 joints\n",
          "masses at the point of another one, with which they count: R1, R2, R3, R4, R5, R6, R7, R8, R9, R10\n",
          "masses that never move, which the equations leave out: S\n",
          "all bodies move in parallel planes: the motion is planar\n"})
        CHECK(page.find(line) != std::string::npos);
    CHECK(emitted(scene, {"--language", "c"}).find("tree of 10 joints") != std::string::npos);
    CHECK(nlohmann::json::parse(emitted(scene, {"--json"}))["tree"] ==
          nlohmann::json::parse(
              R"json({"joints": 10, "in_positions": true, "at_rest": ["S"], "planar_in_space": true,
              "same_point": ["R1", "R2", "R3", "R4", "R5", "R6", "R7", "R8", "R9", "R10"]})json"));
    const std::string joints = by_joints(chain(10));
    CHECK(emitted(joints).find("positions") == std::string::npos);
    CHECK(nlohmann::json::parse(emitted(joints, {"--json"}))["tree"]["in_positions"] == false);
}

TEST_CASE("links: a plane that is tilted in space costs nothing but its gravity") {
    const std::string upright = hanging(10, "", "", true);
    std::string tilted = upright;
    const std::string first = "[[particle]]";
    for (std::size_t at = tilted.find(first); at != std::string::npos; at = tilted.find(first, at + 30))
        tilted.insert(at + first.size(), "\naxes = \"A\"");
    tilted.insert(tilted.find(first), "[[frame]]\nname = \"A\"\nrotate = [[\"x\", \"alpha\"], [\"z\", 0.2]]\n");
    CHECK(operations(tilted) <= operations(upright) + 5);
    check_close(tilted);
}

TEST_CASE("links: a chain of springs written out from the origin is a tree of as many slides as coordinates") {
    std::string text = "[parameters]\nk = 3\n[coordinates]\n", position, masses;
    for (int i = 1; i <= 10; ++i) {
        text += fmt::format("x{} = 0.{}\n", i, i);
        position += fmt::format("{}x{}", i > 1 ? " + " : "", i);
        masses += fmt::format(
            "[[particle]]\nname = \"P{0}\"\nmass = 1.{0}\nposition = [\"{1} + {0}\", 0]\n"
            "[[spring]]\nalong = \"x{0}\"\nstiffness = \"k\"\n",
            i, position);
    }
    const Possible<JointTree> tree = joint_tree(from_text(text + masses));
    REQUIRE(tree.exists());
    CHECK(tree.value().joints.size() == 10);
    check_same({text + masses});
}

}  // namespace formalism_links
