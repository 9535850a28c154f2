// SPDX-License-Identifier: MIT
// The Gibbs-Appell equations against closed forms of nonholonomic systems and against other routes.
#include <doctest/doctest.h>

#include "analysis/agree/agree.hpp"
#include "mechanisms.hpp"
#include "model/formalism/appell.hpp"
#include "model/formalism/kane.hpp"
#include "model/formalism/routh.hpp"

namespace formalism_appell {

using namespace alembert;
using namespace alembert::test;

// Chaplygin's sleigh, a the distance from the blade to the mass centre: v' = a w², (J + m a²) w' = −m a v w
// (Neimark & Fufaev, Dynamics of Nonholonomic Systems (1972)).
TEST_CASE("appell: the sleigh's equations are the closed ones, without a multiplier") {
    const Mechanism m = textbook("chaplygin_sleigh_in_speeds");
    const Equations e = appell(m);
    CHECK(e.A.empty());
    CHECK(e.poles.empty());
    CHECK(equations_of(m, e) ==
          "v' - a*w^2 = 0\n(J+m*a^2)*w' + m*a*v*w = 0\nx' = v*cos(phi)\ny' = v*sin(phi)\nphi' = w\n");
}

// S = m ((v' − a w²)² + (a w' + v w)²)/2 + J w'²/2.
TEST_CASE("appell: the sleigh's S is differentiated by its accelerations") {
    const Mechanism m = textbook("chaplygin_sleigh_in_speeds");
    const Equations e = appell(m);
    const OwnSteps steps = steps_of_appell(in_terms_of(e, m), e);
    REQUIRE(steps.sections.size() == 2);
    REQUIRE(steps.sections[0].equalities.size() == 1);
    std::vector<std::string> slopes;
    for (const Statement& s : steps.sections[1].statements)
        if (s.kind == Statement::Kind::partial) slopes.push_back(text(*s.by) + ": " + text(s.value));
    CHECK(slopes == std::vector<std::string>{"v': m*v' - m*a*w^2", "w': (J+m*a^2)*w' + m*a*v*w"});
}

// A disc that rolls in space turns about three axes: α·(ω × I ω) is in it.
TEST_CASE("appell: the rolling disc in space is that of Routh's and Kane's equations") {
    const Mechanism m = textbook("rolling_disc_in_space");
    const Equations e = appell(m);
    CHECK(e.A.empty());
    CHECK(agree({routh(m), e, kane(m)}, m).verdict == Agreement::Verdict::proved);
}

TEST_CASE("appell: energies without bodies have no accelerations") {
    CHECK(obstacle_to_appell(textbook("rolling_disc")).value().find("[energy] kinetic") != std::string::npos);
}

}  // namespace formalism_appell
