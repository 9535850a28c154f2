// SPDX-License-Identifier: MIT
// Emitted C is compiled as strict C99 and computes the same as the interpreter of the same program. If a compiler
// for a microcontroller is installed, it must accept the files too, with floats.
#include <dlfcn.h>
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>

#include "program/differentiate.hpp"
#include "program/interpret.hpp"
#include "scene/scene.hpp"
#include "scenes.hpp"
#include "simulate/emission.hpp"
#include "simulate/simulate.hpp"
#include "tools.hpp"

namespace emit_c {

using namespace alembert;

namespace {

const char* const scenes[] = {
    "textbook/double_pendulum", "textbook/rolling_disc",   "textbook/sled",
    "textbook/watt_governor",   "textbook/planetary_gear", "textbook/free_body_quaternion",
    "textbook/heavy_top_joint", "textbook/falling_ladder"};

struct Folder {
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / fmt::format("alembert-emit-c-{}", getpid());
    Folder() { std::filesystem::create_directories(path); }
    ~Folder() { std::filesystem::remove_all(path); }
    std::string file(const std::string& name) const { return (path / name).string(); }
    void write(const std::string& name, const std::string& text) const { std::ofstream(file(name)) << text; }
};

bool runs(const std::string& command) {
    return std::system((command + " >/dev/null 2>&1").c_str()) == 0;
}

struct Library {
    explicit Library(const std::string& file) : handle(dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL)) {}
    ~Library() {
        if (handle != nullptr) dlclose(handle);
    }
    template <typename Function>
    Function* function(const std::string& name) const {
        return reinterpret_cast<Function*>(dlsym(handle, name.c_str()));
    }
    void* handle;
};

using Defaults = void(double*);
using Rhs = void(double, const double*, const double*, double*);

double difference(const std::vector<double>& a, const std::vector<double>& b) {
    REQUIRE(a.size() == b.size());
    double worst = 0, size = 1e-300;
    for (std::size_t i = 0; i < a.size(); ++i) {
        worst = std::max(worst, std::abs(a[i] - b[i]));
        size = std::max(size, std::abs(b[i]));
    }
    return worst / size;
}

/// Rates and derivatives at random states, against the interpreter.
void compare(const Library& library, const Emission& e) {
    const Program& p = e.derivatives->program;
    const std::string name = e.source.file.substr(0, e.source.file.size() - 2);
    const auto defaults = library.function<Defaults>(name + "_defaults");
    using Function = void(double, const double*, const double*, const double*, double*);
    const auto rhs = library.function<Rhs>(name + "_rhs"), jacobian = library.function<Rhs>(name + "_jacobian");
    REQUIRE((defaults != nullptr));
    REQUIRE((rhs != nullptr));
    REQUIRE((jacobian != nullptr));
    std::vector<double> par(1000);
    defaults(par.data());
    std::mt19937_64 random(99);
    for (int k = 0; k < 4; ++k) {
        const State<double> at = test::random_state(start_of(e.mechanism), random);
        std::vector<double> state = at.q;
        state.insert(state.end(), at.qdot.begin(), at.qdot.end());
        const std::vector<double> value = interpret(p, at);
        std::vector<double> expected;
        for (const int node : p.nodes_of(Group::rate)) expected.push_back(value[node]);
        if (p.speeds.empty()) expected.assign(at.qdot.begin(), at.qdot.end());
        for (const int node : p.nodes_of(Group::acceleration)) expected.push_back(value[node]);
        std::vector<double> rate(expected.size());
        rhs(at.t, state.data(), par.data(), rate.data());
        CHECK(difference(rate, expected) < 1e-11);
        std::vector<double> entries, found;
        for (const Group group : {Group::jacobian, Group::power_gradient})
            for (const int node : p.nodes_of(group))
                if (!p.is_zero(node)) entries.push_back(value[node]);
        found.resize(entries.size());
        jacobian(at.t, state.data(), par.data(), found.data());
        CHECK(difference(found, entries) < 1e-11);
        for (const NamedFunction& f : e.functions) {
            std::vector<double> out(f.nodes.size()), wanted;
            for (const int node : f.nodes) wanted.push_back(value[static_cast<std::size_t>(node)]);
            const auto function = library.function<Function>(name + "_" + f.name);
            REQUIRE((function != nullptr));
            function(at.t, state.data(), rate.data(), par.data(), out.data());
            CHECK(difference(out, wanted) < 1e-11);
        }
    }
}

}  // namespace

