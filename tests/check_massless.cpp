// SPDX-License-Identifier: MIT
// Rates that no inertia resists: their equations say that forces are in balance, or nothing.
#include <doctest/doctest.h>

#include "analysis/audit/audit.hpp"
#include "analysis/derive/derived.hpp"
#include "analysis/state/force_balance.hpp"
#include "checked.hpp"
#include "model/formalism/routh.hpp"

namespace check_massless {

using namespace alembert;
using namespace alembert::test;

namespace {

constexpr Verdict proved = Verdict::proved, refuted = Verdict::refuted;

struct Expected {
    std::string claim;
    Verdict verdict;
};

void check_expected(const std::string& scene, const std::vector<Expected>& expected) {
    std::string text = scene;
    for (const Expected& e : expected) text += "[[claim]]\nequation = \"" + e.claim + "\"\n";
    const Checked result = checked(parse_scene(text, "massless.toml"));
    for (std::size_t k = 0; k < expected.size(); ++k) {
        CAPTURE(expected[k].claim);
        CHECK(result.claims[k].verdict == expected[k].verdict);
        for (const auto& [name, value] : result.claims[k].counterexample)
            CHECK(name.find("balance") == std::string::npos);
        CHECK(result.claims[k].nearest.find("balance") == std::string::npos);
    }
}

std::vector<std::string> warnings_of(const std::string& scene) {
    const Derived d = derived(parse_scene(scene, "massless.toml"));
    CHECK(audit(parse_scene(scene, "massless.toml")).warnings.size() == d.warnings.size());
    return d.warnings;
}

const std::string
    numbers =
        "allow = [\"unused\"]\n[parameters]\nm = 1\nk = 1\nk2 = 2\nc = 0.5\n[coordinates]\nx = 0.1\ny = 0.2\n",
    on_x = "[[particle]]\nname = \"P\"\nmass = \"m\"\nposition = [\"x\", 0]\n",
    in_between = numbers + on_x + "[[spring]]\nalong = \"x-y\"\nstiffness = \"k\"\n";

}  // namespace

TEST_CASE("check: a massless end of a spring is where the spring is slack") {
    check_expected(in_between, {{"m*x'' + k*(x-y) = 0", proved},
                                {"x = y", proved},
                                {"m*x'' = 0", proved},
                                {"y'' = x''", proved},
                                {"x = 2*y", refuted},
                                {"m*x'' + k*(x+y) = 0", refuted},
                                {"1 = 0", refuted},
                                {"m*x'' = k", refuted}});
    const auto warnings = warnings_of(in_between);
    REQUIRE(warnings.size() == 1);
    CHECK(warnings[0].find("no inertia resists y'") != std::string::npos);
    CHECK(warnings[0].find("k*(x-y) = 0") != std::string::npos);
}

// In series, springs have the stiffness k k2/(k + k2), and a spring and a damper are Maxwell's element.
TEST_CASE("check: a massless node between a spring and a damper, or two springs, obeys the series laws") {
    check_expected(in_between + "[[spring]]\nalong = \"y\"\nstiffness = \"k2\"\n",
                   {{"m*x'' + k*k2/(k+k2)*x = 0", proved},
                    {"y = k/(k+k2)*x", proved},
                    {"m*x'' + (k+k2)*x = 0", refuted},
                    {"m*x'' + k*x = 0", refuted}});
    check_expected(in_between + "[[damper]]\nalong = \"y\"\ndamping = \"c\"\n", {{"m*x'' + k*(x-y) = 0", proved},
                                                                                 {"c*y' = k*(x-y)", proved},
                                                                                 {"m*x'' + c*y' = 0", proved},
                                                                                 {"c*y'' + k*y' = k*x'", proved},
                                                                                 {"m*x'' - c*y' = 0", refuted},
                                                                                 {"y'' = 0", refuted}});
}

TEST_CASE("check: coordinates whose sum alone has inertia share a force") {
    const std::string scene = numbers +
                              "[[particle]]\nname = \"P\"\nmass = \"m\"\nposition = [\"x+y\", 0]\n"
                              "[[spring]]\nalong = \"x\"\nstiffness = \"k\"\n"
                              "[[spring]]\nalong = \"y\"\nstiffness = \"k2\"\n";
    check_expected(scene, {{"m*(x''+y'') + k*x = 0", proved},
                           {"k*x = k2*y", proved},
                           {"m*(k+k2)*x'' + k*k2*x = 0", proved},
                           {"m*(x''+y'') + k2*x = 0", refuted}});
    CHECK(warnings_of(scene).size() == 1);
}

TEST_CASE("check: what no inertia resists and no force moves may do anything, and the rest is proved") {
    const std::string scene = numbers + on_x + "[[spring]]\nalong = \"x\"\nstiffness = \"k\"\n";
    check_expected(scene, {{"m*x'' + k*x = 0", proved}, {"y'' = 0", refuted}, {"m*x'' - k*x = 0", refuted}});
    const std::string spin =
        "gravity = [0, \"-g\"]\n[parameters]\nm = 1\nl = 1\ng = 9.81\n[coordinates]\nq1 = 0.3\nq2 = 0.2\nq3 = "
        "0.1\n"
        "[speeds]\nu1 = \"dot(omega(A),ex(A))\"\nu2 = \"dot(omega(A),ey(A))\"\nu3 = \"dot(omega(A),ez(A))\"\n"
        "[[frame]]\nname = \"A\"\nrotate = [[\"z\", \"q1\"], [\"x\", \"q2\"], [\"y\", \"q3\"]]\n"
        "[[particle]]\nname = \"P\"\nmass = \"m\"\nposition = [0, \"-l\", 0]\naxes = \"A\"\n";
    check_expected(spin, {{"l*u1' + l*u2*u3 + g*cos(q1)*sin(q2)*cos(q3) - g*sin(q1)*sin(q3) = 0", proved},
                          {"l*u3' - l*u1*u2 + g*cos(q1)*sin(q2)*sin(q3) + g*sin(q1)*cos(q3) = 0", proved},
                          {"l*u3' + l*u1*u2 + g*cos(q1)*sin(q2)*sin(q3) + g*sin(q1)*cos(q3) = 0", refuted},
                          {"u2' = 0", refuted}});
    const auto warnings = warnings_of(spin);
    REQUIRE(warnings.size() == 1);
    CHECK(warnings[0].find("no inertia resists u2") != std::string::npos);
}

TEST_CASE("unresisted rates: none where inertia or constraints leave none, and not at special poses alone") {
    const auto count = [](const std::string& scene) {
        const Prepared p = prepared(parse_scene(scene, "massless.toml"));
        return unresisted_rates(p.mechanism, routh(p.mechanism)).size();
    };
    CHECK(count(in_between) == 1);
    CHECK(count(in_between + "[[particle]]\nname = \"Q\"\nmass = 1\nposition = [\"y\", 0]\n") == 0);
    CHECK(count(in_between + "[[constraint]]\nname = \"tie\"\nholonomic = \"y - 2*x\"\n") == 0);
    CHECK(count(numbers + "[[particle]]\nname = \"P\"\nmass = \"m\"\nposition = [\"x\", \"y^2\"]\n") == 0);
    CHECK(count(numbers + "[[particle]]\nname = \"P\"\nmass = \"m\"\nposition = [\"x*y\", 0]\n") == 1);
}

}  // namespace check_massless
