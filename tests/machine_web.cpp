// SPDX-License-Identifier: MIT
// Modules of WebAssembly against the interpreter of the same program, run by a machine of these tests
// (web_machine.hpp); and lines that are interpreted, which have the bits of the module.
#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>
#include <utility>

#include "alembert/base/error.hpp"
#include "alembert/batch/packs.hpp"
#include "analysis/state/prepared.hpp"
#include "codegen/machine/interpreted_lines.hpp"
#include "codegen/machine/web_assembly.hpp"
#include "machine_values.hpp"
#include "model/formalism/formalisms.hpp"
#include "program/differentiate.hpp"
#include "program/lower/choose.hpp"
#include "random_program.hpp"
#include "random_scene.hpp"
#include "scenes.hpp"
#include "web_machine.hpp"

namespace machine_web {

using namespace alembert;
using namespace alembert::test;
using machine::ModuleOfLines;
using Value = WebMachine::Value;

namespace {

/// Where arrays lie, in numbers: each has as much room.
constexpr std::size_t room_of_arrays = 20'000;

/// The functions of a program in a module, at one state, or at eight side by side.
class Tried {
public:
    Tried(const Program& p, const std::vector<State<double>>& states)
        : p_(p), words_(p), ready_(p, roots_of(p)), states_(states), machine_(module()) {
        for (const State<double>& state : states) expected_.emplace_back(p, state);
    }

    /// The number of results that differ from the interpreter's by more than rounding explains.
    int differences() {
        fill("state", [](const State<double>& s, auto& list) {
            list = s.q;
            list.insert(list.end(), s.qdot.begin(), s.qdot.end());
        });
        fill("par", [](const State<double>& s, auto& list) { list = s.parameters; });
        fill("t", [](const State<double>& s, auto& list) { list = {s.t}; });
        std::size_t number = 0;
        if (!words_.constants().empty()) run(number++, {{"Real*", "par"}});
        int count = 0;
        for (const FunctionTask& task : tasks_) {
            fill("rate", [](const State<double>& s, auto& list) {
                list = s.qdot;
                list.resize(s.q.size());
                list.insert(list.end(), s.qddot.begin(), s.qddot.end());
            });
            run(number++, task.arguments);
            for (std::size_t lane = 0; lane < states_.size(); ++lane)
                count += test::differences(task, results(task, lane), expected_[lane]);
        }
        return count;
    }

private:
    static std::vector<int> roots_of(const Program& p) {
        std::vector<int> roots;
        for (const Root& root : p.roots) roots.push_back(root.node);
        return roots;
    }
    bool is_packed() const { return states_.size() > 1; }

    std::vector<std::uint8_t> module() {
        tasks_ = {right_hand_side(p_, words_), mass_forcing(p_), energy(p_), outputs_at(p_)};
        if (!is_packed())
            tasks_.insert(tasks_.end(),
                          {events_at(p_), constraints_at(p_), multipliers_at(p_), jacobian(p_).task});
        if (!is_packed() && has_projection(p_)) tasks_.insert(tasks_.end(), {project(p_), gamma_at(p_)});
        std::erase_if(tasks_, [](const FunctionTask& task) { return task.results.empty(); });
        if (!words_.constants().empty())
            lines_.push_back(is_packed() ? machine::lines_of_constants_in_packs(p_, words_, ready_, lanes)
                                         : machine::lines_of_constants(p_, words_, ready_));
        for (const FunctionTask& task : tasks_)
            lines_.push_back(is_packed()
                                 ? machine::lines_of_packs(p_, words_, ready_, task, machine::Sines::called, lanes)
                                 : machine::lines_of(p_, words_, ready_, task));
        ModuleOfLines module({.block = 0, .sines = 0, .place_of = WebMachine::place_of});
        for (const machine::Lines& lines : lines_) {
            REQUIRE(machine::room_in_block(lines) <= room_of_arrays);
            REQUIRE(module.add(lines));
        }
        REQUIRE(module.size() == static_cast<int>(lines_.size()));
        return module.bytes();
    }

    std::size_t array(const std::string& name) {
        const std::size_t next = (places_.size() + 1) * room_of_arrays;
        const std::size_t place = places_.try_emplace(name, next).first->second;
        machine_.memory.resize(std::max(machine_.memory.size(), place + room_of_arrays));
        return place;
    }

    void fill(const std::string& name, const auto& numbers_of) {
        std::vector<double> list;
        for (std::size_t lane = 0; lane < states_.size(); ++lane) {
            numbers_of(states_[lane], list);
            for (std::size_t i = 0; i < list.size(); ++i)
                machine_.memory.at(array(name) + i * states_.size() + lane) = list[i];
        }
    }

    void run(std::size_t number, const std::vector<FunctionArgument>& given) {
        std::vector<Value> arguments;
        for (const FunctionArgument& argument : given)
            arguments.push_back(argument.name == "t" && !is_packed()
                                    ? Value(states_[0].t)
                                    : Value(static_cast<std::uint32_t>(8 * array(argument.name))));
        const std::vector<double> before = machine_.memory;
        machine_.run(number, arguments);
        if (!is_packed()) check_interpreted(lines_[number], given, before);
    }

