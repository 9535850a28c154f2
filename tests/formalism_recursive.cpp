// SPDX-License-Identifier: MIT
// Composite and articulated bodies in every form against Lagrange's equations (exactly, modulo a prime), against
// accelerations computed elsewhere, and against each other over doubles.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <random>

#include "analysis/agree/agree.hpp"
#include "analysis/state/prepared.hpp"
#include "codegen/emit/emit.hpp"
#include "link_scenes.hpp"
#include "mechanisms.hpp"
#include "model/formalism/articulated_tree.hpp"
#include "model/formalism/joint_tree.hpp"
#include "model/formalism/lagrange.hpp"
#include "model/formalism/recursive.hpp"
#include "program/flatten.hpp"
#include "program/lower/choose.hpp"
#include "program/modular.hpp"

namespace formalism_recursive {

using namespace alembert;
using alembert::test::from_text;

namespace {

/// By expressions (no form), and by the recursions over nodes.
std::vector<Program> programs(const Mechanism& m, const Equations& e, bool composite = true) {
    const Energy energy = energy_of(m);
    std::vector<Program> result;
    if (composite) result.push_back(lower(m, e, energy));
    using Solve = RecursionForm::Solve;
    for (const Solve solve : {Solve::matrix, Solve::articulated})
        for (const LinkAxes axes : {LinkAxes::own, LinkAxes::still})
            if (composite || solve != Solve::matrix)
                result.push_back(lower(m, e, energy, {.recursion = RecursionForm{axes, solve}}));
    if (is_planar_chain(*e.tree))
        result.push_back(lower(m, e, energy, {.recursion = RecursionForm{LinkAxes::still, Solve::both_ends}}));
    result.push_back(flattened(result.back()));
    return result;
}

/// The same accelerations, modulo 2⁶¹ − 1 at random states and parameters: a difference of degree d is missed with
/// d·2⁻⁶¹.
void check_exactly(const Mechanism& m) {
    const Equations e = recursive(m);
    const Program expected = lower(m, lagrange(m), energy_of(m));
    REQUIRE(e.tree);
    const std::vector<int> a = expected.nodes_of(Group::acceleration);
    for (const Program& program : programs(m, e)) {
        CAPTURE(program.formulation);
        const std::vector<int> b = program.nodes_of(Group::acceleration);
        REQUIRE(a.size() == b.size());
        for (const std::uint64_t seed : {1U, 2U, 3U}) {
            const auto x = evaluate_mod(expected, {.seed = seed}, a), y = evaluate_mod(program, {.seed = seed}, b);
            REQUIRE(x);
            REQUIRE(y);
            for (std::size_t i = 0; i < a.size(); ++i) CHECK(x->value[a[i]] == y->value[b[i]]);
        }
    }
}

std::string chain(int n) {
    std::string text = "gravity = [0, 9.81]\n[parameters]\nm = 1\nl = 0.7\n[coordinates]\n";
    for (int k = 1; k <= n; ++k) text += fmt::format("q{} = 0.3\n", k);
    for (int k = 1; k <= n; ++k) {
        const std::string up = k > 1 ? fmt::format("R{}", k - 1) : "N",
                          from = k > 1 ? fmt::format("J{}", k - 1) : "O";
        text += fmt::format("[[frame]]\nname = \"R{0}\"\nparent = \"{1}\"\nrotate = [[\"z\", \"q{0}\"]]\n", k, up);
        text += fmt::format("[[point]]\nname = \"J{0}\"\nfrom = \"{1}\"\noffset = [0, \"l\"]\naxes = \"R{0}\"\n",
                            k, from);
        text += fmt::format(
            "[[body]]\nname = \"B{0}\"\nmass = \"m\"\nframe = \"R{0}\"\nfrom = \"{1}\"\nposition = [0.1, "
            "\"l/2\"]\naxes = \"R{0}\"\ninertia = \"m*l^2/12\"\n",
            k, from);
    }
    return text;
}

/// A tree in space: every third body hangs on the one before the last. Every joint but the second may have a
/// rotor.
std::string tree_in_space(int n, bool with_rotors = false) {
    std::string text = "gravity = [1, 2, -9.81]\n";
    for (int k = 1; k <= n; ++k) {
        const int up = k % 3 == 0 ? k - 2 : k - 1;
        text += fmt::format(
            "[[body]]\nname = \"B{}\"\nmass = 1.5\ninertia = {{ xx = 0.3, yy = 0.2, zz = 0.25, xy = 0.01, yz = "
            "-0.02, zx = 0.03 }}\n",
            k);
        text += fmt::format(
            "[[joint]]\nname = \"J{0}\"\ntype = \"revolute\"\nparent = \"{1}\"\nchild = \"B{0}\"\nparent_point = "
            "[0.1, 0.2, 0.3]\n"
            "child_point = [-0.2, 0.1, -0.3]\naxis = \"{2}\"\ncoordinates = {{ q{0} = {{ initial = 0.2 }} }}\n",
            k, up > 0 ? fmt::format("B{}", up) : "N", "xyz"[k % 3]);
        if (with_rotors && k != 2) text += fmt::format("armature = {{ q{0} = 0.{0} }}\n", k);
    }
    return text;
}

const char* const absolute_frames = R"toml(gravity = [0, "g"]
[parameters]
m = 1
l = 0.8
g = 9.81
k = 3
[coordinates]
x = 0.1
a = 0.3
b = -0.2
c = 0.4
s = 1.2
[[point]]
name = "P"
offset = ["x", 0]
[[particle]]
name = "cart"
mass = 2
at = "P"
[[frame]]
name = "A"
rotate = [["z", "a"]]
[[frame]]
name = "B"
rotate = [["z", "b"]]
[[frame]]
name = "C"
parent = "A"
rotate = [["z", "2*c"]]
[[body]]
name = "rod"
mass = "m"
frame = "A"
from = "P"
position = ["l/2", 0.1]
axes = "A"
inertia = 0.2
[[point]]
name = "E"
from = "P"
offset = ["l", 0]
axes = "A"
[[body]]
name = "branch"
mass = 0.7
frame = "B"
from = "E"
position = [0.3, -0.1]
axes = "B"
inertia = 0.1
[[body]]
name = "other"
mass = 0.9
frame = "C"
from = "E"
position = [0.2, 0.15]
axes = "C"
inertia = 0.3
[[point]]
name = "F"
from = "E"
offset = ["s", 0.2]
axes = "C"
[[particle]]
name = "slider"
mass = 0.4
at = "F"
[[spring]]
between = ["O", "F"]
stiffness = "k"
[[damper]]
along = "a - b"
damping = 0.3
[[force]]
at = "F"
vector = [1, "2*sin(t)"]
[forces]
b = "0.5 - b'"
)toml";

const char* const oblique = R"toml(gravity = [0.5, "g", -3]
[parameters]
m = 1
g = 9.81
h = 0.3
[[body]]
name = "base"
mass = 2
inertia = [0.4, 0.5, 0.6]
[[joint]]
name = "turntable"
type = "cylindrical"
parent = "N"
child = "base"
child_point = [0.2, 0, "h"]
axis = [1, 2, 2]
coordinates = { q1 = { initial = 0.2 }, q2 = { initial = 0.1 } }
[[body]]
name = "arm"
mass = "m"
inertia = { xx = 0.3, yy = 0.2, zz = 0.25, xy = 0.01, yz = -0.02, zx = 0.03 }
[[joint]]
name = "cross"
type = "universal"
parent = "base"
child = "arm"
parent_point = ["h", 0.1, 0]
child_point = [0, -0.4, 0.1]
parent_rotate = [["y", "pi/3"]]
child_rotate = [["x", 0.4]]
coordinates = { q3 = { initial = 0.3 }, q4 = { initial = -0.5 } }
[[body]]
name = "rod"
mass = 0.6
inertia = [0.1, 0.02, 0.1]
[[joint]]
name = "rail"
type = "prismatic"
parent = "arm"
child = "rod"
parent_point = [0, 0.5, 0]
axis = "y"
coordinates = { q5 = { initial = 0.3 } }
[[body]]
name = "fan"
mass = 0.3
inertia = [0.01, 0.01, 0.02]
[[joint]]
name = "axle"
type = "revolute"
parent = "base"
child = "fan"
parent_point = [0, 0.1, 0.7]
axis = "x"
coordinates = { q6 = { initial = 0 } }
[[frame]]
name = "blade"
parent = "fan"
rotate = [["x", "0.3"], ["z", "5*t"]]
[[body]]
name = "wobbler"
mass = 0.05
frame = "blade"
from = "fan"
position = [0, 0.2, 0]
axes = "blade"
inertia = [0.001, 0.002, 0.003]
)toml";

