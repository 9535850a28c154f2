// SPDX-License-Identifier: MIT
// Emitted C is compiled as strict C99 and computes the same as the interpreter of the same program. If a compiler
// for a microcontroller is installed, it must accept the files too, with floats.
#include <dlfcn.h>
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>

#include "alembert/native/compilation.hpp"
#include "alembert/native/module.hpp"
#include "codegen/machine/memory_solver.hpp"
#include "emitted.hpp"
#include "program/differentiate.hpp"
#include "program/interpret.hpp"
#include "redundant_plate.hpp"
#include "scene/scene.hpp"
#include "scenes.hpp"
#include "simulate/emission.hpp"
#include "simulate/evaluate.hpp"
#include "simulate/simulate.hpp"
#include "tools.hpp"

namespace emit_c {

using namespace alembert;

namespace {

const char* const scenes[] = {
    "textbook/double_pendulum", "textbook/rolling_disc",   "textbook/sled",
    "textbook/watt_governor",   "textbook/planetary_gear", "textbook/free_body_quaternion",
    "textbook/heavy_top_joint", "textbook/falling_ladder"};

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

/// The functions of constraints, with M u' = f + Bᵀλ, B being A in speeds.
struct HeldFunctions {
    std::function<void(double, const double*, double*)> rhs;
    std::function<void(double, const double*, double*, double*)> mass_forcing;
    std::function<void(double, const double*, double*, double*, double*)> constraints_at;
    std::function<void(double, const double*, double*)> multipliers_at;
};

/// All arrays have `count` rows and nothing is written behind them; λ are those of `expected`, and balance the
/// forces.
void check_rows(const HeldFunctions& f, std::size_t count, const Evaluation& expected, std::size_t speeds,
                bool own_speeds) {
    constexpr double untouched = 1.25e300;
    REQUIRE(count == expected.multipliers.size());
    const std::size_t n = expected.q.size(), width = own_speeds ? n + speeds : n;
    std::vector<double> state = expected.q, rate(n + speeds), mass(speeds * speeds), forcing(speeds);
    if (own_speeds)
        for (const auto& [name, value] : expected.speeds) state.push_back(value);
    else
        state.insert(state.end(), expected.rates.begin(), expected.rates.end());
    const auto guarded = [&](std::size_t size) { return std::vector<double>(size + 4, untouched); };
    std::vector<double> position = guarded(count), velocity = guarded(count), rows = guarded(count * width),
                        lambda = guarded(count);
    const double t = expected.time;
    f.rhs(t, state.data(), rate.data());
    f.mass_forcing(t, state.data(), mass.data(), forcing.data());
    f.constraints_at(t, state.data(), position.data(), velocity.data(), rows.data());
    f.multipliers_at(t, state.data(), lambda.data());
    for (const auto& [array, size] : {std::pair(&position, count), std::pair(&velocity, count),
                                      std::pair(&rows, count * width), std::pair(&lambda, count)})
        for (std::size_t k = 0; k < array->size(); ++k) {
            CAPTURE(k);
            CHECK(((*array)[k] == untouched) == (k >= size));
        }
    for (std::size_t k = 0; k < count; ++k) {
        CHECK(std::abs(position[k]) < 1e-12);
        CHECK(std::abs(velocity[k]) < 1e-12);
        CHECK(lambda[k] == doctest::Approx(expected.multipliers[k].second).epsilon(1e-10));
    }
    for (std::size_t i = 0; i < speeds; ++i) {
        double left = -forcing[i], size = std::abs(forcing[i]);
        for (std::size_t j = 0; j < speeds; ++j) left += mass[i * speeds + j] * rate[n + j];
        for (std::size_t k = 0; k < count; ++k) {
            const double share = rows[(own_speeds ? count * n : 0) + k * speeds + i] * lambda[k];
            left -= share;
            size = std::max(size, std::abs(share));
        }
        CHECK(std::abs(left) <= 1e-10 * size);
    }
}

/// Scenes with rows that follow from others: of rates, of positions that move, in speeds that keep all rows, and
/// with a row that the speeds have eliminated.
std::vector<Scene> scenes_with_redundant_rows() {
    const std::string bead =
        "gravity = [0, \"-9.81\"]\n[coordinates]\nx = 0\ny = { guess = 0, rate_guess = 0 }\nz = { guess = 0.3, "
        "rate_guess = 0 }\n"
        "[[particle]]\nname = \"P\"\nmass = 2\nposition = [\"x\", \"y\"]\n"
        "[[particle]]\nname = \"Q\"\nmass = 3\nposition = [\"z\", 0]\n"
        "[[constraint]]\nname = \"a\"\nholonomic = \"y - x^2 - t\"\n"
        "[[constraint]]\nname = \"b\"\nholonomic = \"z - 2*y - 0.3\"\n"
        "[[constraint]]\nname = \"c\"\nholonomic = \"z - 2*x^2 - 2*t - 0.3\"\n";
    const auto in_speeds = [](const std::string& speeds) {
        return parse_scene(test::redundant_plate + "\n[speeds]\n" + speeds, "plate_in_speeds.toml");
    };
    return {parse_scene(test::redundant_plate, "plate.toml"), parse_scene(bead, "bead.toml"),
            in_speeds("a = \"x' + 0.3*phi'\"\nb = \"phi'\"\nc = \"y' - x'\"\n"),
            in_speeds("a = \"x' - R*phi'\"\n"), parse_scene(test::redundant_wheels, "wheels.toml")};
}

}  // namespace

TEST_CASE("emit: the C99 compiles without a warning, and its rates and Jacobian are those of the program") {
    const test::Folder folder;
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
    REQUIRE(folder.runs("cc " + strict + " -O1 -ffp-contract=off -shared -fPIC -o " + folder.file("all.so") +
                        files + " -lm"));
    const Library library(folder.file("all.so"));
    REQUIRE(library.handle != nullptr);
    for (const auto& e : all) {
        CAPTURE(e->source.file);
        compare(library, *e);
    }
    if (test::has_program("arm-none-eabi-gcc"))
        CHECK(
            folder.runs("arm-none-eabi-gcc -mcpu=cortex-m7 -mthumb -c -O1 "
                        "-DALEMBERT_REAL=float -std=c99" +
                        files));
}

TEST_CASE("emit: long functions in C are written in parts, with the same values") {
    const test::Folder folder;
    Emission e = emission(read_scene(test::source_path("scenes/benchmark/trees/arm7.toml")),
                          {.jacobian = true, .language = CodeLanguage::c});
    const Source parted = emit(e.derivatives->program, {.language = CodeLanguage::c, .longest_function = 60});
    CHECK(parted.text.find("carried[") != std::string::npos);
    folder.write(parted.file, parted.text);
    folder.write(parted.header->name, parted.header->text);
    REQUIRE(folder.runs("cc -std=c99 -pedantic -Wall -Wextra -Werror -O0 -shared -fPIC -o " +
                        folder.file("one.so") + " " + folder.file(parted.file) + " -lm"));
    const Library library(folder.file("one.so"));
    REQUIRE(library.handle != nullptr);
    compare(library, e);
}

// The motion that `simulate` gives by a method of higher order; the scene's tolerance is that of a step.
TEST_CASE("emit: the main program beside a file integrates to the end that simulate finds, in C and in C++") {
    const test::Folder folder;
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
            REQUIRE(folder.runs(compiled));
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

TEST_CASE(
    "emit: constraints and multipliers have one count in C, C++ and memory, where rows follow from others too") {
    const test::Folder folder;
    for (const Scene& scene : scenes_with_redundant_rows()) {
        const Emission e = emission(scene, {.language = CodeLanguage::c});
        CAPTURE(e.source.file);
        REQUIRE_FALSE(e.mechanism.redundant.empty());
        const Evaluation expected = evaluate(scene);
        const Program& p = e.choice.program;
        const std::size_t speeds = p.nodes_of(Group::acceleration).size();
        const std::string name = e.source.file.substr(0, e.source.file.size() - 2);
        folder.write(e.source.file,
                     e.source.text + fmt::format("\nint count(void) {{ return {}_constraints; }}\n", name));
        folder.write(e.source.header->name, e.source.header->text);
        REQUIRE(folder.runs(fmt::format("cc -std=c99 -O1 -shared -fPIC -o {} {} -lm", folder.file(name + ".so"),
                                        folder.file(e.source.file))));
        const Library library(folder.file(name + ".so"));
        REQUIRE(library.handle != nullptr);
        const auto c = [&]<class Function>(const char* part) {
            const auto found = library.function<Function>(name + "_" + part);
            REQUIRE((found != nullptr));
            return found;
        };
        std::vector<double> par(100);
        c.operator()<Defaults>("defaults")(par.data());
        using Two = void(double, const double*, const double*, double*, double*);
        using Three = void(double, const double*, const double*, double*, double*, double*);
        check_rows(
            {.rhs = [&, f = c.operator()<Rhs>("rhs")](double t, const double* y,
                                                      double* rate) { f(t, y, par.data(), rate); },
             .mass_forcing = [&, f = c.operator()<Two>("mass_forcing")](
                                 double t, const double* y, double* M,
                                 double* force) { f(t, y, par.data(), M, force); },
             .constraints_at = [&, f = c.operator()<Three>("constraints_at")](
                                   double t, const double* y, double* position, double* velocity,
                                   double* rows) { f(t, y, par.data(), position, velocity, rows); },
             .multipliers_at = [&, f = c.operator()<Rhs>("multipliers_at")](
                                   double t, const double* y, double* lambda) { f(t, y, par.data(), lambda); }},
            static_cast<std::size_t>(library.function<int()>("count")()), expected, speeds, !p.speeds.empty());
        std::vector<Module> modules{load(compile(emit(p).text, name, {}).object)};
        if (const auto solver = memory_solver(p)) modules.push_back(solver->module);
        for (const Module& module : modules) {
            const alembert_solver_table& table = module.table();
            CHECK(module.independent_constraints() == static_cast<int>(e.mechanism.constraints.size()));
            par = prepared(module);
            check_rows({.rhs = [&](double t, const double* y, double* rate) { table.rhs(t, y, par.data(), rate); },
                        .mass_forcing = [&](double t, const double* y, double* M,
                                            double* force) { table.mass_forcing(t, y, par.data(), M, force); },
                        .constraints_at =
                            [&](double t, const double* y, double* position, double* velocity, double* rows) {
                                table.constraints_at(t, y, par.data(), position, velocity, rows);
                            },
                        .multipliers_at = [&](double t, const double* y,
                                              double* lambda) { table.multipliers_at(t, y, par.data(), lambda); }},
                       static_cast<std::size_t>(table.constraints), expected, speeds, !p.speeds.empty());
        }
    }
}

}  // namespace emit_c
