// SPDX-License-Identifier: MIT
// Machine code for eight systems side by side, for AVX2 and for AVX-512, which this processor need not have: an
// interpreter of the disassembly against the interpreter of the same program, lane by lane.
#include <doctest/doctest.h>

#include <optional>
#include <utility>

#include "alembert/batch/packs.hpp"
#include "codegen/machine/registers.hpp"
#include "codegen/machine/two_halves.hpp"
#include "disassembled.hpp"
#include "machine_values.hpp"
#include "random_program.hpp"
#include "tools.hpp"

namespace machine_encoding {

using namespace alembert;
using namespace alembert::test;

namespace {

/// The code of a function for registers of so many numbers.
class ReadCode {
public:
    ReadCode(const Program& p, const Vocabulary& words, const FunctionTask& task, int width, int registers) {
        std::vector<int> roots;
        for (const Root& root : p.roots) roots.push_back(root.node);
        const Readiness ready(p, roots);
        const auto lines = [&](machine::Sines sines) {
            return machine::lines_of_packs(p, words, ready, task, sines, width);
        };
        const machine::Lines inside = lines(machine::Sines::inside);
        machine::Encoder code(width, registers);
        REQUIRE(machine::write_function(code, lines(machine::Sines::called)));
        code.align();
        begin_ = code.getSize();
        REQUIRE(machine::write_function(code, inside, 0));
        if (width == 4) {
            const std::size_t body = std::exchange(begin_, code.getSize());
            machine::write_in_two_halves(code, body, inside.arrays + (inside.takes_time ? 1 : 0));
        }
        code_.emplace(code.finished());
    }

    void operator()(const std::vector<const double*>& arrays) { code_->call(begin_, arrays); }
    bool has(const std::string& instruction) const { return code_->count(instruction) > 0; }

private:
    std::size_t begin_ = 0;
    std::optional<Disassembled> code_;
};

/// Eight states of a program, and what is expected there.
struct States {
    States(const Program& p, const Vocabulary& words, unsigned seed, bool has_large_angle)
        : y(2 * p.coordinates.size()), par(p.parameters.size() + words.constants().size() + 1) {
        for (int lane = 0; lane < lanes; ++lane) {
            State<double> state = some_state(p, lanes * seed + static_cast<unsigned>(lane));
            if (has_large_angle && lane == 6) state.q[0] = 3e8;
            t[lane] = state.t;
            for (std::size_t i = 0; i < state.q.size(); ++i)
                y[i][lane] = state.q[i], y[state.q.size() + i][lane] = state.qdot[i];
            expected.emplace_back(p, state);
            for (std::size_t i = 0; i < state.parameters.size(); ++i) par[i][lane] = state.parameters[i];
            for (std::size_t k = 0; k < words.constants().size(); ++k)
                par[state.parameters.size() + k][lane] =
                    expected.back().value[static_cast<std::size_t>(words.constants()[k])];
        }
    }
    Lanes t;
    std::vector<Lanes> y, par;
    std::vector<Expected> expected;
};

}  // namespace

TEST_CASE(
    "machine: packs for AVX2 and for AVX-512 have the interpreter's values where their instructions are read") {
    if (!has_program("objdump")) return;
    int far = 0;
    for (unsigned seed = 0; seed < 24; ++seed) {
        CAPTURE(seed);
        const Program p = random_program({.seed = seed,
                                          .count = 20 + static_cast<int>(seed) * 12,
                                          .calls = seed % 3 != 1,
                                          .inputs = 2 + static_cast<int>(seed)});
        const Vocabulary words(p);
        const FunctionTask task = right_hand_side(p, words);
        const States states(p, words, seed, seed % 4 == 3);
        for (const auto& [width, registers] : {std::pair(8, 32), std::pair(8, 16), std::pair(4, 16)}) {
            CAPTURE(width);
            CAPTURE(registers);
            ReadCode code(p, words, task, width, registers);
            std::vector<Lanes> rate(states.y.size());
            code({reals(&states.t), reals(states.y.data()), reals(states.par.data()), reals(rate.data())});
            for (int lane = 0; lane < lanes; ++lane) {
                Arrays found;
                for (const Lanes& pack : rate) found["rate"].push_back(pack[lane]);
                CHECK(differences(task, found, states.expected[static_cast<std::size_t>(lane)]) == 0);
            }
            far += code.has("call") && code.has(width == 8 ? "kortestb" : "vtestpd") ? 1 : 0;
        }
    }
    CHECK(far > 0);  // the function with called sines was taken
}

}  // namespace machine_encoding
