// SPDX-License-Identifier: MIT
// Maggi's equations against closed forms of nonholonomic systems and against other routes.
#include <doctest/doctest.h>

#include "analysis/agree/agree.hpp"
#include "mechanisms.hpp"
#include "model/formalism/maggi.hpp"
#include "model/formalism/routh.hpp"

namespace formalism_maggi {

using namespace alembert;
using namespace alembert::test;

// Chaplygin's sleigh: v' = a w², (J + m a²) w' = −m a v w (Neimark & Fufaev, Dynamics of Nonholonomic Systems
// (1972)).
TEST_CASE("maggi: the sleigh's equations are the closed ones, without a multiplier") {
    const Mechanism m = textbook("chaplygin_sleigh_in_speeds");
    const Equations e = maggi(m);
    CHECK(e.A.empty());
    CHECK(e.poles.empty());
    CHECK(equations_of(m, e) ==
          "v' - a*w^2 = 0\n(J+m*a^2)*w' + m*a*v*w = 0\nx' = v*cos(phi)\ny' = v*sin(phi)\nphi' = w\n");
}

// The coin that rolls upright on a slope: (J1 + m r²) φ'' = m g r sin β cos θ, θ'' = 0; the friction is Newton's
// (routh).
TEST_CASE(
    "maggi: the rolling coin's equations are the closed ones, and the kernel is that of its two constraints") {
    const Mechanism m = textbook("coin");
    const Equations e = maggi(m);
    CHECK(e.A.empty());
    CHECK(equations_of(m, e) ==
          "theta'' = 0\n(J1+m*r^2)*phi'' - m*g*r*sin(beta)*cos(theta) = 0\n"
          "x' = r*phi'*cos(theta)\ny' = r*phi'*sin(theta)\n");
    std::string columns;
    const OwnSteps steps = steps_of_maggi(m, e);
    for (const Statement& s : steps.sections.at(0).statements)
        columns += text(*s.by) + ": " + text(s.value) + "\n";
    CHECK(columns == "theta': (0,0,1,0)\nphi': (r*cos(theta),r*sin(theta),0,1)\n");
    CHECK(agree({routh(m), e}, m).verdict == Agreement::Verdict::proved);
}

// Energies without bodies are enough.
TEST_CASE("maggi: a disc given by its energies rolls down, x'' = 2/3 g sin β") {
    const Mechanism m = textbook("rolling_disc");
    const Equations e = maggi(m);
    REQUIRE(e.size() == 1);
    CHECK(agree({routh(m), e}, m).verdict == Agreement::Verdict::proved);
    const GiNaC::ex acceleration = e.z->expand(e.forcing(0)) / e.z->expand(e.M(0, 0));
    const GiNaC::ex g = m.parameters[2].symbol, beta = m.parameters[3].symbol, r = m.parameters[1].symbol;
    const GiNaC::ex closed = GiNaC::ex(2) / 3 * g * sin(beta) / (e.u[0].get_name() == "phi'" ? r : GiNaC::ex(1));
    CHECK((acceleration - closed).normal().is_zero());
}

}  // namespace formalism_maggi