// The angles of aligned axes are arcus tangents, which arithmetic modulo a prime does not know: exactly by
// expressions, in long double by nodes.
void check_in_long_double(const std::string& scene) {
    const Mechanism m = from_text(scene);
    const Equations e = recursive(m);
    CHECK(agree({lagrange(m), e}, m).verdict == Agreement::Verdict::proved);
    const Program expected = lower(m, lagrange(m), energy_of(m));
    const unsigned seed = 20260102;
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    for (int trial = 0; trial < 10; ++trial) {
        const State<double> at = test::random_state(start_of(m), random);
        State<long double> state{.parameters = {at.parameters.begin(), at.parameters.end()},
                                 .t = at.t,
                                 .q = {at.q.begin(), at.q.end()},
                                 .qdot = {at.qdot.begin(), at.qdot.end()},
                                 .qddot = {}};
        const auto accelerations = [&](const Program& program) {
            const std::vector<long double> value = interpret(program, state);
            std::vector<long double> result;
            for (const int node : program.nodes_of(Group::acceleration)) result.push_back(value[node]);
            return result;
        };
        const std::vector<long double> a = accelerations(expected);
        long double largest = 0;
        for (const long double x : a) largest = std::max(largest, std::abs(x));
        for (const Program& program : programs(m, e)) {
            CAPTURE(program.formulation);
            const std::vector<long double> b = accelerations(program);
            // Rounding of 10⁻¹⁹ times the conditioning of M, below 10⁴.
            for (std::size_t i = 0; i < a.size(); ++i) CHECK(std::abs(a[i] - b[i]) < 1e-14L * largest);
        }
    }
}

}  // namespace

