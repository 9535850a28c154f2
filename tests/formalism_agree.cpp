// SPDX-License-Identifier: MIT
// Every formalism, by its own route, gives the same accelerations on every scene: numerically at random states,
// and exactly modulo a prime. A formalism with one wrong entry is refuted.
#include <doctest/doctest.h>

#include <cln/integer_io.h>
#include <fmt/format.h>

#include <cmath>
#include <random>
#include <set>

#include "algebra/notation/text.hpp"
#include "analysis/agree/agree.hpp"
#include "analysis/state/prepared.hpp"
#include "model/formalism/dalembert.hpp"
#include "model/formalism/kane.hpp"
#include "model/formalism/lagrange.hpp"
#include "model/formalism/rest.hpp"
#include "program/lower/lower.hpp"
#include "program/modular.hpp"
#include "program/prime_polynomial.hpp"
#include "scenes.hpp"
#include "simulate/simulate.hpp"

namespace formalism_agree {

using namespace alembert;
using GiNaC::ex;

namespace {

std::vector<std::string> all_scenes() {
    std::vector<std::string> files;
    for (const char* folder : {"scenes/textbook", "tests/odd"})
        for (const std::string& file : test::scenes_in(folder)) files.push_back(file);
    return files;
}

/// The largest residual of b's rows M u' = f at a's accelerations and multipliers, over the row's largest term.
void check_numerically(const Mechanism& m, const Equations& a, const Equations& b) {
    CAPTURE(a.formalism);
    CAPTURE(b.formalism);
    const Energy energy = energy_of(m);
    const Program first = lower(m, a, energy), second = lower(m, b, energy);
    const Start start = start_of(m);
    const unsigned seed = 20040108;
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    int compared = 0;
    for (int k = 0; k < 32; ++k) {
        const State<double> at = test::random_state(start, random);
        const State<long double> state{.parameters = {at.parameters.begin(), at.parameters.end()},
                                       .t = at.t,
                                       .q = {at.q.begin(), at.q.end()},
                                       .qdot = {at.qdot.begin(), at.qdot.end()},
                                       .qddot = {}};
        const auto x = interpret(first, state), y = interpret(second, state);
        const auto group = [](const Program& p, const std::vector<long double>& value, Group name) {
            std::vector<long double> result;
            for (const int id : p.nodes_of(name)) result.push_back(value[id]);
            return result;
        };
        const auto u = group(first, x, Group::acceleration), lambda = group(first, x, Group::multiplier);
        const auto M = group(second, y, Group::mass), f = group(second, y, Group::forcing),
                   A = group(second, y, Group::row);
        if (u.empty() || !std::all_of(u.begin(), u.end(), [](long double v) { return std::isfinite(v); }))
            continue;
        ++compared;
        const std::size_t n = u.size();
        // Terms inside f that cancel are as large as f elsewhere: the largest term of all rows.
        long double largest = 1e-300L, worst = 0;
        for (std::size_t i = 0; i < n; ++i) {
            long double sum = -f[i];
            largest = std::max(largest, std::abs(f[i]));
            for (std::size_t j = 0; j < n; ++j) {
                const long double term = M[std::max(i, j) * (std::max(i, j) + 1) / 2 + std::min(i, j)] * u[j];
                sum += term;
                largest = std::max(largest, std::abs(term));
            }
            for (std::size_t r = 0; r < lambda.size(); ++r) {
                sum -= A[r * n + i] * lambda[r];
                largest = std::max(largest, std::abs(A[r * n + i] * lambda[r]));
            }
            worst = std::max(worst, std::abs(sum));
        }
        CHECK(worst <= 1e-11L * largest);
    }
    CHECK(compared > 0);
}

/// The same for equations in speeds: accelerations and multipliers at random speeds are those of `a` at their
/// rates.
void check_in_speeds(const Mechanism& m, const Equations& a, const Equations& b) {
    CAPTURE(a.formalism);
    CAPTURE(b.formalism);
    const Energy energy = energy_of(m);
    const Program first = lower(m, a, energy), second = lower(m, b, energy);
    const Start start = start_of(m);
    const unsigned seed = 19851985;
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    const auto group = [](const Program& p, const std::vector<long double>& value, Group name) {
        std::vector<long double> result;
        for (const int id : p.nodes_of(name)) result.push_back(value[id]);
        return result;
    };
    int compared = 0;
    for (int k = 0; k < 32; ++k) {
        const State<double> at = test::random_state(start, random);
        State<long double> state{.parameters = {at.parameters.begin(), at.parameters.end()},
                                 .t = at.t,
                                 .q = {at.q.begin(), at.q.end()},
                                 .qdot = {at.qdot.begin(), at.qdot.begin() + b.size()},
                                 .qddot = {}};
        State<long double> plain = state;
        auto y = interpret(second, state);
        plain.qdot = group(second, y, Group::rate);
        state.qddot = group(second, y, Group::acceleration);
        y = interpret(second, state);
        const auto x = interpret(first, plain);
        const auto compare = [&](const std::vector<long double>& right, const std::vector<long double>& found) {
            REQUIRE(right.size() == found.size());
            long double largest = 1, worst = 0;
            for (std::size_t i = 0; i < right.size(); ++i) {
                largest = std::max({largest, std::abs(right[i]), std::abs(found[i])});
                worst = std::max(worst, std::abs(right[i] - found[i]));
            }
            if (!std::isfinite(largest)) return;
            ++compared;
            CHECK(worst <= 1e-11L * largest);
        };
        compare(group(first, x, Group::acceleration), group(second, y, Group::second_rate));
        compare(group(first, x, Group::multiplier), group(second, y, Group::multiplier));
        long double fastest = 1;
        for (const long double rate : plain.qdot) fastest = std::max(fastest, std::abs(rate));
        for (const Equations::Eliminated& gone : b.eliminated)
            if (std::isfinite(fastest))
                CHECK(std::abs(y[second.nodes_of(Group::velocity)[gone.constraint]]) <= 1e-12L * fastest);
    }
    CHECK(compared > 0);
}

}  // namespace

TEST_CASE("formalisms: all that apply give the same accelerations at random states") {
    for (const std::string& file : test::every_third(all_scenes(), 2)) {
        CAPTURE(file);
        const Mechanism mechanism = prepared(read_scene(file)).mechanism;
        const Derivations all = derive_all(mechanism);
        REQUIRE(!all.equations.empty());
        for (std::size_t k = 1; k < all.equations.size(); ++k)
            if (all.equations[k].speeds_are_rates())
                check_numerically(mechanism, all.equations[0], all.equations[k]);
            else
                check_in_speeds(mechanism, all.equations[0], all.equations[k]);
    }
}

/// Two particles in the plane with springs, dampers and potentials whose constants change with coordinates, rates
/// and time, as they come.
class Springs {
public:
    explicit Springs(unsigned seed) : random_(seed) {}

