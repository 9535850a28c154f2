// SPDX-License-Identifier: MIT
// The scenes of scenes/stability: their claims, and where stability ends, against formulas of their own.
#include <doctest/doctest.h>

#include <cmath>

#include "alembert/base/error.hpp"
#include "check/check.hpp"
#include "scenes.hpp"
#include "stability/locus.hpp"

namespace stability_scenes {

using namespace alembert;

namespace {

using V = StabilityVerdict;
using T = StabilityTheorem;

Scene scene(const std::string& name) {
    return read_scene(test::source_path("scenes/stability/" + name + ".toml"));
}

Stability judged(const std::string& name, const std::vector<std::pair<std::string, std::string>>& at = {}) {
    StabilityOptions options{.exact_at = at};
    for (const auto& [what, number] : at) options.at.emplace_back(what, std::stod(number));
    return stability(scene(name), options);
}

/// The first root of f between a and b.
template <typename F>
double bisected(const F& f, double a, double b) {
    for (int k = 0; k < 100; ++k) {
        const double middle = (a + b) / 2;
        ((f(middle) > 0) == (f(a) > 0) ? a : b) = middle;
    }
    return (a + b) / 2;
}

/// The only value at which the locus leaves or reaches stability.
double critical(const std::string& name, const Axis& axis, const Overrides& at = {}) {
    const RootLocus locus = root_locus(scene(name), axis, {.stability = {.at = at}});
    REQUIRE(locus.crossings.size() == 1);
    return locus.crossings[0].value;
}

}  // namespace

// The centre turns with 2/7 of the table's rate; the axis of the ball, which rolls at its place x, with the rate Ω
// x/a.
TEST_CASE(
    "stability: eigenvalues on the axis stand in the order of their frequencies, whatever their roundings are") {
    const Stability s = stability(read_scene(test::source_path("scenes/textbook/turntable_ball.toml")));
    REQUIRE(s.eigenvalues.size() == 8);
    const double spin = 3.5 * 0.53 / 0.2, expected[] = {-spin, -1, 0, 0, 0, 0, 1, spin};
    for (std::size_t k = 0; k < 8; ++k) {
        CAPTURE(k);
        CHECK(std::abs(s.eigenvalues[k].value - std::complex<double>(0, expected[k])) <=
              s.eigenvalues[k].radius + 1e-15);
    }
}

TEST_CASE("stability: a state that is steady for these parameters alone has no conditions in the parameters") {
    const Scene spring = parse_scene(R"toml(
[parameters]
k = 2.0
c = 3.0
[coordinates]
x = "sqrt(k/c)"
[[particle]]
name = "p"
mass = 1
position = ["x", 0]
[[force]]
at = "p"
vector = ["k - c*x^2", 0]
)toml",
                                     "spring.toml");
    CHECK(!stability(spring, {}).conditions.empty());
    CHECK(stability(spring, {.at = {{"x", 0.816496580927726}}, .exact_at = {{"x", "0.816496580927726"}}})
              .conditions.empty());
}

TEST_CASE("scenes of stability: every claim is proved, and each scene says where it is from and how to run it") {
    const std::vector<std::string> files = test::scenes_in("scenes/stability");
    CHECK(files.size() == 14);
    for (const std::string& file : files) {
        CAPTURE(file);
        const Scene one = read_scene(file);
        CHECK(!one.title.empty());
        CHECK(!one.source.empty());
        CHECK(one.notes.find("alembert stability scenes/stability/") != std::string::npos);
        if (one.claims.empty()) continue;
        for (const CheckedClaim& claim : check(one).checked.claims) CHECK(claim.verdict == Verdict::proved);
    }
}

TEST_CASE("scenes of stability: the verdicts, each by its theorem") {
    struct Expected {
        std::string name;
        std::vector<std::pair<std::string, std::string>> at;
        V verdict;
        T theorem;
    };
    const std::vector<Expected> all{
        {"dead_zone", {}, V::stable, T::malkin},
        {"governor", {}, V::asymptotically_stable, T::first_approximation},
        {"governor", {{"b", "0.1"}}, V::unstable, T::first_approximation},
        {"gyroscopic", {}, V::stable, T::jordan},
        {"gyroscopic", {{"G", "2"}}, V::unstable, T::jordan},
        {"gyroscopic", {{"c", "0.01"}}, V::unstable, T::kelvin_chetaev},
        {"hoop", {{"c", "0.9"}}, V::stable, T::jacobi},
        {"hoop", {}, V::stable, T::potential_form},
        {"hoop", {{"c", "1.1"}}, V::unstable, T::first_approximation},
        {"kapitza", {}, V::undecided, T::none},
        {"kapitza", {{"c", "0.1"}}, V::asymptotically_stable, T::floquet},
        {"kapitza", {{"c", "0.1"}, {"above", "0.9"}}, V::unstable, T::floquet},
        {"mathieu", {}, V::unstable, T::floquet},
        {"mathieu", {{"a", "3"}}, V::stable, T::floquet},
        {"rolling_disc", {{"w", "2"}}, V::unstable, T::first_approximation},
        {"rolling_disc", {{"w", "2.557"}}, V::unstable, T::first_approximation},
        {"rolling_disc", {{"w", "2.558"}}, V::stable, T::reversible},
        // On the spot: psi'^2 > 4 g/(5 r) = 15.696 (O'Reilly 1996).
        {"rolling_disc", {{"w", "6"}, {"psi'", "3"}, {"theta", "-0.7731047471038887"}}, V::stable, T::reversible},
        {"rolling_disc", {{"w", "0"}, {"psi'", "3.961"}}, V::unstable, T::first_approximation},
        {"rolling_disc", {{"w", "0"}, {"psi'", "3.962"}}, V::stable, T::reversible},
        {"sleeping_top", {{"psi'", "4.001"}}, V::stable, T::chetaev_integrals},
        {"sleeping_top", {{"psi'", "3.999"}}, V::unstable, T::first_approximation},
        {"standing_double_pendulum", {{"k", "34"}}, V::stable, T::lagrange_dirichlet},
        {"standing_double_pendulum", {{"k", "33"}}, V::unstable, T::first_approximation},
        {"standing_triple_pendulum", {{"k", "80"}}, V::stable, T::lagrange_dirichlet},
        {"standing_triple_pendulum", {{"k", "79"}}, V::unstable, T::first_approximation},
        {"tippe_top", {{"psi'", "25"}}, V::stable, T::malkin},
        {"tippe_top", {{"psi'", "26"}}, V::unstable, T::first_approximation},
        {"triangular_point", {}, V::stable, T::arnold},
        {"triangular_point", {{"mu", "0.039"}}, V::unstable, T::first_approximation},
        {"ziegler", {{"P", "2.09"}}, V::unstable, T::first_approximation},
        {"ziegler", {{"P", "1.4"}, {"c", "0.01"}}, V::asymptotically_stable, T::first_approximation},
    };
    for (const Expected& one : all) {
        CAPTURE(one.name);
        const Stability s = judged(one.name, one.at);
        CAPTURE(s.reason);
        CHECK(std::string(name_of(s.verdict)) == name_of(one.verdict));
        CHECK(std::string(name_of(s.theorem)) == name_of(one.theorem));
    }
}

