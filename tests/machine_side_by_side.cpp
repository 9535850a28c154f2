// SPDX-License-Identifier: MIT
// Roots and quotients side by side in one register have the bits that they have alone.
#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <fstream>
#include <random>
#include <set>

#include "alembert/native/executable.hpp"
#include "analysis/state/prepared.hpp"
#include "codegen/emit/solver_functions.hpp"
#include "codegen/machine/line_cycles.hpp"
#include "codegen/machine/registers.hpp"
#include "codegen/machine/side_by_side.hpp"
#include "model/formalism/formalisms.hpp"
#include "program/lower/choose.hpp"
#include "random_program.hpp"
#include "scenes.hpp"
#include "shell.hpp"
#include "tools.hpp"

namespace machine_side_by_side {

using namespace alembert;
using namespace alembert::test;
using machine::Line, machine::Lines;

namespace {

/// A function of t and up to five arrays, by its lines as they are.
class Written {
public:
    Written(const Lines& lines, int registers) {
        machine::Encoder code(1, registers);
        code.align();
        const std::size_t begin = code.getSize();
        REQUIRE(machine::write_function(code, lines));
        held_ = executable(code.finished());
        REQUIRE(held_);
        function_ = reinterpret_cast<Function>(reinterpret_cast<std::uintptr_t>(held_.get()) + begin);
    }
    void operator()(double t, std::vector<std::vector<double>>& a) const {
        function_(t, a[0].data(), a[1].data(), a[2].data(), a[3].data(), a[4].data());
    }

private:
    using Function = void (*)(double, double*, double*, double*, double*, double*);
    std::shared_ptr<const std::uint8_t> held_;
    Function function_ = nullptr;
};

bool has_groups(const Lines& lines) {
    return std::any_of(lines.list.begin(), lines.list.end(), [](const Line& line) {
        return line.kind == Line::Kind::pair || line.kind == Line::Kind::join || line.kind == Line::Kind::repeat;
    });
}

Lines lines_of_task(const Program& p, const FunctionTask& task) {
    std::vector<int> roots;
    for (const Root& root : p.roots) roots.push_back(root.node);
    return machine::lines_of(p, Vocabulary(p), Readiness(p, roots), task);
}

/// Of all arrays in which a function begins with random numbers.
int different_bits(const Lines& lines, unsigned seed) {
    const Lines other = side_by_side(lines);
    if (!has_groups(other)) return 0;
    int count = 0;
    for (const int registers : std::set{16, machine::registers_of_processor()}) {
        std::mt19937_64 random(seed);
        std::uniform_real_distribution<double> uniform(-2, 2);
        std::vector<std::vector<double>> arrays(5, std::vector<double>(3000));
        for (std::vector<double>& array : arrays)
            for (double& x : array) x = uniform(random);
        const double t = uniform(random);
        auto mine = arrays;
        Written(lines, registers)(t, arrays);
        Written(other, registers)(t, mine);
        for (std::size_t a = 0; a < arrays.size(); ++a)
            for (std::size_t k = 0; k < arrays[a].size(); ++k)
                if (std::bit_cast<std::uint64_t>(arrays[a][k]) != std::bit_cast<std::uint64_t>(mine[a][k]) &&
                    !(std::isnan(arrays[a][k]) && std::isnan(mine[a][k])))
                    ++count;
    }
    return count;
}

Program program_of(const std::string& scene) {
    const Prepared made = prepared(read_scene(source_path(scene)));
    return choose(made.mechanism, formalism("lagrange").derive(made.mechanism)).program;
}

}  // namespace

TEST_CASE("machine: roots and quotients side by side in random functions have the bits that they have alone") {
    if (!machine::can_run()) return;
    int found = 0;
    for (unsigned seed = 0; seed < 200; ++seed) {
        CAPTURE(seed);
        const Program p = random_program({.seed = seed,
                                          .count = 20 + static_cast<int>(seed) * 2,
                                          .calls = seed % 3 == 1,
                                          .inputs = 1 + static_cast<int>(seed % 30)});
        for (const FunctionTask& task : {right_hand_side(p, Vocabulary(p)), outputs_at(p)}) {
            const Lines lines = lines_of_task(p, task);
            found += has_groups(side_by_side(lines)) ? 1 : 0;
            CHECK(different_bits(lines, seed) == 0);
        }
    }
    CHECK(found > 100);
}

// 21 pairs of bodies are five groups of four and one alone, 15 pairs are three groups of four and one of three.
TEST_CASE(
    "machine: bodies that attract each other have their roots and quotients side by side, with the same bits") {
    if (!machine::can_run()) return;
    for (const char* scene : {"scenes/benchmark/pleiades.toml", "scenes/benchmark/outer_solar_system.toml"}) {
        CAPTURE(scene);
        const Program p = program_of(scene);
        const Lines lines = lines_of_task(p, right_hand_side(p, Vocabulary(p))), other = side_by_side(lines);
        CHECK(different_bits(lines, 7) == 0);
        CHECK(machine::cycles_of(other) < 0.8 * machine::cycles_of(lines));
        const auto count = [](const Lines& l, Line::Kind kind) {
            return std::count_if(l.list.begin(), l.list.end(),
                                 [&](const Line& line) { return line.kind == kind; });
        };
        for (const Line::Kind kind : {Line::Kind::root, Line::Kind::divide})
            CHECK(count(other, kind) == (count(lines, kind) + 3) / 4);
    }
}

// Half of the registers of AVX-512 are out of reach for some instructions of AVX.
TEST_CASE("machine: code for 32 registers has its roots and quotients side by side, too") {
    if (!has_program("objdump")) return;
    const Program p = program_of("scenes/benchmark/pleiades.toml");
    const Lines lines = side_by_side(lines_of_task(p, right_hand_side(p, Vocabulary(p))));
    machine::Encoder code(1, 32);
    REQUIRE(machine::write_function(code, lines));
    const std::string file = temporary_folder("side_by_side") + "/code";
    const std::vector<std::uint8_t> bytes = code.finished();
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    const std::string text =
        run_shell("objdump -D -b binary -m i386:x86-64 --no-show-raw-insn \"$1\"", {file}).out;
    const std::string function = text.substr(0, text.find("ret"));
    CHECK(function.find("mm16") != std::string::npos);
    CHECK(function.find("vinsertf64x2") != std::string::npos);
    CHECK(function.find("(bad)") == std::string::npos);
}

TEST_CASE("machine: a function in which nothing can stand side by side keeps its lines") {
    const Program p = program_of("scenes/textbook/double_pendulum.toml");
    const Lines lines = lines_of_task(p, right_hand_side(p, Vocabulary(p))), other = side_by_side(lines);
    REQUIRE(other.list.size() == lines.list.size());
    for (std::size_t k = 0; k < lines.list.size(); ++k) {
        CHECK(other.list[k].kind == lines.list[k].kind);
        CHECK(other.list[k].to == lines.list[k].to);
        CHECK(other.list[k].of == lines.list[k].of);
    }
}

// Quotients that wait for each other crosswise: a/b, c/d, then each of the two over the other.
TEST_CASE("machine: no line stands beside one that it waits for") {
    if (!machine::can_run()) return;
    for (int count = 2; count <= 13; ++count) {
        CAPTURE(count);
        Lines lines;
        lines.arrays = 5;
        lines.takes_time = true;
        const auto leaf = [&](int place) {
            lines.homes.push_back({.kind = machine::Home::Kind::argument, .argument = 0, .place = place});
            return static_cast<int>(lines.homes.size()) - 1;
        };
        const auto add = [&](Line line) {
            line.to = static_cast<int>(lines.homes.size());
            lines.homes.push_back({});
            lines.list.push_back(line);
            return line.to;
        };
        std::vector<int> values;
        for (int k = 0; k < count; ++k) values.push_back(leaf(k));
        for (int round = 0; round < 5; ++round) {
            std::vector<int> next;
            for (int k = 0; k < count; ++k) {
                const int a = values[static_cast<std::size_t>(k)],
                          b = k % 3 == 2 && !next.empty() ? next.back()
                                                          : values[static_cast<std::size_t>((k + 1) % count)];
                const int size = add({.kind = Line::Kind::absolute, .of = {b, -1, -1}});
                const int root = add({.kind = Line::Kind::root, .of = {size, -1, -1}});
                const int cube = add({.kind = Line::Kind::multiply, .of = {root, size, -1}});
                next.push_back(add({.kind = Line::Kind::divide, .of = {k % 2 == 0 ? a : root, cube, -1}}));
            }
            values = next;
        }
        for (int k = 0; k < count; ++k)
            lines.list.push_back({.kind = Line::Kind::store,
                                  .of = {values[static_cast<std::size_t>(k)], -1, -1},
                                  .argument = 2,
                                  .place = k});
        CHECK((count < 8 || has_groups(side_by_side(lines))));
        CHECK(different_bits(lines, static_cast<unsigned>(count)) == 0);
    }
}

}  // namespace machine_side_by_side
