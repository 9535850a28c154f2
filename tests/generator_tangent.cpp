// SPDX-License-Identifier: MIT
// Derivatives along a direction against dual numbers that go through the undifferentiated program, its solve
// included.
#include <doctest/doctest.h>

#include "dual.hpp"
#include "program/tangent.hpp"
#include "scene_programs.hpp"

namespace generator_tangent {

using namespace alembert;
using test::Dual;

namespace {

/// The values of the results of Group::tangent's order, with their derivatives along the direction.
std::vector<Dual> by_duals(const Program& p, const State<double>& s, const std::vector<double>& direction) {
    State<Dual> at{.parameters = {s.parameters.begin(), s.parameters.end()},
                   .t = s.t,
                   .q = {s.q.begin(), s.q.end()},
                   .qdot = {s.qdot.begin(), s.qdot.end()},
                   .qddot = {}};
    std::size_t place = 0;
    for (std::vector<Dual>* part : {&at.q, &at.qdot, &at.parameters})
        for (Dual& x : *part) x.d = direction[place++];
    std::vector<Dual> results, value = interpret(p, at);
    const auto add = [&](Group group) {
        for (const int id : p.nodes_of(group)) results.push_back(value[static_cast<std::size_t>(id)]);
    };
    if (p.speeds.empty()) results = at.qdot;
    add(Group::rate), add(Group::acceleration);
    at.qddot.assign(results.begin() + static_cast<std::ptrdiff_t>(s.q.size()), results.end());
    value = interpret(p, at);
    for (const Group group :
         {Group::kinetic, Group::potential, Group::energy, Group::power, Group::output, Group::speed})
        add(group);
    return results;
}

/// The largest difference over the largest derivative or value; −1 where a value is not finite.
double misfit(const Program& plain, const Program& with, const State<double>& s,
              const std::vector<double>& direction) {
    State<double> at = s;
    at.unknown = direction;
    std::vector<double> value = interpret(with, at);
    for (const int id : with.nodes_of(Group::acceleration))
        at.qddot.push_back(value[static_cast<std::size_t>(id)]);
    value = interpret(with, at);
    const std::vector<Dual> expected = by_duals(plain, s, direction);
    const std::vector<int> found = with.nodes_of(Group::tangent);
    REQUIRE(found.size() == expected.size());
    double largest = 1, difference = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
        if (!std::isfinite(expected[i].v) || !std::isfinite(expected[i].d)) return -1;
        largest = std::max({largest, std::abs(expected[i].v), std::abs(expected[i].d)});
        const double off = std::abs(value[static_cast<std::size_t>(found[i])] - expected[i].d);
        difference = std::max(difference, std::isfinite(off) ? off : HUGE_VAL);
    }
    return difference / largest;
}

}  // namespace

TEST_CASE(
    "tangent: the changes of rates, energies and outputs along random directions are those of dual numbers") {
    std::mt19937_64 random(20261127);
    std::uniform_real_distribution<double> unit(-1, 1);
    int checked = 0;
    test::for_scene_programs(1, [&](const test::SceneProgram& one) {
        const Program with = with_tangent(one.program);
        State<double> s = one.start;
        for (int k = 0; k < 3; ++k) {
            std::vector<double> direction(direction_size(one.program));
            for (double& x : direction) x = unit(random);
            INFO(one.name << ", seed 20261127, state " << k);
            // Rounding: the accelerations' own, and that of the differences of large terms.
            const double off = misfit(one.program, with, s, direction);
            CHECK(off < 1e-10);
            if (off >= 0) ++checked;
            test::step_aside(s, random);
        }
    });
    CHECK(checked > test::at_least(100));
}

TEST_CASE("tangent: it takes as many operations as a few right-hand sides, of a platform on six legs too") {
    const Mechanism m = prepared(read_scene(test::source_path("scenes/gallery/stewart.toml"))).mechanism;
    const Program program = choose(m, formalism("routh").derive(m)).program;
    std::vector<int> nodes = program.right_hand_side();
    const long plain = program.count(nodes).total();
    const Program with = with_tangent(program);
    const long all = with.count(with.nodes_of(Group::tangent)).total();
    MESSAGE(plain << " operations of a right-hand side, " << all << " with those of the derivatives");
    CHECK(all <= 5 * plain);
}

}  // namespace generator_tangent