    std::string scene() {
        const bool cartesian = one_of({"yes", "no"}) == "yes";
        std::string text =
            "gravity = [0, \"-g\"]\n[parameters]\nm = 2\nM = 1.5\nk = 3\nc = 0.4\nl = 0.7\ng = 9.81\n"
            "[inputs]\nF = \"0.2*sin(3*t)\"\n"
            "[coordinates]\nx = 0.5\ny = { initial = 0.3, rate = 0.2 }\nz = -0.4\n";
        if (one_of({"yes", "no"}) == "yes") text += "[speeds]\nu = \"x' + y'\"\nv = \"y'\"\nw = \"2*z' - x'\"\n";
        text +=
            "[[particle]]\nname = \"A\"\nmass = \"m\"\nposition = [\"x\", \"y\"]\n"
            "[[particle]]\nname = \"B\"\nmass = \"M\"\nposition = " +
            std::string(cartesian ? "[\"z\", 2]\n" : "[\"x + l*sin(z)\", \"y - l*cos(z)\"]\n");
        for (int k = 0; k < 2; ++k) {
            text += "[[spring]]\n" + place() + "stiffness = \"k" + factor() + "\"\n";
            text += one_of({"", "length = \"l" + factor() + "\"\n", "length = \"l + F\"\n"});
        }
        text +=
            "[[damper]]\n" + place() + "damping = \"c" + one_of({factor(), "*(1 + x'^2)", "*(1 + z*y')"}) + "\"\n";
        return text + "[energy]\npotential = \"k*x*y^2*cos(z)" + factor() + "\"\n[dissipation]\nrayleigh = \"c" +
               factor() + "*(x' - z')^2/2\"\n";
    }

private:
    std::string one_of(const std::vector<std::string>& list) { return list[random_() % list.size()]; }
    std::string place() {
        return one_of({"between = [\"O\", \"A\"]\n", "between = [\"A\", \"B\"]\n", "along = \"x + z\"\n",
                       "along = \"0.3\"\n", "along = \"y*z + F\"\n"});
    }
    std::string factor() {
        return one_of({"", "*(1 + x^2)", "*(2 + sin(y))", "*(3 + x*z/5)", "*(1 + t/10 + z^2)", "*(2 + F*y)"});
    }
    std::mt19937 random_;
};

// V = ½ k (d − l)² has the forces −½ ∂k/∂q (d − l)² and k ∂l/∂q (d − l) besides those along the spring.
TEST_CASE("formalisms: springs and dampers whose constants change with coordinates give the same accelerations") {
    std::set<std::string> met;
    for (unsigned seed = 1; seed <= 16; ++seed) {
        const std::string text = Springs(seed).scene();
        CAPTURE(text);
        const Mechanism mechanism = prepared(parse_scene(text, "springs.toml")).mechanism;
        const Derivations all = derive_all(mechanism);
        for (std::size_t k = 0; k < all.equations.size(); ++k) {
            met.insert(all.equations[k].formalism);
            if (k == 0) continue;
            if (all.equations[k].speeds_are_rates())
                check_numerically(mechanism, all.equations[0], all.equations[k]);
            else
                check_in_speeds(mechanism, all.equations[0], all.equations[k]);
        }
    }
    for (const char* const name :
         {"lagrange", "lagrange1", "kane", "dalembert", "appell", "schiehlen", "hamilton"})
        CHECK(met.contains(name));
}

// ½ (1 + q²) k (d − l)² with q = 0.5, d = 0.3 and no length pulls with k q d², against m = 1 of the particle.
TEST_CASE("formalisms: a spring that only its stiffness couples to a coordinate pulls along it") {
    const Scene scene = parse_scene(
        "parameters = { m = 1, k = 2, d = 0.3 }\ncoordinates = { q = 0.5 }\n[[particle]]\nname = \"P\"\nmass = "
        "\"m\"\n"
        "position = [\"q\", 0]\n[[spring]]\nalong = \"d\"\nstiffness = \"k*(1 + q^2)\"\n",
        "spring.toml");
    const Mechanism m = prepared(scene).mechanism;
    const Derivations all = derive_all(m);
    CHECK(all.equations.size() >= 8);
    for (const Equations& e : all.equations) {
        CAPTURE(e.formalism);
        const Program program = lower(m, e, energy_of(m));
        const std::vector<double> value = interpret(program, start_of(m).state());
        CHECK(value[program.nodes_of(Group::acceleration)[0]] == doctest::Approx(-2 * 0.5 * 0.09).epsilon(1e-14));
    }
}

TEST_CASE("simulate: a spring whose stiffness and length change keeps the energy of a scene in speeds") {
    const Scene scene = parse_scene(
        "parameters = { m = 1, k = 2, l = 1 }\ncoordinates = { x = { initial = 0.5, rate = 0.3 }, y = 0.7 }\n"
        "[speeds]\nu = \"x' + y'\"\nv = \"y'\"\n[[particle]]\nname = \"P\"\nmass = \"m\"\n"
        "position = [\"x\", \"y\"]\n[[spring]]\nbetween = [\"O\", \"P\"]\nstiffness = \"k*(1 + x^2)\"\n"
        "length = \"l*(2 + sin(y))/3\"\n",
        "spring.toml");
    const Run run = simulate(scene, {.duration = 5, .tolerance = 1e-12, .estimate = false});
    CHECK(run.equations.formalism == "kane");
    CHECK(run.energy.conserved);
    CHECK(run.energy.drift < 1e-10);
}

TEST_CASE("agree: scenes are proved") {
    for (const std::string& file : test::every_third(all_scenes(), 1)) {
        CAPTURE(file);
        const Mechanism mechanism = prepared(read_scene(file)).mechanism;
        const Derivations all = derive_all(mechanism);
        if (all.equations.size() < 2) continue;
        const Agreement result = agree(all.equations, mechanism);
        CAPTURE(result.reason);
        CHECK(result.verdict == Agreement::Verdict::proved);
        CHECK(result.failure <= -60);
    }
}

// Pleiades: 21 square roots, all of which exist at one point in two million; Kapitza: an angle of time by a number
// of 16 decimals.
TEST_CASE("agree: scenes with a root for each pair of bodies, or with decimals in angles, are decided") {
    for (const char* const name : {"pleiades", "kapitza"}) {
        CAPTURE(name);
        const Mechanism mechanism =
            prepared(read_scene(test::source_path(std::string("scenes/benchmark/") + name + ".toml"))).mechanism;
        Derivations all = derive_all(mechanism);
        CHECK(agree(all.equations, mechanism).verdict == Agreement::Verdict::proved);
        all.equations.back().own.back() += mechanism.q.back();
        CHECK(agree(all.equations, mechanism).verdict == Agreement::Verdict::refuted);
    }
}

// With M⁻¹, H of sixteen rods would have such a high degree that sampling could not be bounded.
// The squares of such components add up to a number with large prime factors, whose root the rotation contains.
TEST_CASE("agree: axes given as decimals, and decimals in angles, are proved and wrong entries refuted") {
    std::mt19937 random(11);
    const auto decimal = [&](int digits) {
        const long size = std::lround(std::pow(10.0, digits));
        return fmt::format(
            "{}", static_cast<double>(1 + static_cast<long>(random() % size)) / static_cast<double>(size));
    };
    for (int k = 0; k < 8; ++k) {
        const int digits = 2 + 2 * k;
        const std::string axis = fmt::format("[{}, {}, {}]", decimal(digits), decimal(digits), decimal(digits)),
                          turn = decimal(digits), tilt = decimal(digits);
        CAPTURE(axis);
        CAPTURE(tilt);
        const std::string text = fmt::format(R"toml(
gravity = [0, 0, -9.81]
[[body]]
name = "B"
mass = 2
inertia = [0.1, 0.2, 0.25]
[[body]]
name = "C"
mass = 1
inertia = [0.1, 0.1, 0.1]
[[joint]]
name = "J"
type = "revolute"
parent = "N"
child = "B"
axis = {}
parent_rotate = [["x", "{}"]]
child_point = [0.3, 0.1, 0.2]
coordinates = {{ a = {{ initial = 0.4 }} }}
[[joint]]
name = "K"
type = "revolute"
parent = "B"
child = "C"
axis = ["sin({})", 0, "cos({})"]
child_point = [0.1, 0, 0.2]
coordinates = {{ b = {{ initial = 0.1 }} }}
)toml",
                                             axis, turn, tilt, tilt);
        const Mechanism m = prepared(parse_scene(text, "axes.toml")).mechanism;
        Derivations all = derive_all(m);
        CHECK(agree(all.equations, m).verdict == Agreement::Verdict::proved);
        all.equations[1].own[0] += m.q[0];
        CHECK(agree(all.equations, m).verdict == Agreement::Verdict::refuted);
    }
}

