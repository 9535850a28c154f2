// SPDX-License-Identifier: MIT
// Machine code in memory for eight systems side by side against the interpreter of the same program, lane by lane.
#include <doctest/doctest.h>

#include <set>

#include "alembert/batch/packs.hpp"
#include "codegen/machine/can_run.hpp"
#include "codegen/machine/memory_solver.hpp"
#include "machine_values.hpp"
#include "random_program.hpp"

namespace machine_packs {

using namespace alembert;
using namespace alembert::test;

namespace {

/// The arrays of a function for eight systems.
using PackArrays = std::map<std::string, std::vector<Lanes>>;

Arrays lane_of(const PackArrays& packs, int lane) {
    Arrays result;
    for (const auto& [name, values] : packs)
        for (const Lanes& pack : values) result[name].push_back(pack[lane]);
    return result;
}

/// Lists of numbers, one for each system, side by side.
std::vector<Lanes> side_by_side(const std::vector<std::vector<double>>& lists) {
    std::vector<Lanes> result(lists[0].size());
    for (std::size_t lane = 0; lane < lists.size(); ++lane)
        for (std::size_t i = 0; i < result.size(); ++i) result[i][static_cast<int>(lane)] = lists[lane][i];
    return result;
}

/// The functions of the packs at eight states. `rate` holds the accelerations that energies and outputs take.
int differences(const Program& p, const Module& module, const std::vector<State<double>>& states) {
    const alembert_pack_table& table = *module.pack();
    REQUIRE(table.lanes == lanes);
    const Vocabulary words(p);
    std::vector<std::vector<double>> y, rate, par;
    std::vector<Expected> expected;
    Lanes t;
    for (const State<double>& state : states) {
        t[static_cast<int>(y.size())] = state.t;
        y.push_back(state.q);
        y.back().insert(y.back().end(), state.qdot.begin(), state.qdot.end());
        rate.push_back(state.qdot);
        rate.back().insert(rate.back().end(), state.qddot.begin(), state.qddot.end());
        par.push_back(state.parameters);
        par.back().resize(static_cast<std::size_t>(module.table().parameters + module.table().constants));
        expected.emplace_back(p, state);
    }
    const std::vector<Lanes> at = side_by_side(y), with = side_by_side(rate);
    std::vector<Lanes> parameters = side_by_side(par);
    table.prepare(reals(parameters.data()));
    int count = 0;
    const auto look = [&](const FunctionTask& task, const auto& call) {
        if (task.results.empty()) return;
        PackArrays out;
        for (const FunctionArgument& argument : task.arguments)
            out[argument.name].resize(room(task, argument.name));
        call(out);
        for (int lane = 0; lane < lanes; ++lane)
            count += test::differences(task, lane_of(out, lane), expected[static_cast<std::size_t>(lane)]);
    };
    look(right_hand_side(p, words), [&](PackArrays& out) {
        out["rate"].resize(at.size());
        table.rhs(reals(&t), reals(at.data()), reals(parameters.data()), reals(out["rate"].data()));
    });
    look(outputs_at(p), [&](PackArrays& out) {
        table.outputs_at(reals(&t), reals(at.data()), reals(with.data()), reals(parameters.data()),
                         reals(out["out"].data()));
    });
    return count;
}

/// In two halves, and where this processor has AVX-512 as one, with 16 registers and with all that there are.
int differences(const Program& p, const std::vector<State<double>>& states) {
    int count = 0;
    for (const int width : {4, lanes})
        for (const int registers : std::set{16, width == 4 ? 16 : machine::registers_of_processor()}) {
            CAPTURE(width);
            CAPTURE(registers);
            const auto solver = memory_solver(p, true, registers, width);
            REQUIRE(solver.has_value() == machine::can_run(width));
            if (solver) count += differences(p, solver->module, states);
        }
    return count;
}

}  // namespace

TEST_CASE("machine: packs of random programs have the interpreter's values in every lane") {
    for (unsigned seed = 0; seed < 120; ++seed) {
        CAPTURE(seed);
        const Program p = random_program({.seed = seed,
                                          .count = 20 + static_cast<int>(seed) * 5,
                                          .calls = seed % 2 == 1,
                                          .inputs = 1 + static_cast<int>(seed % 40)});
        std::vector<State<double>> states;
        for (unsigned lane = 0; lane < lanes; ++lane) {
            states.push_back(some_state(p, lanes * seed + lane));
            for (double& value : states.back().parameters) value += 0.01 * lane;
        }
        CHECK(differences(p, states) == 0);
    }
}

}  // namespace machine_packs
