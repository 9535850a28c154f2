// SPDX-License-Identifier: MIT
// Loads for given accelerations: Newton-Euler along the tree against M q'' − f of Schiehlen's projection, which
// shares nothing with it but the mechanism.
#include <doctest/doctest.h>

#include <random>

#include "analysis/state/prepared.hpp"
#include "model/formalism/joint_tree.hpp"
#include "model/formalism/recursive.hpp"
#include "model/formalism/schiehlen.hpp"
#include "program/lower/inverse.hpp"
#include "program/lower/lower.hpp"
#include "scenes.hpp"

namespace generator_inverse {

using namespace alembert;

namespace {

/// Σ_j M_ij q''_j − f_i, and the sizes of its terms.
struct Expected {
    std::vector<double> load, size;
};
Expected by_schiehlen(const Mechanism& m, const State<double>& state) {
    const Equations e = schiehlen(m);
    std::vector<GiNaC::ex> list;
    for (int i = 0; i < m.size(); ++i) {
        for (int j = 0; j < m.size(); ++j) list.push_back(e.M(i, j));
        list.push_back(e.forcing(i));
    }
    Program program;
    std::vector<std::pair<GiNaC::symbol, int>> open;
    for (const Mechanism::Unilateral& contact : m.unilateral)
        open.emplace_back(contact.gap.multiplier, program.number(0));
    const std::vector<int> nodes = lower_expressions(program, in_terms_of(e, m), list, open);
    const std::vector<double> value = interpret(program, state);
    Expected result;
    std::size_t k = 0;
    for (int i = 0; i < m.size(); ++i) {
        double load = 0, size = 1;
        for (int j = 0; j < m.size(); ++j, ++k) {
            load += value[nodes[k]] * state.qddot[static_cast<std::size_t>(j)];
            size += std::abs(value[nodes[k]] * state.qddot[static_cast<std::size_t>(j)]);
        }
        load -= value[nodes[k]];
        size += std::abs(value[nodes[k++]]);
        result.load.push_back(load);
        result.size.push_back(size);
    }
    return result;
}

}  // namespace

TEST_CASE("inverse: the loads are M q'' - f, with speeds, constraints, quaternions and prescribed motions too") {
    std::vector<std::string> files = test::scenes_in("scenes/textbook");
    for (const char* name : {"trees/arm7", "trees/pend8"})
        files.push_back(test::source_path(std::string("scenes/benchmark/") + name + ".toml"));
    for (const char* name : {"six_joint_arm", "four_bar_joints", "rssr", "gimballed_gyroscope",
                             "universal_double_pendulum", "furuta_joints"})
        files.push_back(test::source_path(std::string("scenes/gallery/") + name + ".toml"));
    for (const char* name : {"definitions", "geometry_in_definitions"})  // no trees
        files.push_back(test::source_path(std::string("tests/odd/") + name + ".toml"));
    const unsigned seed = 20261121;
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    int trees = 0, others = 0;
    for (const std::string& file : files) {
        CAPTURE(file);
        const Mechanism m = prepared(read_scene(file)).mechanism;
        State<double> state = test::random_state(start_of(m), random);
        for (int i = 0; i < m.size(); ++i)
            state.qddot.push_back(std::uniform_real_distribution<double>(-3, 3)(random));
        std::optional<Expected> expected;
        try {
            expected = by_schiehlen(m, state);
        } catch (const ModelError&) {  // energies without masses
            continue;
        }
        const Program program = lower_inverse(m);
        const std::vector<int> loads = program.nodes_of(Group::load);
        REQUIRE(static_cast<int>(loads.size()) == m.size());
        const std::vector<double> value = interpret(program, state);
        for (std::size_t i = 0; i < loads.size(); ++i)
            CHECK(std::abs(value[loads[i]] - expected->load[i]) < 1e-11 * expected->size[i]);
        ++(loaded_tree(m).exists() ? trees : others);
    }
    CHECK(trees > 20);
    CHECK(others > 3);
}

TEST_CASE("inverse: along a tree the operations grow linearly") {
    std::vector<int> operations;
    for (const int n : {8, 16, 32}) {
        const Program program = lower_inverse(
            prepared(read_scene(test::source_path("scenes/benchmark/trees/pend" + std::to_string(n) + ".toml")))
                .mechanism);
        operations.push_back(program.count(program.nodes_of(Group::load)).total());
    }
    CHECK(std::abs((operations[2] - operations[1]) - 2 * (operations[1] - operations[0])) < operations[0] / 4);
}

}  // namespace generator_inverse