TEST_CASE(
    "recursive: a branched planar mechanism with a cart, a slider and frames turned against N accelerates as by "
    "Lagrange, exactly") {
    check_exactly(from_text(absolute_frames));
}

TEST_CASE(
    "recursive: oblique, universal, cylindrical and sliding joints and a prescribed turn accelerate as by "
    "Lagrange") {
    check_in_long_double(oblique);
}

TEST_CASE("recursive: every form follows points on curves and positions at sines and cosines as Lagrange does") {
    check_in_long_double(test::on_curves);
}

TEST_CASE("recursive: chains and trees accelerate as by Lagrange, exactly") {
    check_exactly(from_text(chain(4)));
    check_exactly(from_text(tree_in_space(5)));
    check_exactly(from_text(tree_in_space(5, true)));
    for (const char* name :
         {"scenes/gallery/gimballed_gyroscope.toml", "scenes/gallery/universal_double_pendulum.toml",
          "scenes/textbook/double_pendulum_joints.toml"}) {
        CAPTURE(name);
        const Mechanism m = prepared(read_scene(test::source_path(name))).mechanism;
        if (m.constraints.empty()) check_exactly(m);
        CHECK(agree({lagrange(m), recursive(m)}, m).verdict == Agreement::Verdict::proved);
    }
}

