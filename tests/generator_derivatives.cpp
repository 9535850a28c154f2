// SPDX-License-Identifier: MIT
// The differentiated program against dual numbers that go through the undifferentiated one, its solve included.
#include <doctest/doctest.h>

#include <map>

#include "alembert/base/error.hpp"
#include "alembert/native/compilation.hpp"
#include "alembert/ode/rhs.hpp"
#include "algebra/symbolic/symbols.hpp"
#include "analysis/state/prepared.hpp"
#include "codegen/emit/emit.hpp"
#include "dual.hpp"
#include "link_scenes.hpp"
#include "model/formalism/formalisms.hpp"
#include "model/formalism/recursive.hpp"
#include "program/differentiate.hpp"
#include "program/lower/choose.hpp"
#include "program/lower/perturbed_tree.hpp"
#include "program/partials.hpp"
#include "scene_programs.hpp"
#include "scenes.hpp"

namespace generator_derivatives {

using namespace alembert;
using test::Dual;

namespace {

/// q, then q' or u.
std::vector<double> flat(const State<double>& s) {
    std::vector<double> y = s.q;
    y.insert(y.end(), s.qdot.begin(), s.qdot.end());
    return y;
}

/// (q', u'), and the power last, with the derivatives along component j of the state, or of the parameters.
std::vector<Dual> along(const Program& p, const State<double>& s, bool parameter, std::size_t j) {
    State<Dual> at{.parameters = {s.parameters.begin(), s.parameters.end()},
                   .t = s.t,
                   .q = {s.q.begin(), s.q.end()},
                   .qdot = {s.qdot.begin(), s.qdot.end()},
                   .qddot = {}};
    (parameter ? at.parameters[j] : j < s.q.size() ? at.q[j] : at.qdot[j - s.q.size()]).d = 1;
    std::vector<Dual> rates, value = interpret(p, at);
    if (p.speeds.empty()) rates = at.qdot;
    for (const int id : p.nodes_of(Group::rate)) rates.push_back(value[static_cast<std::size_t>(id)]);
    for (const int id : p.nodes_of(Group::acceleration)) rates.push_back(value[static_cast<std::size_t>(id)]);
    at.qddot.assign(rates.begin() + static_cast<std::ptrdiff_t>(s.q.size()), rates.end());
    value = interpret(p, at);
    rates.push_back(value[static_cast<std::size_t>(p.nodes_of(Group::power)[0])]);
    return rates;
}

/// The largest difference over the largest entry, of a matrix whose columns are `along` and whose rows are roots;
/// −1 where the state has no finite rates.
double misfit(const Program& program, const Differentiated& d, const State<double>& s) {
    const std::vector<double> y = flat(s);
    State<double> at = s;
    std::vector<double> value = interpret(d.program, at);
    for (const int id : d.program.nodes_of(Group::acceleration))
        at.qddot.push_back(value[static_cast<std::size_t>(id)]);
    value = interpret(d.program, at);
    double worst = 0;
    const auto compare = [&](Group group, std::optional<Group> last, bool parameter, std::size_t columns) {
        const std::vector<int> nodes = d.program.nodes_of(group),
                               tail = last ? d.program.nodes_of(*last) : std::vector<int>();
        double difference = 0, largest = 1e-3;
        for (std::size_t j = 0; j < columns; ++j) {
            const std::vector<Dual> exact = along(program, s, parameter, j);
            const std::size_t rows = nodes.size() / columns;  // that of the power may be among them
            for (std::size_t i = 0; i < rows + (tail.empty() ? 0 : 1); ++i) {
                const double ours = value[static_cast<std::size_t>(i < rows ? nodes[i * columns + j] : tail[j])];
                difference = std::max(difference, std::isfinite(exact[i].d) ? std::abs(ours - exact[i].d) : 0);
                largest = std::max(largest, std::abs(exact[i].d));
                if (!std::isfinite(exact[i].v)) return;
            }
        }
        worst = std::max(worst, difference / largest);
    };
    compare(Group::jacobian, Group::power_gradient, false, y.size());
    if (!d.program.nodes_of(Group::parameter_jacobian).empty())
        compare(Group::parameter_jacobian, std::nullopt, true, s.parameters.size());
    return worst;
}

/// n uniform rods, one hanging from the other, by relative angles.
std::string chain(int n) {
    std::string
        coordinates =
            "title = \"chain\"\ngravity = [0, \"g\"]\n[parameters]\nm = 1.0\nl = 1.0\ng = 9.81\n[coordinates]\n",
        bodies;
    std::string frame = "N", joint = "O";
    for (int k = 1; k <= n; ++k) {
        const std::string i = std::to_string(k);
        coordinates += "q" + i + " = 0.3\n";
        bodies += "[[frame]]\nname = \"R" + i + "\"\nparent = \"" + frame + "\"\nrotate = [[\"z\", \"q" + i +
                  "\"]]\n[[point]]\nname = \"J" + i + "\"\nfrom = \"" + joint +
                  "\"\noffset = [0, \"l\"]\naxes = \"R" + i + "\"\n[[body]]\nname = \"B" + i +
                  "\"\nmass = \"m\"\nframe = \"R" + i + "\"\nfrom = \"" + joint +
                  "\"\nposition = [0, \"l/2\"]\naxes = \"R" + i + "\"\ninertia = \"m*l^2/12\"\n";
        frame = "R" + i;
        joint = "J" + i;
    }
    return coordinates + bodies;
}

}  // namespace

// Griewank & Walther, §9.2: the Jacobian does not depend on the order of elimination; its cost does.
TEST_CASE("partials: forward, reverse and least fill give what dual numbers give, for every function") {
    Program p;
    const int x = p.variable({Variable::Kind::coordinate, 0}), y = p.variable({Variable::Kind::coordinate, 1});
    const int small = p.product(Rational(1) / 3, {{x, 1}, {y, 1}});
    std::vector<int> outputs;
    for (const Op op : {Op::sin, Op::cos, Op::tan, Op::asin, Op::acos, Op::atan, Op::sinh, Op::cosh, Op::tanh,
                        Op::exp, Op::log, Op::sqrt, Op::abs, Op::sign})
        outputs.push_back(p.call(op, {small}));
    for (const Op op : {Op::pow, Op::atan2, Op::min, Op::max})
        outputs.push_back(p.call(op, {p.sum(1, {{1, y}}), p.call(Op::sin, {x})}));
    const int quotient = p.product(1, {{outputs[0], 2}, {p.sum(2, {{1, y}, {1, small}}), -3}, {x, 7}});
    outputs.push_back(quotient);
    outputs.push_back(p.sum(3, {{2, quotient}, {-1, outputs[1]}, {5, x}}));
    outputs.push_back(x);
    outputs.push_back(p.number(4));
    const std::vector<int> inputs{x, y};
    for (const EliminationOrder order :
         {EliminationOrder::forward, EliminationOrder::reverse, EliminationOrder::least_fill}) {
        Program q = p;
        const auto found = partials(q, outputs, inputs, order);
        REQUIRE(found);
        for (const double a : {0.7, -0.4}) {
            const std::vector<double> value =
                interpret<double>(q, {.parameters = {}, .q = {a, 0.9}, .qdot = {}, .qddot = {}});
            for (int j = 0; j < 2; ++j) {
                const std::vector<Dual> exact =
                    interpret<Dual>(p, {.parameters = {},
                                        .q = {{a, j == 0 ? 1. : 0.}, {0.9, j == 1 ? 1. : 0.}},
                                        .qdot = {},
                                        .qddot = {}});
                for (std::size_t k = 0; k < outputs.size(); ++k) {
                    double ours = 0;
                    for (const Partial& part : *found)
                        if (part.output == static_cast<int>(k) && part.input == j)
                            ours = value[static_cast<std::size_t>(part.node)];
                    const double theirs = exact[static_cast<std::size_t>(outputs[k])].d;
                    INFO("output " << k << " by " << j << " at " << a);
                    CHECK((std::isnan(theirs)
                               ? std::isnan(ours)
                               : std::abs(ours - theirs) <= 1e-14 * std::max(1., std::abs(theirs))));
                }
            }
        }
    }
}

TEST_CASE("partials: nodes before an input are constant, and the budget is respected") {
    Program p;
    const int x = p.variable({Variable::Kind::coordinate, 0}), s = p.call(Op::sin, {x});
    const int f = p.sum(0, {{1, p.product(1, {{s, 2}})}, {3, x}});
    const std::vector<int> outputs{f}, inputs{s, x};
    const auto found = partials(p, outputs, inputs, EliminationOrder::reverse);
    REQUIRE(found);
    CHECK((*found)[0].node == p.product(2, {{s, 1}}));
    CHECK((*found)[1].node == p.number(3));
    CHECK_FALSE(partials(p, outputs, inputs, EliminationOrder::reverse, 1));
}

TEST_CASE("derivatives: the Jacobian of a chain of 4 to 8 rods costs at most four right-hand sides") {
    for (const int n : {4, 6, 8}) {
        const Mechanism m = build(parse_scene(chain(n), "chain.toml"));
        const Program program = choose(m, formalism("lagrange").derive(m)).program;
        const auto d = differentiated(program);
        REQUIRE(d);
        const int rhs = program.count(program.right_hand_side()).total();
        MESSAGE(n << " rods: " << rhs << " operations, the Jacobian " << d->operations.total() << " by "
                  << d->route);
        CHECK(d->operations.total() <= 4 * rhs);
        State<double> s = start_of(m).state();
        for (double& u : s.qdot) u = 0.5;
        CHECK(misfit(program, *d, s) < 1e-10);
    }
}

/// A tree of `n` bodies whose parents are among the three before them, with turning and sliding joints about axes
/// at right angles or oblique (then with rotors too), parameters, springs, damping, and a joint whose angle has a
/// part that is given in time.
std::string branching_tree(int n, bool oblique) {
    std::mt19937_64 random(static_cast<std::uint64_t>(n));
    const auto pick = [&](int most) { return static_cast<int>(random() % static_cast<std::uint64_t>(most)); };
    std::string forces,
        text =
            "title = \"tree\"\ngravity = [0, 0, \"-g\"]\n[parameters]\ng = 9.81\nm = 1.3\nc = 0.2\nk = 2.0\n"
            "[coordinates]\nq0 = { initial = 0.2, rate = 0.4 }\n[[frame]]\nname = \"T\"\nparent = \"N\"\nrotate = "
            "[[\"x\", \"q0 + 0.3*sin(t)\"]]\n"
            "[[body]]\nname = \"B0\"\nmass = 1\nframe = \"T\"\nfrom = \"O\"\nposition = [0, 0, 0]\n"
            "inertia = { xx = 1, yy = 1, zz = 1 }\n";
    const char* letters[] = {"\"x\"", "\"y\"", "\"z\""};
    for (int k = 1; k <= n; ++k) {
        const std::string i = std::to_string(k), parent = std::to_string(std::max(0, k - 1 - pick(3)));
        const bool slides = pick(7) == 0, general = oblique && pick(2) == 0;
        text += "[[body]]\nname = \"B" + i + "\"\nmass = \"m\"\ninertia = { xx = 0.03, yy = 0.04, zz = 0.05" +
                (pick(2) == 0 ? ", xy = 0.002, zx = -0.003 }\n" : " }\n");
        text += "[[joint]]\nname = \"J" + i + "\"\ntype = \"" + (slides ? "prismatic" : "revolute") +
                "\"\nparent = \"B" + parent + "\"\nchild = \"B" + i + "\"\nparent_point = [0.1, 0, " +
                (general ? "\"c\"" : "0") +
                "]\nchild_point = [0, 0.05, \"-c\"]\naxis = " + (general ? "[0.6, 0, 0.8]" : letters[pick(3)]) +
                "\ncoordinates = { q" + i + " = { initial = 0.3, rate = 0.2 } }\n";
        if (oblique && k % 3 == 0) text += "armature = { q" + i + " = \"m/10\" }\n";
        forces += "q" + i + " = \"-k*q" + i + " - 0.1*q" + i + "'^3\"\n";
    }
    return text + "[forces]\n" + forces;
}

/// A body that floats by a quaternion, two links on it, one by a spherical joint, and a link on that.
const char* const floating_tree = R"toml(gravity = [0, 1, -9.81]
[parameters]
m = 1.3
k = 2
[[body]]
name = "A"
mass = "m"
inertia = { xx = 0.03, yy = 0.04, zz = 0.05, xy = 0.002 }
[[joint]]
name = "J0"
type = "free"
parent = "N"
child = "A"
coordinates = { x = 0, y = 0, z = 0, e0 = 1, e1 = 0, e2 = { initial = 0, rate = 0.7 }, e3 = 0 }
[[body]]
name = "B"
mass = 0.5
inertia = [0.02, 0.01, 0.015]
[[joint]]
name = "J1"
type = "spherical"
parent = "A"
child = "B"
parent_point = [0.1, 0.2, "m/10"]
child_point = [0, 0.05, 0.1]
coordinates = { f0 = 1, f1 = { initial = 0, rate = 0.4 }, f2 = 0, f3 = 0 }
[[body]]
name = "C"
mass = 0.4
inertia = [0.02, 0.01, 0.015]
[[joint]]
name = "J2"
type = "revolute"
parent = "B"
child = "C"
axis = [0.6, 0, 0.8]
parent_point = [0, 0.1, 0]
child_point = [0.1, 0, 0]
coordinates = { c = { initial = 0.3, rate = 0.2 } }
[[body]]
name = "D"
mass = 0.3
inertia = [0.02, 0.01, 0.015]
[[joint]]
name = "J3"
type = "prismatic"
parent = "A"
child = "D"
axis = "y"
coordinates = { d = { initial = 0.3, rate = 0.2 } }
[[torque]]
on = "B"
vector = ["-0.1*c'", "k*f1", 0.3]
)toml";