TEST_CASE("emit: the C99 compiles without a warning, and its rates and Jacobian are those of the program") {
    const Folder folder;
    std::vector<std::unique_ptr<Emission>> all;
    std::string files;
    for (const char* const scene : scenes) {
        CAPTURE(scene);
        all.push_back(std::make_unique<Emission>(
            emission(read_scene(test::source_path(fmt::format("scenes/{}.toml", scene))),
                     {.jacobian = true,
                      .language = CodeLanguage::c,
                      .functions = std::string(scene) == "textbook/double_pendulum"
                                       ? std::vector<std::string>{"mass", "bias", "loads"}
                                       : std::vector<std::string>{}})));
        const Source& source = all.back()->source;
        folder.write(source.file, source.text);
        REQUIRE(source.header.has_value());
        folder.write(source.header->name, source.header->text);
        files += " " + folder.file(source.file);
    }
    const std::string strict = "-std=c99 -pedantic -Wall -Wextra -Werror";
    REQUIRE(runs("cc " + strict + " -O1 -ffp-contract=off -shared -fPIC -o " + folder.file("all.so") + files +
                 " -lm"));
    const Library library(folder.file("all.so"));
    REQUIRE(library.handle != nullptr);
    for (const auto& e : all) {
        CAPTURE(e->source.file);
        compare(library, *e);
    }
    if (test::has_program("arm-none-eabi-gcc"))
        CHECK(runs("cd " + folder.path.string() +
                   " && arm-none-eabi-gcc -mcpu=cortex-m7 -mthumb -c -O1 "
                   "-DALEMBERT_REAL=float -std=c99" +
                   files));
}

TEST_CASE("emit: long functions in C are written in parts, with the same values") {
    const Folder folder;
    Emission e = emission(read_scene(test::source_path("scenes/benchmark/trees/arm7.toml")),
                          {.jacobian = true, .language = CodeLanguage::c});
    const Source parted = emit(e.derivatives->program, {.language = CodeLanguage::c, .longest_function = 60});
    CHECK(parted.text.find("carried[") != std::string::npos);
    folder.write(parted.file, parted.text);
    folder.write(parted.header->name, parted.header->text);
    REQUIRE(runs("cc -std=c99 -pedantic -Wall -Wextra -Werror -O0 -shared -fPIC -o " + folder.file("one.so") +
                 " " + folder.file(parted.file) + " -lm"));
    const Library library(folder.file("one.so"));
    REQUIRE(library.handle != nullptr);
    compare(library, e);
}

// The motion that `simulate` gives by a method of higher order; the scene's tolerance is that of a step.
TEST_CASE("emit: the main program beside a file integrates to the end that simulate finds, in C and in C++") {
    const Folder folder;
    for (const char* const scene :
         {"textbook/double_pendulum", "textbook/sled", "textbook/falling_ladder", "gallery/rssr"})
        for (const CodeLanguage language : {CodeLanguage::c, CodeLanguage::cpp}) {
            CAPTURE(scene);
            const Scene read = read_scene(test::source_path(fmt::format("scenes/{}.toml", scene)));
            const Emission e = emission(read, {.language = language, .standalone = true});
            REQUIRE(e.main.has_value());
            folder.write(e.source.file, e.source.text);
            folder.write(e.main->name, e.main->text);
            if (e.source.header) folder.write(e.source.header->name, e.source.header->text);
            const std::string program = folder.file("program"), table = folder.file("table");
            const std::string compiled =
                language == CodeLanguage::c
                    ? fmt::format("cc -std=c99 -pedantic -Wall -Wextra -Werror -O1 {} {} -lm -o {}",
                                  folder.file(e.main->name), folder.file(e.source.file), program)
                    : fmt::format("c++ -std=c++20 -O1 {} -o {}", folder.file(e.main->name), program);
            REQUIRE(runs(compiled));
            REQUIRE(std::system(fmt::format("{} 1 1e-12 4 > {}", program, table).c_str()) == 0);
            std::ifstream lines(table);
            std::string line, last;
            int count = 0;
            while (std::getline(lines, line)) last = line, ++count;
            CHECK(count == 6);
            std::vector<double> end;
            for (std::size_t at = last.find(','); at != std::string::npos; at = last.find(',', at + 1))
                end.push_back(std::strtod(last.c_str() + at + 1, nullptr));
            RunOptions wishes{.tolerance = 1e-13, .estimate = false};
            wishes.duration = 1;
            const Run run = simulate(read, wishes);
            const std::vector<double>& expected = run.final_coordinates;
            REQUIRE(end.size() >= expected.size());
            end.resize(expected.size());
            CHECK(difference(end, expected) < 1e-9);
        }
    CHECK_THROWS_AS(
        emission(read_scene(test::source_path("scenes/friction/stick_slip.toml")), {.standalone = true}),
        ModelError);
}

}  // namespace emit_c