TEST_CASE("recursive: closed loops keep their multipliers") {
    for (const char* name : {"slider_crank_joints", "four_bar_joints"}) {
        CAPTURE(name);
        const Mechanism m =
            prepared(read_scene(test::source_path(fmt::format("scenes/gallery/{}.toml", name)))).mechanism;
        const Derivations all = derive_all(m);
        CHECK(std::any_of(all.equations.begin(), all.equations.end(),
                          [](const Equations& e) { return e.formalism == "recursive"; }));
        CHECK(agree(all.equations, m).verdict == Agreement::Verdict::proved);
    }
}

TEST_CASE("recursive: every form gives the accelerations of trees of bodies that were computed elsewhere") {
    int compared = 0;
    for (const test::ReferenceTree& tree : test::reference_trees()) {
        CAPTURE(tree.name);
        const Mechanism m = tree.mechanism();
        const State<double> state = start_of(m).state();
        for (const Program& program : programs(m, recursive(m), tree.accelerations.size() <= 16)) {
            CAPTURE(program.formulation);
            CHECK(test::relative_distance(test::group(program, state, Group::acceleration), tree.accelerations) <
                  1e-12);
            ++compared;
        }
    }
    CHECK(compared == 6 * 5 + 2 + 5 + 7);  // five of the trees are chains in a plane; each has a flattened form
}

TEST_CASE("recursive: the operations of articulated bodies grow linearly with the bodies") {
    const auto operations = [](const std::string& text, LinkAxes axes) {
        const Mechanism m = from_text(text);
        const Program p = lower(m, recursive(m), energy_of(m),
                                {.recursion = RecursionForm{axes, RecursionForm::Solve::articulated}});
        return p.count(p.right_hand_side()).total();
    };
    for (const LinkAxes axes : {LinkAxes::own, LinkAxes::still}) {
        const int eight = operations(chain(8), axes), sixteen = operations(chain(16), axes),
                  twentyfour = operations(chain(24), axes);
        CHECK(twentyfour - sixteen == sixteen - eight);
    }
    // The pattern of axes and branches repeats every three bodies.
    const int nine = operations(tree_in_space(9), LinkAxes::own),
              eighteen = operations(tree_in_space(18), LinkAxes::own),
              all = operations(tree_in_space(27), LinkAxes::own);
    CHECK(all - eighteen == eighteen - nine);
}

TEST_CASE("recursive: the accelerations are the same without the mass matrix") {
    for (const std::string& text : {chain(5), tree_in_space(6)}) {
        const Mechanism m = from_text(text);
        const Program expected = lower(m, lagrange(m), energy_of(m)),
                      found = choose(m, recursive_without_matrix(m)).program;
        CHECK(found.nodes_of(Group::mass).empty());
        CHECK(emit(found).text.find("void mass_forcing") == std::string::npos);
        const std::vector<int> a = expected.nodes_of(Group::acceleration), b = found.nodes_of(Group::acceleration);
        REQUIRE(a.size() == b.size());
        const auto x = evaluate_mod(expected, {.seed = 5}, a), y = evaluate_mod(found, {.seed = 5}, b);
        REQUIRE(x);
        REQUIRE(y);
        for (std::size_t i = 0; i < a.size(); ++i) CHECK(x->value[a[i]] == y->value[b[i]]);
    }
}