TEST_CASE("derivatives: those of the articulated bodies of a tree are dual numbers' along any axes") {
    for (const std::string& text : {branching_tree(9, true), branching_tree(8, false), chain(5),
                                    std::string(floating_tree), std::string(test::on_curves)}) {
        const Mechanism m = prepared(parse_scene(text, "tree.toml")).mechanism;
        const Equations equations = formalism("recursive").derive(m);
        const Program program = choose(m, equations).program;
        const std::vector<Perturbed> forms = perturbed_tree(program, m, equations, false);
        CHECK(forms.size() >= 1);
        for (const Perturbed& form : forms) {
            // Without roots for M there is no other route.
            Program alone = form.program;
            std::erase_if(alone.roots, [](const Root& root) { return root.group == Group::mass; });
            const auto d = differentiated(alone, {.parameters = true, .power = true, .perturbed = {form}});
            REQUIRE(d);
            CHECK(d->route == "articulated bodies");
            State<double> s = start_of(m).state();
            for (std::size_t i = 0; i < s.q.size(); ++i) s.q[i] += 0.1 * static_cast<double>(i % 4);
            CHECK(misfit(program, *d, s) < 1e-10);
        }
    }
}

TEST_CASE("derivatives: the Jacobian of a tree of 20 joints takes at most seven right-hand sides") {
    const Mechanism m = prepared(parse_scene(branching_tree(20, false), "tree.toml")).mechanism;
    const Equations equations = recursive_without_matrix(m);
    const Program program = choose(m, equations).program;
    const auto d = differentiated(program, {.perturbed = perturbed_tree(program, m, equations, false)});
    REQUIRE(d);
    const int rhs = program.count(program.right_hand_side()).total();
    MESSAGE(rhs << " operations, the Jacobian " << d->operations.total());
    CHECK(d->operations.total() <= 7 * rhs);
}