TEST_CASE("agree: all formalisms are proved equal on a chain of sixteen rods, Hamilton's equations too") {
    const Agreed result = agree(read_scene(test::source_path("scenes/benchmark/trees/pend16.toml")), 1e4);
    CHECK(result.agreement.verdict == Agreement::Verdict::proved);
    CHECK(std::any_of(result.derivations.equations.begin(), result.derivations.equations.end(),
                      [](const Equations& e) { return e.formalism == "hamilton"; }));
}

TEST_CASE("agree: a formalism with one wrong entry is refuted") {
    for (const std::string& file : test::every_third(test::scenes_in("scenes/textbook"), 0)) {
        CAPTURE(file);
        const Mechanism m = prepared(read_scene(file)).mechanism;
        const Derivations all = derive_all(m);
        const Equations& right = all.equations[0];
        for (int kind = 0; kind < 3; ++kind) {
            CAPTURE(kind);
            Equations wrong = right;
            wrong.formalism = "wrong";
            // A row whose acceleration is not zero, because a free x'' = 0 may be multiplied by anything.
            int row = 0;
            while (kind == 0 && row + 1 < right.size() && right.forcing(row).is_zero() && right.A.empty()) ++row;
            if (kind == 0) wrong.M(row, row) = wrong.z->name(wrong.M(row, row) * (1 + m.q[0] * m.q[0]));
            if (kind == 1) wrong.own[0] = wrong.z->name(wrong.own[0] + m.qdot[0]);
            if (kind == 2) wrong.applied.back() = wrong.z->name(wrong.applied.back() + sin(m.q.back()) / 1000);
            CHECK(agree({right, wrong}, m).verdict == Agreement::Verdict::refuted);
        }
    }
}