TEST_CASE("recursive: over doubles, articulated bodies undo composite bodies, with and without regrouped bodies") {
    const unsigned seed = 20260101;
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> number(-1, 1);
    const auto triple = [&] { return Triple<double>{number(random), number(random), number(random)}; };
    for (int trial = 0; trial < 20; ++trial) {
        BodyTree<double> tree{.links = {}, .gravity = triple()};
        for (int j = 0; j < 9; ++j) {
            TreeLink<double> link{.parent = j == 0 ? -1 : static_cast<int>(random() % static_cast<unsigned>(j)),
                                  .slides = random() % 3 == 0,
                                  .p = triple(),
                                  .slide = triple()};
            const double a = number(random), b = number(random), c = number(random);
            const Matrix<double> turn{Triple<double>{std::cos(a), -std::sin(a), 0},
                                      Triple<double>{std::sin(a), std::cos(a), 0}, Triple<double>{0, 0, 1}};
            link.R = turn * Matrix<double>{Triple<double>{1, 0, 0}, Triple<double>{0, std::cos(b), -std::sin(b)},
                                           Triple<double>{0, std::sin(b), std::cos(b)}};
            link.cosine = std::cos(c);
            link.sine = std::sin(c);
            link.shift = number(random);
            link.rate = number(random);
            link.bias = number(random);
            for (int k = 0; k < 3; ++k) {  // three points of mass
                const Triple<double> r = triple();
                const double m = 1 + number(random) / 2;
                RigidBody<double> point{.mass = m};
                link.body = link.body + shifted(point, r);
            }
            tree.links.push_back(link);
        }
        const BodyTree<double> fewer = regrouped(tree);
        const auto wrenches = Bias<double>(tree).wrenches, same = Bias<double>(fewer).wrenches;
        const auto n = joint_loads(tree, wrenches), also = joint_loads(fewer, same);
        const auto M = composite_bodies(tree), less = composite_bodies(fewer);
        std::vector<double> Q;
        for (int j = 0; j < tree.size(); ++j) Q.push_back(number(random));
        for (const auto& rates : {articulated_bodies(tree, wrenches, Q), articulated_bodies(fewer, same, Q)}) {
            BodyTree<double> moving = tree;  // inverse dynamics: bias + w' for w'
            for (int j = 0; j < tree.size(); ++j) moving.links[j].bias += rates[j];
            const auto loads = joint_loads(moving, Bias<double>(moving).wrenches);
            for (int j = 0; j < tree.size(); ++j) {
                double sum = n[j];
                for (int i = 0; i < tree.size(); ++i) sum += M[std::max(i, j)][std::min(i, j)] * rates[i];
                // Rounding times the conditioning of M (up to 10⁵ in these trees).
                CHECK(sum == doctest::Approx(Q[j]).epsilon(1e-9));
                CHECK(loads[j] == doctest::Approx(Q[j]).epsilon(1e-9));
            }
        }
        for (int j = 0; j < tree.size(); ++j) {
            CHECK(also[j] == doctest::Approx(n[j]).epsilon(1e-11));
            for (int i = 0; i <= j; ++i) CHECK(less[j][i] == doctest::Approx(M[j][i]).epsilon(1e-11));
        }
    }
}

TEST_CASE("recursive: scenes that are no tree of joints are refused, and the message says what is missing") {
    const auto reason = [](const char* scene) -> std::string {
        try {
            recursive(prepared(read_scene(test::source_path(scene))).mechanism);
        } catch (const ModelError& error) {
            return error.what();
        }
        return "";
    };
    CHECK(reason("scenes/textbook/rising_plane.toml")
              .find("is on a point shifted by 'r*cos(omega*t)', which is not linear") != std::string::npos);
}

TEST_CASE(
    "recursive: what is chosen depends on the system: the textbook's form for two rods, composite bodies for an "
    "arm, both ends of a long chain") {
    const auto chosen = [](const Mechanism& m) { return choose(m, {lagrange(m), recursive(m)}); };
    CHECK(chosen(from_text(chain(2))).program.formulation.find("textbook form") != std::string::npos);
    CHECK(chosen(prepared(read_scene(test::source_path("scenes/benchmark/trees/arm7.toml"))).mechanism)
              .program.formulation.find("composite bodies") != std::string::npos);
    const Choice many = chosen(from_text(chain(24)));
    CHECK(many.program.formulation.find("chain from both ends") != std::string::npos);
    REQUIRE(many.runner_up);
    CHECK(many.cost.time() <= many.runner_up->cost.time());
}

}  // namespace formalism_recursive