TEST_CASE("scenes of stability: the engine's governor needs the damping of Vyshnegradsky's condition") {
    // b J ω₀/(2 m F) > 1 (Pontryagin 1962, §27), ω₀² = g k/(n² F).
    for (const double J : {1.0, 4.0, 9.0}) {
        const double omega = std::sqrt(10.0 * 2 / 1), b = 2 / (J * omega);
        CHECK(std::abs(critical("governor", {"b", 0.02, 3, 40}, {{"J", J}}) - b) < 1e-12);
    }
}

TEST_CASE("scenes of stability: a rolling disc and a ring stay upright beyond the known rates") {
    // A m g r = C (C + m r²) ω²: ω² = g/(3 r) of a disc, g/(4 r) of a ring.
    CHECK(std::abs(critical("rolling_disc", {"w", 1, 6, 12}) - std::sqrt(9.81 / 1.5)) < 1e-8);
    CHECK(std::abs(critical("rolling_disc", {"w", 1, 6, 12}, {{"A", 0.125}, {"C", 0.25}}) - std::sqrt(9.81 / 2)) <
          1e-8);
}

TEST_CASE("scenes of stability: pendulums stand on springs beyond the loads of their stiffness matrices") {
    // Where two roots meet at 0 they are told from it beyond 1e-6 of the largest, so that k is known to 1e-12 of
    // its square over the slope of theirs: 1e-7.
    const double G = 9.81;
    CHECK(std::abs(critical("standing_double_pendulum", {"k", 20, 50, 7}) - (2 + std::sqrt(2.0)) * G) < 1e-7);
    const auto det = [](double x) { return ((x - 10) * x + 16) * x - 6; };
    CHECK(std::abs(critical("standing_triple_pendulum", {"k", 70, 90, 7}) - G * bisected(det, 6, 10)) < 1e-7);
    // Without springs as many eigenvalues to the right as rods.
    for (const auto& [name, count] :
         {std::pair("standing_double_pendulum", 2), std::pair("standing_triple_pendulum", 3)}) {
        const Stability s = judged(name, {{"k", "0"}});
        CHECK(s.verdict == V::unstable);
        int right = 0;
        for (const RootOf& root : s.eigenvalues) right += root.side == RootOf::Side::right ? 1 : 0;
        CHECK(right == count);
    }
}

TEST_CASE("scenes of stability: the tippe top turns over beyond the rate of Jellett's integral") {
    // C ψ'² (A/C + d/R − 1) = m g d (1 − d/R)² (Rauch-Wojciechowski et al. 2005), whatever the friction is.
    const double m = 0.02, R = 0.02, g = 9.81, A = 3.2e-6, C = 3.0e-6;
    for (const double d : {0.004, 0.003})
        for (const double c : {0.05, 0.2}) {
            const double rate = std::sqrt(m * g * d * std::pow(1 - d / R, 2) / (C * (A / C + d / R - 1)));
            CHECK(std::abs(critical("tippe_top", {"psi'", 5, 60, 12}, {{"d", d}, {"c", c}}) - rate) < 1e-8);
        }
}

TEST_CASE("scenes of stability: the triangular point loses its stability at Routh's ratio, the top at its rate") {
    CHECK(std::abs(critical("triangular_point", {"mu", 0.01, 0.1, 7}) - (1 - std::sqrt(23.0 / 27)) / 2) < 1e-9);
    CHECK(std::abs(critical("sleeping_top", {"psi'", 2, 9, 8}) - 4) < 1e-8);  // C² ψ'² = 4 A m g l
    CHECK(std::abs(critical("gyroscopic", {"G", 0.5, 5, 8}) - 2) < 1e-8);
}

TEST_CASE("scenes of stability: a regulator at the edge of its dead zone has no first approximation") {
    std::string message;
    try {
        judged("dead_zone", {{"x", "0.1"}});
    } catch (const ModelError& e) {
        message = e.what();
    }
    CAPTURE(message);
    CHECK(message.find("no first derivative at x = 0.1") != std::string::npos);
}

}  // namespace stability_scenes
