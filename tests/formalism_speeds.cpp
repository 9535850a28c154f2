// SPDX-License-Identifier: MIT
// Kane's equations in generalized speeds, and Lagrange's of the first kind, against equations derived by hand.
#include <doctest/doctest.h>

#include <cmath>

#include "alembert/native/compilation.hpp"
#include "alembert/ode/rhs.hpp"
#include "algebra/notation/text.hpp"
#include "analysis/agree/agree.hpp"
#include "analysis/derive/derivation.hpp"
#include "analysis/state/prepared.hpp"
#include "analysis/state/speeds.hpp"
#include "codegen/emit/emit.hpp"
#include "mechanisms.hpp"
#include "model/energy.hpp"
#include "model/formalism/cancel.hpp"
#include "model/formalism/kane.hpp"
#include "model/formalism/kinematics.hpp"
#include "model/formalism/lagrange1.hpp"
#include "model/formalism/routh.hpp"
#include "program/lower/choose.hpp"

namespace formalism_speeds {

using namespace alembert;
using alembert::test::textbook;
using GiNaC::ex;

namespace {

std::string equations_of(const Mechanism& m) {
    return test::equations_of(m, kane(m));
}

}  // namespace

TEST_CASE("kane: Euler's equations come out in the components of the angular velocity") {
    CHECK(equations_of(textbook("free_body"))
              .find("I1*w1' - (I2-I3)*w2*w3 = 0\n"
                    "I2*w2' - (I3-I1)*w3*w1 = 0\n"
                    "I3*w3' - (I1-I2)*w1*w2 = 0\n") == 0);
}

TEST_CASE("kane: the sleigh's equations in v and w have no multiplier") {
    const Mechanism m = textbook("chaplygin_sleigh_in_speeds");
    CHECK(kane(m).A.empty());
    CHECK(equations_of(m) ==
          "v' - a*w^2 = 0\n(J+m*a^2)*w' + m*a*v*w = 0\nx' = v*cos(phi)\ny' = v*sin(phi)\nphi' = w\n");
}

TEST_CASE("kane: the ball's angular velocity on a turntable turns with 2/7 of the table's") {
    // From 7 x'' = −2 Ω y', 7 y'' = 2 Ω x' with x' = r wy − Ω y, y' = Ω x − r wx.
    CHECK(equations_of(textbook("ball_on_turntable"))
              .find("7*r*wx' - 5*r*Omega*wy + 5*Omega^2*y = 0\n"
                    "7*r*wy' + 5*r*Omega*wx - 5*Omega^2*x = 0\n"
                    "wz' = 0\n") == 0);
}

TEST_CASE("kane: without speeds nonholonomic constraints are solved for a rate whose coefficient is a number") {
    Scene scene = read_scene(test::source_path("scenes/textbook/rolling_coin.toml"));
    std::string text = scene.text;
    const std::size_t begin = text.find("[speeds]"), end = text.find("[[frame]]");
    text.erase(begin, end - begin);
    text.erase(text.find("[[claim]]"));
    const Mechanism m = build(parse_scene(text, "coin.toml"));
    const Equations equations = kane(m);
    CHECK(equations.A.empty());
    CHECK(equations.u == std::vector<GiNaC::symbol>{m.qdot[2], m.qdot[3]});
    CHECK(equations.poles.empty());
    CHECK(agree({routh(m), equations}, m).verdict == Agreement::Verdict::proved);
}

TEST_CASE("kane: without speeds, a blade leaves the one combination of rates free that it does not constrain") {
    const Mechanism m = textbook("chaplygin_sleigh");
    const Derivation shown = derivation_of(m, kane(m));
    REQUIRE(shown.speeds.size() == 1);
    CHECK(text(shown.speeds[0].second) == "x'*cos(phi) + y'*sin(phi)");
    CHECK(equations_of(m) ==
          "u1' - a*phi'^2 = 0\n(J+m*a^2)*phi'' + m*a*u1*phi' = 0\nx' = u1*cos(phi)\ny' = u1*sin(phi)\n");
    CHECK(kane(m).poles.empty());
    CHECK(kane(m).u == kane(m).u);  // the same symbols each time
    CHECK(agree({routh(m), kane(m)}, m).verdict == Agreement::Verdict::proved);
}

TEST_CASE("kane: speeds whose number is n keep the multipliers, and agree with Routh's equations") {
    Scene scene = read_scene(test::source_path("scenes/textbook/cartesian_pendulum.toml"));
    std::string text = scene.text;
    text.insert(text.find("[[particle]]"), "[speeds]\nu = \"x*x' + y*y'\"\nw = \"x*y' - y*x' + t\"\n\n");
    const Mechanism built = build(parse_scene(text, "pendulum.toml"));
    const Equations equations = kane(built);
    const Mechanism m = in_terms_of(equations, built);
    CHECK(equations.A.size() == 1);
    CHECK(vanishes(equations.A[0][0] - 2, m) == true);  // (x² + y²)' = 2 u
    CHECK(vanishes(equations.A[0][1], m) == true);
    CHECK(agree({routh(m), equations}, m).verdict == Agreement::Verdict::proved);
}

TEST_CASE("agree: one wrong entry in equations in speeds is refuted") {
    for (const char* name :
         {"scenes/textbook/chaplygin_sleigh_in_speeds.toml", "scenes/textbook/ball_on_turntable.toml",
          "tests/odd/speeds_oblique.toml", "tests/odd/speeds_with_multipliers.toml"}) {
        CAPTURE(name);
        const Mechanism m = prepared(read_scene(test::source_path(name))).mechanism;
        const Equations right = kane(m), reference = derive_all(m).equations[0];
        REQUIRE(reference.formalism != "kane");
        CHECK(agree({reference, right}, m).verdict == Agreement::Verdict::proved);
        for (int kind = 0; kind < 4; ++kind) {
            CAPTURE(kind);
            Equations wrong = right;
            if (kind == 0) wrong.M(0, 0) = wrong.z->name(2 * wrong.M(0, 0));
            if (kind == 1) wrong.own[0] = wrong.z->name(wrong.own[0] + wrong.u.back() / 1000);
            if (kind == 2) wrong.h[0] = wrong.z->name(wrong.h[0] * (1 + m.q[0]));
            if (kind == 3) wrong.applied.back() = wrong.z->name(wrong.applied.back() + sin(m.q[0]) / 1000);
            if (kind == 0 && std::string(name).find("ball") != std::string::npos)
                wrong.own[0] = wrong.z->name(wrong.own[0] + m.q[0]);
            CHECK(agree({reference, wrong}, m).verdict == Agreement::Verdict::refuted);
            CHECK(agree({wrong, reference}, m).verdict == Agreement::Verdict::refuted);
        }
    }
}

TEST_CASE("speeds: too many, dependent ones and ones that a constraint fixes have different messages") {
    const auto mistake = [](const std::string& speeds) {
        const Mechanism m =
            build(parse_scene("[coordinates]\nx = 0.1\ny = 0.2\nz = 0.3\n[speeds]\n" + speeds +
                                  "[[particle]]\nname = \"P\"\nmass = 1\nposition = [\"x\", \"y\", \"z\"]\n"
                                  "[[constraint]]\nname = \"c\"\nnonholonomic = \"x' - y*z'\"\n",
                              "p.toml"));
        const std::optional<Diagnostic> found = mistake_in_speeds(m);
        return found ? found->message : "";
    };
    CHECK(mistake("u = \"x'\"\nv = \"y'\"\n").empty());
    CHECK(mistake("u = \"x'\"\nv = \"y' + x'\"\nw = \"y*z'\"\n").empty());
    CHECK(mistake("u = \"x'\"\n")
              .find("there is 1 generalized speed, and 3 coordinates with 1 independent constraint; expected 3 or "
                    "2") == 0);
    CHECK(mistake("u = \"x'\"\nv = \"z*x'\"\n").find("speed 'v' is a combination") == 0);
    CHECK(mistake("u = \"x' - y*z'\"\nv = \"y'\"\n")
              .find("the speeds and the constraints do not determine the rates: constraint 'c'") == 0);
}

TEST_CASE("speeds: a form that is not linear in the rates, and one without any, are refused") {
    const auto built = [](const std::string& form) {
        build(parse_scene("[coordinates]\nx = 0.1\n[speeds]\nu = \"" + form + "\"\n", "p.toml"));
    };
    CHECK_THROWS_WITH_AS(built("x'^2"), doctest::Contains("p.toml:4:6: speed 'u' is not linear in the rates"),
                         SceneError);
    CHECK_THROWS_WITH_AS(built("3*x"), doctest::Contains("p.toml:4:6: speed 'u' contains no rate"), SceneError);
    CHECK_NOTHROW(built("(1+x^2)*x' + t"));
}

TEST_CASE("kinematics: q' = h(q,u,t) inverts the forms and obeys what was eliminated") {
    for (const std::string& file : test::scenes_in("tests/odd")) {
        const Mechanism built = prepared(read_scene(file)).mechanism;
        if (built.speeds.empty()) continue;
        CAPTURE(file);
        const Equations e = kane(built);
        const Mechanism m = in_terms_of(e, built);
        GiNaC::exmap rates;
        for (int i = 0; i < m.size(); ++i) rates[m.qdot[i]] = m.z->expand(e.h[i]);
        const auto at_h = [&](const ex& value) { return m.z->expand(value).subs(rates); };
        for (std::size_t k = 0; k < m.speeds.size(); ++k) {
            // Divisions that the Fourier form does not see through: at numbers.
            GiNaC::exmap numbers{{m.t, ex(7) / 5}};
            for (int i = 0; i < m.size(); ++i) numbers[m.q[i]] = ex(i + 3) / 10;
            for (std::size_t j = 0; j < m.speeds.size(); ++j)
                numbers[m.speeds[j].u] = ex(static_cast<int>(j) + 2) / 7;
            for (const Mechanism::Parameter& p : m.parameters) numbers[p.symbol] = p.value;
            for (const Mechanism::Input& input : m.inputs)
                for (int order = 0; order < 3; ++order) numbers[input.derivative[order]] = ex(order + 1) / 3;
            const auto zero = [&](const ex& value) {
                return std::abs(GiNaC::ex_to<GiNaC::numeric>(at_h(value).subs(numbers).evalf()).to_double()) <
                       1e-12;
            };
            CHECK(zero(m.speeds[k].form - m.speeds[k].u));
            for (const Equations::Eliminated& gone : e.eliminated) {
                ex velocity = m.constraints[gone.constraint].offset;
                for (int i = 0; i < m.size(); ++i) velocity += m.constraints[gone.constraint].row[i] * m.qdot[i];
                CHECK(zero(velocity));
            }
        }
    }
}

TEST_CASE("emitted: a solver in speeds computes the same as the interpreter") {
    for (const char* name : {"scenes/textbook/ball_on_turntable.toml", "tests/odd/speeds_oblique.toml",
                             "tests/odd/speeds_with_multipliers.toml", "tests/odd/speeds_all_eliminated.toml"}) {
        CAPTURE(name);
        const Mechanism m = prepared(read_scene(test::source_path(name))).mechanism;
        const Program program = choose(m, kane(m)).program;
        const Module module = load(compile(emit(program).text, program.name, {}).object);
        const Start start = start_of(m);
        const Rhs rhs = make_rhs(module, start.parameters);
        const std::vector<double> par = prepared(module, start.parameters);
        const std::size_t n = m.q.size(), s = program.speeds.size(), c = m.constraints.size();
        REQUIRE(rhs.dimension == static_cast<int>(n + s));
        CHECK(rhs.names.back() == program.speeds.back().name);
        const unsigned seed = 7;
        CAPTURE(seed);
        std::mt19937_64 random(seed);
        int compared = 0;
        for (int k = 0; k < 32; ++k) {
            State<double> state = test::random_state(start, random);
            state.qdot.resize(s);
            std::vector<double> value = interpret(program, state), y = state.q, rate(n + s);
            for (const int id : program.nodes_of(Group::acceleration)) state.qddot.push_back(value[id]);
            value = interpret(program, state);
            y.insert(y.end(), state.qdot.begin(), state.qdot.end());
            rhs(state.t, y.data(), rate.data());
            std::vector<double> found = rate, expected, position(c), velocity(c), rows(c * (n + s)), lambda(c),
                                mass(s * s), forcing(s);
            const auto expect = [&](Group group) {
                for (const int id : program.nodes_of(group)) expected.push_back(value[id]);
            };
            const auto take = [&](const std::vector<double>& numbers) {
                found.insert(found.end(), numbers.begin(), numbers.end());
            };
            expect(Group::rate);
            expect(Group::acceleration);
            module.table().constraints_at(state.t, y.data(), par.data(), position.data(), velocity.data(),
                                          rows.data());
            module.table().multipliers_at(state.t, y.data(), par.data(), lambda.data());
            module.table().mass_forcing(state.t, y.data(), par.data(), mass.data(), forcing.data());
            std::vector<double> outputs(program.nodes_of(Group::output).size() + m.speeds.size());
            module.table().outputs_at(state.t, y.data(), rate.data(), par.data(), outputs.data());
            for (const auto* numbers : {&position, &velocity, &rows, &lambda, &forcing, &outputs}) take(*numbers);
            for (const Group group : {Group::position, Group::velocity, Group::row, Group::speed_row,
                                      Group::multiplier, Group::forcing, Group::output, Group::speed})
                expect(group);
            REQUIRE(found.size() == expected.size());
            double size = 1;
            for (const double x : expected) size = std::max(size, std::abs(x));
            if (!std::isfinite(size)) continue;
            ++compared;
            for (std::size_t i = 0; i < found.size(); ++i) CHECK(std::abs(found[i] - expected[i]) <= 1e-12 * size);
        }
        CHECK(compared > 16);
    }
}

TEST_CASE("cancelled: removable poles disappear, others stay, and the value never changes") {
    const Mechanism m = build(parse_scene("[coordinates]\nx = 0.3\ny = 0.7\n", "p.toml"));
    const ex x = m.q[0], y = m.q[1];
    const auto result = [&](const ex& e) { return m.z->expand(cancelled(m.z->name(e), m)); };
    CHECK(result((1 - pow(cos(x), 2)) / sin(x)).is_equal(sin(x)));
    CHECK(result(sin(2 * x) / cos(x)).is_equal(2 * sin(x)));
    CHECK(result(y * pow(sin(x), 3) / cos(x) + y * sin(x) * cos(x)).has(pow(cos(x), -1)));
    CHECK(result((cos(3 * y) - cos(y)) / (sin(y) * sin(x))).has(pow(sin(x), -1)));
    for (const ex& e :
         {(1 - pow(cos(x), 2)) / sin(x), sin(2 * x) / cos(x), y * pow(sin(x), 3) / cos(x) + y * sin(x) * cos(x),
          (cos(3 * y) - cos(y)) / (sin(y) * sin(x)), (1 + cos(x)) / sin(x),
          1 / (2 + sin(x)) - sin(-2 * y) / cos(y)}) {
        CAPTURE(e);
        const GiNaC::exmap at{{x, ex(3) / 10}, {y, ex(7) / 10}};
        const ex difference = (result(e) - e).subs(at).evalf();
        CHECK(std::abs(GiNaC::ex_to<GiNaC::numeric>(difference).to_double()) < 1e-13);
    }
}

TEST_CASE("lagrange1: it gives Newton's law with multipliers, or says what is missing") {
    const Mechanism m = textbook("cartesian_pendulum");
    const Derivation shown = derivation_of(m, lagrange1(m));
    CHECK(text(shown.equations[0].lhs) + " = " + text(shown.equations[0].rhs) == "m*x'' = 2*x*lambda_rod");
    CHECK(text(shown.equations[1].lhs) + " = " + text(shown.equations[1].rhs) == "m*y'' + m*g = 2*y*lambda_rod");
    CHECK(agree({routh(m), lagrange1(m)}, m).normal_form);

    const auto refuses = [](const Mechanism& mechanism, const char* reason) {
        CHECK_THROWS_WITH_AS(lagrange1(mechanism), doctest::Contains(reason), ModelError);
    };
    refuses(textbook("double_pendulum"),
            "particle M1 is at (l1*sin(theta1), l1*cos(theta1)); give it coordinates x, y");
    refuses(textbook("falling_ladder"), "body ladder turns");
    refuses(textbook("magnetic_field"), "[energy] lagrangian");
    const auto scene = [](const char* positions) {
        return build(parse_scene(std::string("[coordinates]\nx = 0.1\ny = 0.2\n") + positions, "p.toml"));
    };
    refuses(scene("[[particle]]\nname = \"P\"\nmass = 1\nposition = [\"x\", 0]\n"), "'y' is none");
    refuses(scene("[[particle]]\nname = \"P\"\nmass = 1\nposition = [\"x\", \"y\"]\n"
                  "[[particle]]\nname = \"Q\"\nmass = 1\nposition = [\"x + 1\", 0]\n"),
            "'x' belongs to particle P and to particle Q");
    CHECK_NOTHROW(lagrange1(scene("[[particle]]\nname = \"P\"\nmass = 1\nposition = [\"x - 1/2\", \"y\", 3]\n")));
}

}  // namespace formalism_speeds