TEST_CASE("derivatives: the emitted Jacobian is the interpreted one, dense and with the row of the power") {
    for (const char* name :
         {"double_pendulum", "cartesian_pendulum", "ball_on_turntable", "chaplygin_sleigh_in_speeds"}) {
        CAPTURE(name);
        const Mechanism m = prepared(read_scene(test::source_path("scenes/textbook/") + name + ".toml")).mechanism;
        const Equations equations = formalism(m.speeds.empty() ? "routh" : "kane").derive(m);
        const Program plain = choose(m, equations).program;
        const auto d = differentiated(plain, {.parameters = true, .power = true});
        REQUIRE(d);
        const Module module = load(compile(emit(d->program).text, d->program.name, {}).object);
        REQUIRE(bool(module.derivatives()));
        CHECK(module.derivatives()->operations == d->operations.total());
        State<double> s = state_of(start_of(m), m, equations);
        for (double& u : s.qdot) u += 0.3;
        std::vector<double> y = flat(s), value = interpret(d->program, s);
        for (const int id : d->program.nodes_of(Group::acceleration))
            s.qddot.push_back(value[static_cast<std::size_t>(id)]);
        value = interpret(d->program, s);
        const std::size_t n = y.size();
        const Rhs driven = make_rhs(module, s.parameters, Work::integrated);
        REQUIRE(bool(driven.jacobian));
        std::vector<double> J((n + 1) * (n + 1), NAN);
        y.push_back(0);
        driven.jacobian(driven.context.get(), s.t, y.data(), J.data());
        std::vector<int> nodes = d->program.nodes_of(Group::jacobian);
        const std::vector<int> last = d->program.nodes_of(Group::power_gradient);
        nodes.insert(nodes.end(), last.begin(), last.end());
        double largest = 1;
        for (const int id : nodes) largest = std::max(largest, std::abs(value[static_cast<std::size_t>(id)]));
        for (std::size_t i = 0; i <= n; ++i)
            for (std::size_t j = 0; j <= n; ++j)
                CHECK(std::abs(J[j * (n + 1) + i] - (j < n ? value[static_cast<std::size_t>(nodes[i * n + j])]
                                                           : 0)) <= 1e-13 * largest);
        // The parameters' pattern is that of the entries.
        const std::vector<double> par = prepared(module, s.parameters);
        std::vector<double> entries(static_cast<std::size_t>(module.derivatives()->parameter_entries));
        module.derivatives()->parameter_jacobian(s.t, y.data(), par.data(), entries.data());
        const std::vector<int> by_parameters = d->program.nodes_of(Group::parameter_jacobian);
        for (std::size_t k = 0; k < entries.size(); ++k) {
            const int at = module.derivatives()->parameter_rows[k] * static_cast<int>(s.parameters.size()) +
                           module.derivatives()->parameter_columns[k];
            const double expected = value[static_cast<std::size_t>(by_parameters[static_cast<std::size_t>(at)])];
            CHECK(std::abs(entries[k] - expected) <= 1e-12 * std::max(1., std::abs(expected)));
        }
        CHECK(load(compile(emit(plain).text, plain.name, {}).object).derivatives() == nullptr);
    }
}

TEST_CASE("derivatives: the Jacobians of the scenes are those of dual numbers") {
    std::mt19937_64 random(20240917);
    int checked = 0;
    test::for_scene_programs(2, [&](const test::SceneProgram& one) {
        const auto d = differentiated(one.program, {.parameters = true, .power = true});
        REQUIRE(d);
        State<double> s = one.start;
        for (int k = 0; k < 4; ++k) {
            INFO(one.name << ", seed 20240917, state " << k << ": " << d->route);
            // Rounding: the accelerations' own, and that of the differences of large terms in their derivatives.
            CHECK(misfit(one.program, *d, s) < 1e-10);
            const std::size_t parameters = one.program.parameters.size();
            CHECK(d->program.nodes_of(Group::parameter_jacobian).size() == parameters * (flat(s).size() + 1));
            ++checked;
            test::step_aside(s, random);
        }
    });
    CHECK(checked > test::at_least(100));
}

}  // namespace generator_derivatives