TEST_CASE("kane and dalembert: energies that belong to no body are refused with the reason") {
    const Mechanism m = prepared(read_scene(test::source_path("tests/odd/kinetic.toml"))).mechanism;
    CHECK_THROWS_WITH_AS(kane(m), doctest::Contains("[energy] kinetic"), ModelError);
    CHECK_THROWS_WITH_AS(dalembert(m), doctest::Contains("[energy] kinetic"), ModelError);
}

TEST_CASE("dalembert: a factor of rest without sines begins with a plus, whatever sign the factoring gave it") {
    const Mechanism m = prepared(read_scene(test::source_path("scenes/textbook/double_atwood.toml"))).mechanism;
    REQUIRE(m.parameters.size() >= 3);
    const ex difference = m.parameters[1].symbol - m.parameters[2].symbol;
    const Phrase one = leading_positive(*fourier(difference, *m.symbols)),
                 other = leading_positive(*fourier(-difference, *m.symbols));
    CHECK(text(one) == text(other));
}

TEST_CASE("dalembert: the governor's condition of rest is equation (20)") {
    const Mechanism built =
        prepared(read_scene(test::source_path("scenes/textbook/watt_governor.toml"))).mechanism;
    const Equations equations = dalembert(built);
    const Mechanism m = in_terms_of(equations, built);
    const ex condition = rest_conditions(m, equations)[0];
    const auto parameter = [&](const char* name) -> ex {
        for (const Mechanism::Parameter& p : m.parameters)
            if (p.symbol.get_name() == name) return p.symbol;
        throw std::out_of_range(name);
    };
    const ex alpha = m.q[0], mass = parameter("m"), l = parameter("l"), Omega = parameter("Omega");
    const ex expected =
        2 * l * sin(alpha) * (mass * l * Omega * Omega * cos(alpha) - (mass + parameter("M")) * parameter("g"));
    CHECK(vanishes(condition - expected, m) == true);
}

