// SPDX-License-Identifier: MIT
// The properties that every row of the table of formalisms must have, and the origins of a mechanism's parts.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <algorithm>

#include "algebra/notation/text.hpp"
#include "analysis/agree/agree.hpp"
#include "analysis/audit/audit.hpp"
#include "analysis/derive/derivation.hpp"
#include "analysis/state/prepared.hpp"
#include "check/check.hpp"
#include "model/energy.hpp"
#include "model/formalism/formalisms.hpp"
#include "model/formalism/kane.hpp"
#include "model/formalism/lagrange.hpp"
#include "model/formalism/needs.hpp"
#include "model/formalism/routh.hpp"
#include "model/mechanism.hpp"
#include "program/interpret.hpp"
#include "program/lower/choose.hpp"
#include "program/lower/inverse.hpp"
#include "program/lower/lower.hpp"
#include "program/lower/start.hpp"
#include "scenes.hpp"

namespace formalism_table {

using namespace alembert;

namespace {

std::vector<std::string> all_scenes() {
    std::vector<std::string> files;
    for (const char* folder : {"scenes/textbook", "tests/odd"})
        for (const std::string& file : test::every_third(test::scenes_in(folder), 1)) files.push_back(file);
    return files;
}

}  // namespace

TEST_CASE("formalisms: a derivation throws if and only if there is an obstacle") {
    int applied = 0, refused = 0;
    for (const std::string& file : all_scenes()) {
        CAPTURE(file);
        const Mechanism m = prepared(read_scene(file)).mechanism;
        for (const Formalism& f : formalisms()) {
            CAPTURE(f.name);
            const std::optional<std::string> obstacle = f.obstacle(m);
            if (obstacle) {
                ++refused;
                CHECK_THROWS_WITH_AS(f.derive(m), obstacle->c_str(), ModelError);
                CHECK(obstacle->find("--") == std::string::npos);  // a library knows no command line
                continue;
            }
            ++applied;
            const Equations e = f.derive(m);
            CHECK(e.formalism == f.name);
            REQUIRE(e.h.size() == m.q.size());
            REQUIRE(e.form.size() == e.u.size());
            for (std::size_t i = 0; i < e.h.size() && e.speeds_are_rates(); ++i) {
                CHECK(e.h[i].is_equal(m.qdot[i]));
                CHECK(e.u[i] == m.qdot[i]);
            }
        }
    }
    CHECK(applied > test::at_least(200));
    CHECK(refused > test::at_least(50));
}

TEST_CASE("formalisms: the one that is taken for a need has what is needed, wherever it applies") {
    int with_multipliers = 0, minimal = 0, trees = 0;
    for (const std::string& file : all_scenes()) {
        CAPTURE(file);
        const Mechanism m = prepared(read_scene(file)).mechanism;
        const Formalism& in_rates = formalism_in_rates(m);
        CHECK(&in_rates == &formalism_for(m.constraints.empty() ? Need::independent : Need::multipliers));
        if (!in_rates.obstacle(m)) {
            const Equations e = in_rates.derive(m);
            CHECK(e.speeds_are_rates());
            CHECK(e.lambda.size() == m.constraints.size());
            if (!m.constraints.empty()) ++with_multipliers;
        }
        const Formalism& in_speeds = formalism_for(Need::minimal_speeds);
        const auto nonholonomic = static_cast<std::size_t>(
            std::count_if(m.constraints.begin(), m.constraints.end(), [](const auto& c) { return !c.holonomic; }));
        if (!in_speeds.obstacle(m)) {
            const Equations e = in_speeds.derive(m);
            CHECK(e.lambda.size() <= m.constraints.size() - nonholonomic);  // less that of a norm
            CHECK(e.u.size() <= m.q.size() - nonholonomic);
            minimal += nonholonomic > 0 ? 1 : 0;
        }
        const Formalism& fastest = formalism_for(Need::fastest);
        if (!fastest.obstacle(m)) {
            CHECK(fastest.derive(m).tree);
            ++trees;
        }
    }
    CHECK(with_multipliers > test::at_least(10));
    CHECK(minimal > test::at_least(5));
    CHECK(trees > test::at_least(5));
}

TEST_CASE("formalisms: a mechanism is the same after derivations, comparisons and checks") {
    for (const char* const name : {"double_pendulum", "chaplygin_sleigh_in_speeds", "rolling_disc_in_space",
                                   "watt_governor", "coin", "rolling_disc"}) {
        CAPTURE(std::string(name));
        const Scene scene = read_scene(test::source_path(fmt::format("scenes/textbook/{}.toml", name)));
        const Mechanism m = prepared(scene).mechanism;
        const std::size_t entries = m.z->entries().size(), labels = m.z->source_labels().size();
        const auto same = [&] {
            return m.z->entries().size() == entries && m.z->source_labels().size() == labels;
        };
        for (const Formalism& f : formalisms()) {
            CAPTURE(f.name);
            const std::optional<std::string> obstacle = f.obstacle(m);
            CHECK(same());
            if (obstacle) continue;
            const Equations e = f.derive(m);
            CHECK(same());
            CHECK(e.z->entries().size() > entries);
            derivation_of(m, e, f);
            CHECK(same());
        }
        CHECK(agree(derive_all(m).equations, m).verdict == Agreement::Verdict::proved);
        CHECK(same());
        const Equations equations = routh(m);
        const std::size_t own = equations.z->entries().size();
        const Energy energy = energy_of(m);
        CHECK(energy.z->entries().size() > entries);
        CHECK(same());
        CHECK(lower(m, equations, energy).size() > 0);
        CHECK(same());
        CHECK(choose(m, equations).program.size() > 0);
        CHECK(same());
        CHECK(lower_inverse(m).size() > 0);
        CHECK(same());
        CHECK(start_of(m).q.size() == m.q.size());
        CHECK(same());
        CHECK(audit_of(m).degrees_of_freedom > 0);
        CHECK(same());
        CHECK(equations.z->entries().size() == own);
        CHECK_FALSE(check(scene, m).claims.empty());
        CHECK(same());
        // After all this, Lagrange's equations are the same as those of a new mechanism.
        const Mechanism untouched = prepared(scene).mechanism;
        const Derivation late = derivation_of(m, routh(m)), early = derivation_of(untouched, routh(untouched));
        REQUIRE(late.equations.size() == early.equations.size());
        for (std::size_t i = 0; i < late.equations.size(); ++i) {
            CHECK(text(late.equations[i].lhs) == text(early.equations[i].lhs));
            CHECK(text(late.equations[i].rhs) == text(early.equations[i].rhs));
        }
    }
}

TEST_CASE("formalisms: equations with tables of their own are compared, lowered and refuted like those with one") {
    const Mechanism m = prepared(read_scene(test::source_path("scenes/textbook/double_pendulum.toml"))).mechanism;
    const Equations first = lagrange(m), second = kane(m);
    CHECK(first.z != second.z);
    const Agreement result = agree({first, second}, m);
    CHECK(result.verdict == Agreement::Verdict::proved);
    CHECK(result.normal_form);
    Equations wrong = second;
    wrong.own[0] = wrong.z->name(wrong.own[0] + m.qdot[1]);
    CHECK(agree({first, wrong}, m).verdict == Agreement::Verdict::refuted);
    // The energies are named in the mechanism's table, after the derivation.
    const Energy energy = energy_of(m);
    const Program a = lower(m, first, energy), b = lower(m, second, energy);
    State<double> state = start_of(m).state();
    for (double& rate : state.qdot) rate += 0.5;
    const std::vector<double> x = interpret(a, state), y = interpret(b, state);
    for (const Group group : {Group::acceleration, Group::energy, Group::power})
        for (std::size_t k = 0; k < a.nodes_of(group).size(); ++k)
            CHECK(x[a.nodes_of(group)[k]] == doctest::Approx(y[b.nodes_of(group)[k]]).epsilon(1e-12));
}

TEST_CASE("formalisms: an unknown name is refused with a list of all names") {
    CHECK_THROWS_WITH_AS(formalism("newton"), doctest::Contains(formalism_names().c_str()), ModelError);
    for (const Formalism& f : formalisms()) CHECK(&formalism(f.name) == &f);
}

TEST_CASE("formalisms: named speeds of a scene never count as rates, even if each is one") {
    const Mechanism m = build(parse_scene(R"(
        [parameters]
        m = 1.0
        [coordinates]
        x = {}
        [speeds]
        v = { form = "x'" }
        [[particle]]
        name = "P"
        mass = "m"
        position = ["x", 0]
    )",
                                          "named.toml"));
    CHECK_FALSE(formalism("kane").derive(m).speeds_are_rates());
    CHECK(formalism("lagrange").derive(m).speeds_are_rates());
}

TEST_CASE("origins: each part of a mechanism knows its kind and its row in the scene") {
    const Mechanism m = build(parse_scene(R"(
        gravity = [0, -9.81]
        [coordinates]
        x = {}
        y = {}
        [[particle]]
        name = "gravity"
        mass = 1
        position = ["x", "y"]
        [[spring]]
        along = "x"
        stiffness = 2
        [[spring]]
        along = "y"
        stiffness = 3
        [[force]]
        at = "gravity"
        vector = [1, 0]
    )",
                                          "origins.toml"));
    REQUIRE(m.potential.size() == 3);
    CHECK(m.potential[0].origin.kind == Origin::Kind::gravity);
    CHECK(label(m.potential[0].origin) == "gravity on particle gravity");
    CHECK(m.potential[2].origin.kind == Origin::Kind::spring);
    CHECK(m.potential[2].origin.index == 1);
    CHECK(label(m.potential[2].origin) == "spring 2");
    REQUIRE(m.loads.size() == 1);
    CHECK(m.loads[0].origin.kind == Origin::Kind::force);
    CHECK(label(m.loads[0].origin) == "force 1 at gravity");
}

}  // namespace formalism_table
