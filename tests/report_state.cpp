// SPDX-License-Identifier: MIT
// States as people write them.
#include <doctest/doctest.h>

#include "present/report/state_text.hpp"

namespace report_state {

using alembert::as_written;

TEST_CASE("report: numbers of a state have four digits, and angles are in degrees") {
    CHECK(as_written("m", "3") == "m = 3");
    CHECK(as_written("x", "-21/20") == "x = -1.05");
    CHECK(as_written("x", "-1/3") == "x ≈ -0.3333");
    CHECK(as_written("x''", "123456789/1000") == "x'' ≈ 1.235e+05");
    CHECK(as_written("x", "100000000") == "x = 100000000");
    CHECK(as_written("x", "2.8284271247461903") == "x ≈ 2.828");
    CHECK(as_written("theta", "2*atan(2/3)") == "theta ≈ 67.38°");
    CHECK(as_written("theta", "2*atan(-1)") == "theta = -90°");
    CHECK(as_written("theta", "2*atan(0.41421356237309503)") == "theta ≈ 45°");
    CHECK(as_written("t", "2*atan(1/2)") == "t ≈ 0.9273");
    CHECK(as_written("phi", "pi") == "phi = pi");
    CHECK(as_written("phi", "3.1415926535897931") == "phi = pi");
    CHECK(as_written("phi", "-2.0943951023931953") == "phi = -2*pi/3");
    CHECK(as_written("phi", "3.1415926535897") == "phi ≈ 3.142");
    // A fraction of many digits.
    const std::string many(400, '7');
    CHECK(as_written("x", many + "/" + many + "1") == "x ≈ 0.1");
    CHECK(as_written("x", "-" + many) == "x ≈ -7.777e+399");
    CHECK(as_written("x", many + "0/7") == "x ≈ 1.111e+400");
    CHECK(as_written("x", "1" + std::string(30, '0') + "1/7") == "x ≈ 1.429e+30");
}

TEST_CASE("report: the state of a claim in speeds is told in speeds, and each other one whole") {
    const std::vector<std::pair<std::string, std::string>> state{{"A", "1"},     {"psi", "2"}, {"psi'", "3"},
                                                                 {"psi''", "4"}, {"wx", "5"},  {"wx'", "6"}};
    CHECK(alembert::text_of_state(state, "A*wx' = 0") == "A = 1, psi = 2, wx = 5, wx' = 6");
    CHECK(alembert::text_of_state(state, "A*wx' = psi'") ==
          "A = 1, psi = 2, psi' = 3, psi'' = 4, wx = 5, wx' = 6");
    CHECK(alembert::text_of_state(state, "psi = wx1") == "A = 1, psi = 2, psi' = 3, psi'' = 4, wx = 5, wx' = 6");
}

}  // namespace report_state