TEST_CASE("modular: arithmetic modulo 2^61 - 1") {
    const Prime a = 1234567890123456789, b = -42;
    CHECK(a * a.inverse() == Prime(1));
    CHECK(a + b - a == b);
    CHECK((b * b).root() * (b * b).root() == b * b);
    CHECK((b * b).root().is_square());
    const Prime w = a + b * Prime::i();
    CHECK(w * w.inverse() == 1);
    CHECK(w * (a - b * Prime::i()) == a * a + b * b);
    CHECK((w * w).root() * (w * w).root() == w * w);
    CHECK_FALSE(Prime(3).is_square());
    CHECK(*Prime::root_of(3) * *Prime::root_of(3) == 3);
    CHECK(*Prime::root_of(Rational(5) / 3) * *Prime::root_of(15) == 5);
    const PrimeTurn twelfth = *PrimeTurn::by_pi(Rational(1) / 6);
    CHECK(twelfth.cos * twelfth.cos + twelfth.sin * twelfth.sin == 1);
    CHECK(twelfth.sin * 2 == 1);
    CHECK(twelfth.power(3).cos == 0);
    CHECK(PrimeTurn::by_pi(Rational(1) / 8)->power(2).cos == PrimeTurn::by_pi(Rational(1) / 4)->sin);
    CHECK_FALSE(PrimeTurn::by_pi(Rational(1) / 5));
    // (x − √3)(x − 2)(x² + 1): roots beyond the plain ones once a coefficient is.
    const Prime r = *Prime::root_of(3);
    PrimePolynomial f{2 * r, -(r + 2), 2 * r + 1, -(r + 2), 1};
    const std::vector<Prime> zeros = roots(f, 5);
    CHECK(zeros.size() == 4);
    for (const Prime zero : zeros) CHECK(value_at(f, zero) == 0);
    CHECK(*Prime::from(Rational(1) / 3) * 3 == Prime(1));
    const PrimeTurn z = PrimeTurn::rational(17);
    CHECK(z.cos * z.cos + z.sin * z.sin == Prime(1));
    CHECK(z.power(std::uint64_t{1} << 61).cos == Prime(1));  // the order of the circle's group
}