    /// The same lines without a module, in a memory of their own: every number is the same, bit for bit.
    void check_interpreted(const machine::Lines& lines, const std::vector<FunctionArgument>& given,
                           std::vector<double> memory) {
        std::vector<double*> arrays;
        for (const FunctionArgument& argument : given)
            if (argument.name != "t") arrays.push_back(&memory[array(argument.name)]);
        machine::InterpretedLines(lines).run(states_[0].t, arrays.data());
        for (std::size_t i = room_of_arrays; i < memory.size(); ++i)  // behind the block of sines
            if (std::bit_cast<std::uint64_t>(memory[i]) != std::bit_cast<std::uint64_t>(machine_.memory[i]) &&
                !(std::isnan(memory[i]) && std::isnan(machine_.memory[i])))
                FAIL_CHECK("interpreted " << memory[i] << ", in the module " << machine_.memory[i]);
    }

    Arrays results(const FunctionTask& task, std::size_t lane) {
        Arrays out;
        for (const FunctionResult& result : task.results) {
            std::vector<double>& values = out[result.array];
            values.resize(room(task, result.array));
            for (std::size_t i = 0; i < values.size(); ++i)
                values[i] = machine_.memory.at(array(result.array) + i * states_.size() + lane);
        }
        return out;
    }

    const Program& p_;
    Vocabulary words_;
    Readiness ready_;
    const std::vector<State<double>>& states_;
    std::vector<FunctionTask> tasks_;
    std::vector<machine::Lines> lines_;
    WebMachine machine_;
    std::vector<Expected> expected_;
    std::map<std::string, std::size_t> places_;  ///< of arrays
};

int differences_in_module(const Program& p, const std::vector<State<double>>& states) {
    return Tried(p, states).differences();
}

}  // namespace

TEST_CASE("machine: a module of WebAssembly with random programs has the interpreter's values") {
    for (unsigned seed = 0; seed < 300; ++seed) {
        const Program p = random_program({.seed = seed,
                                          .count = 20 + static_cast<int>(seed) * 3,
                                          .calls = seed % 2 == 1,
                                          .inputs = 1 + static_cast<int>(seed % 40)});
        CAPTURE(seed);
        CHECK(differences_in_module(p, {some_state(p, seed)}) == 0);
    }
}

TEST_CASE(
    "machine: a module of WebAssembly with packs of random programs has the interpreter's values in every lane") {
    for (unsigned seed = 0; seed < 120; ++seed) {
        CAPTURE(seed);
        const Program p = random_program({.seed = seed,
                                          .count = 20 + static_cast<int>(seed) * 5,
                                          .calls = seed % 2 == 1,
                                          .inputs = 1 + static_cast<int>(seed % 40)});
        std::vector<State<double>> states;
        for (unsigned lane = 0; lane < lanes; ++lane) states.push_back(some_state(p, lanes * seed + lane));
        CHECK(differences_in_module(p, states) == 0);
    }
}

TEST_CASE("machine: a module of WebAssembly refuses lines whose sines need fused multiply-add") {
    const Program p = random_program({.seed = 3, .count = 60, .calls = true, .inputs = 4});
    const Vocabulary words(p);
    const FunctionTask task = right_hand_side(p, words);
    const machine::Lines lines =
        machine::lines_of_packs(p, words, Readiness(p, {}), task, machine::Sines::inside, lanes);
    REQUIRE(lines.largest >= 0);
    ModuleOfLines module({.block = 0, .sines = 0, .place_of = WebMachine::place_of});
    CHECK_THROWS_AS(module.add(lines), std::logic_error);
    CHECK_THROWS_AS(machine::InterpretedLines{lines}, std::logic_error);
}

TEST_CASE("machine: a module of WebAssembly with the functions of scenes has the interpreter's values") {
    for (const std::string& file : every_third(scenes_in("scenes/textbook"), 2)) {
        CAPTURE(file);
        const Prepared made = prepared(read_scene(file));
        const Mechanism& m = made.mechanism;
        std::mt19937_64 random(12);
        for (const char* name : {"lagrange", "routh", "recursive"}) {
            std::optional<Program> program;
            try {
                program = choose(m, formalism(name).derive(m)).program;
            } catch (const ModelError&) {  // the formalism does not apply
                continue;
            }
            CAPTURE(name);
            if (program->singular) continue;
            if (const auto d = differentiated(*program, {.power = true, .budget = 20000})) program = d->program;
            State<double> state = random_state(start_of(m), random);
            state.qdot.resize(program->speeds.empty() ? state.q.size() : program->speeds.size(), 0.7);
            state.qddot.assign(state.qdot.size(), 0.3);
            CHECK(differences_in_module(*program, {state}) == 0);
        }
    }
}

TEST_CASE("machine: a module of WebAssembly calls a function with one more argument") {
    ModuleOfLines module({.block = 0, .sines = 0, .place_of = WebMachine::place_of});
    module.add_call(70, 0xfffffff0U);
    const std::vector<std::uint8_t> bytes = module.bytes();
    // i32.const −16, i32.const 70, call_indirect: constants have a sign, so that 70 takes two bytes.
    const std::vector<std::uint8_t> last{0x41, 0x70, 0x41, 0xc6, 0x00, 0x11, 0x00, 0x00, 0x0b};
    CHECK(std::equal(last.rbegin(), last.rend(), bytes.rbegin()));
    CHECK(WebMachine(bytes).size() == 1);
}

}  // namespace machine_web
