// SPDX-License-Identifier: MIT
// What every row of the table of formalisms promises, and the origins of a mechanism's parts.
#include <doctest/doctest.h>

#include "formalism/formalisms.hpp"
#include "model/mechanism.hpp"
#include "scenes.hpp"
#include "state/prepared.hpp"

namespace formalism_table {

using namespace alembert;

namespace {

std::vector<std::string> all_scenes() {
    std::vector<std::string> files;
    for (const char* folder : {"scenes/textbook", "tests/odd"})
        for (const std::string& file : test::scenes_in(folder)) files.push_back(file);
    return files;
}

}  // namespace

TEST_CASE("formalisms: a derivation throws the obstacle, and there is none where it does not throw") {
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
    CHECK(applied > 200);
    CHECK(refused > 50);
}

TEST_CASE("formalisms: a name that is none is refused with all that are") {
    CHECK_THROWS_WITH_AS(formalism("newton"), doctest::Contains(formalism_names().c_str()), ModelError);
    for (const Formalism& f : formalisms()) CHECK(&formalism(f.name) == &f);
}

TEST_CASE("formalisms: speeds that a scene names are no rates, even where each is one") {
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