TEST_CASE("modular: identities of angles, roots and exponentials hold, and false ones do not") {
    Program p;
    const int x = p.variable({Variable::Kind::coordinate, 0}), y = p.variable({Variable::Kind::coordinate, 1});
    const auto of = [&](Op op, const Rational& c, int arg) { return p.call(op, {p.sum(0, {{c, arg}})}); };
    const auto times = [&](int a, int b) { return p.product(1, {{a, 1}, {b, 1}}); };
    const int sum = p.sum(0, {{1, x}, {1, y}});
    // Roots of numbers with large prime factors, and a constant angle of many decimals.
    const Rational large = cln::cl_I("10000000017244009"), other = 1000003,
                   decimals = Rational(31415926) / 99999989;
    const auto root_of = [&](const Rational& c) { return p.call(Op::sqrt, {p.number(c)}); };
    const auto turned = [&](Op op, int factor) { return p.call(op, {p.sum(decimals * factor, {{1, x}})}); };
    const std::vector<std::pair<int, int>> equal{
        {times(root_of(large), root_of(other)), root_of(large * other)},
        {times(root_of(large), root_of(large)), p.number(large)},
        {turned(Op::sin, 2), p.sum(0, {{2, times(turned(Op::sin, 1), p.call(Op::cos, {p.number(decimals)}))},
                                       {-1, of(Op::sin, 1, x)}})},
        {p.call(Op::sin, {sum}), p.sum(0, {{1, times(of(Op::sin, 1, x), of(Op::cos, 1, y))},
                                           {1, times(of(Op::cos, 1, x), of(Op::sin, 1, y))}})},
        {of(Op::sin, 1, x),
         p.sum(0, {{2, times(of(Op::sin, Rational(1) / 2, x), of(Op::cos, Rational(1) / 2, x))}})},
        {of(Op::cos, 1, x), p.sum(0, {{4, p.product(1, {{of(Op::cos, Rational(1) / 3, x), 3}})},
                                      {-3, of(Op::cos, Rational(1) / 3, x)}})},
        {p.call(Op::sqrt, {p.product(1, {{x, 2}})}), p.call(Op::abs, {x})},
        {p.call(Op::exp, {sum}), times(p.call(Op::exp, {x}), p.call(Op::exp, {y}))},
        {p.call(Op::sin, {p.sum(0, {{1, x}, {Rational(1) / 2, p.pi()}})}), of(Op::cos, 1, x)},
        {p.call(Op::log, {p.call(Op::exp, {sum})}), sum},
    };
    const std::vector<std::pair<int, int>> different{
        {times(root_of(large), root_of(other)), p.sum(0, {{-1, root_of(large * other)}})},
        {turned(Op::sin, 1), turned(Op::sin, 2)},
        {p.call(Op::sin, {sum}), p.sum(0, {{1, of(Op::sin, 1, x)}, {1, of(Op::sin, 1, y)}})},
        {p.call(Op::sqrt, {p.product(1, {{x, 2}})}), x},
        {of(Op::sin, 1, x), x},
    };
    std::vector<int> roots;
    for (const auto* list : {&equal, &different})
        for (const auto& [a, b] : *list) roots.insert(roots.end(), {a, b});
    std::vector<int> seen_different(different.size(), 0);
    for (std::uint64_t seed = 1; seed <= 16; ++seed) {
        const ModularPoint point{.seed = seed};
        const auto at = evaluate_mod(p, point, roots);
        REQUIRE(at);
        for (const auto& [a, b] : equal) CHECK(at->value[a] == at->value[b]);
        for (std::size_t k = 0; k < different.size(); ++k)
            seen_different[k] += at->value[different[k].first] != at->value[different[k].second];
    }
    for (const int count : seen_different) CHECK(count > 0);
}

}  // namespace formalism_agree
