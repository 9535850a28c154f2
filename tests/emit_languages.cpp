// SPDX-License-Identifier: MIT
// Emitted files of Python, Julia, MATLAB, Rust and Modelica compute what the C++ of the same scene computes, at
// 100 states, all their functions: Python in NumPy, MATLAB in Octave, Rust compiled, Julia and Modelica as their
// grammars say (tests/languages/straight_line.py), and Julia by itself where it is there. Names that these
// languages reserve and texts of a scene change nothing.
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "alembert/base/error.hpp"
#include "alembert/native/process.hpp"
#include "analysis/state/assemble.hpp"
#include "codegen/emit/dialect.hpp"
#include "codegen/emit/solver_functions.hpp"
#include "codegen/emit/vocabulary.hpp"
#include "emitted.hpp"
#include "named_spring.hpp"
#include "scene/scene.hpp"
#include "scenes.hpp"
#include "tools.hpp"

namespace emit_languages {

using namespace alembert;

namespace {

constexpr int states = 100;

/// A function of a file: the arrays that it takes and gives.
struct Called {
    std::string name;
    std::vector<std::string> takes;
    std::vector<std::pair<std::string, std::size_t>> gives;
};

/// A scene's functions, and the numbers that they are called with.
struct Calls {
    std::vector<Called> functions;
    std::vector<std::map<std::string, std::vector<double>>> at;
    std::size_t length = 0;  ///< of par, with what prepare adds
    std::size_t parameters = 0, inputs = 0, size = 0;
};

Called called(const FunctionTask& task, bool has_inputs) {
    Called result{.name = task.name, .takes = {}, .gives = {}};
    for (const FunctionArgument& a : task.arguments) {
        if (!a.type.starts_with("Real*")) {
            result.takes.push_back(a.name);
            if (a.name == "par" && has_inputs) result.takes.emplace_back("inputs");
            continue;
        }
        std::size_t size = a.name == "out" ? task.size : 0;
        if (a.name == "rate") size = task.copies.size();
        for (const FunctionResult& one : task.results)
            if (one.array == a.name)
                size = std::max(size, *std::max_element(one.places.begin(), one.places.end()) + 1);
        result.gives.emplace_back(a.name, size);
    }
    return result;
}

Calls calls_of(const Emission& e) {
    const Program& p = e.derivatives ? e.derivatives->program : e.choice.program;
    const Vocabulary words(p);
    Calls calls{.functions = {},
                .at = {},
                .length = words.par().size() + words.constants().size(),
                .parameters = words.par().size(),
                .inputs = static_cast<std::size_t>(words.inputs_from_outside()),
                .size = words.q().size() + words.u().size()};
    std::vector<FunctionTask> tasks = {
        right_hand_side(p, words), mass_forcing(p),           energy(p),      outputs_at(p), events_at(p),
        constraints_at(p),         multipliers_at(p),         impulses_at(p), project(p),    gamma_at(p),
        jacobian(p).task,          parameter_jacobian(p).task};
    for (const NamedFunction& function : e.functions) tasks.push_back(named_function(p, function));
    for (const FunctionTask& task : tasks)
        if (!task.results.empty() || !task.copies.empty())
            calls.functions.push_back(called(task, calls.inputs > 0));
    const Start start = start_of(e.mechanism);
    const State<double> first = state_of(start, e.mechanism, e.equations);
    std::mt19937_64 random(2026);
    std::uniform_real_distribution<double> share(-1, 1);
    for (int k = 0; k < states; ++k) {
        auto& at = calls.at.emplace_back();
        for (const char* const name : {"values", "inputs"}) at[name] = {};
        at["t"] = {k == 0 ? first.t : share(random)};
        for (const auto* const part : {&first.q, &first.qdot})
            for (const double x : *part) at["state"].push_back(x + (k == 0 ? 0 : 0.3 * share(random)));
        for (std::size_t i = 0; i < calls.size; ++i) at["rate"].push_back(share(random));
        for (const Quantity& one : p.parameters)
            at["values"].push_back(one.value * (k == 0 ? 1 : 1 + 0.01 * share(random)));
        for (std::size_t i = 0; i < calls.inputs; ++i)
            at["inputs"].push_back(p.parameters[static_cast<std::size_t>(words.first_input()) + i].value +
                                   share(random));
    }
    return calls;
}

std::string joined(const std::vector<double>& values) {
    return fmt::format("{}", fmt::join(values, " "));
}

/// Writes the calls in the form of straight_line.py, and their numbers alone.
void write_calls(const test::Folder& folder, const Calls& calls) {
    std::string text, numbers;
    for (const auto& at : calls.at) {
        text += fmt::format("prepare|par|{}|[{}]\n", calls.length, joined(at.at("values")));
        for (const Called& one : calls.functions) {
            std::vector<std::size_t> sizes;
            for (const auto& [name, size] : one.gives) sizes.push_back(size);
            text += fmt::format("{}|{}|{}", one.name, one.name, fmt::join(sizes, " "));
            for (const std::string& argument : one.takes)
                text += argument == "par" ? "|=par"
                        : argument == "t" ? "|" + joined(at.at("t"))
                                          : "|[" + joined(at.at(argument)) + "]";
            text += "\n";
        }
        for (const char* const name : {"t", "state", "rate", "values", "inputs"})
            if (const auto found = at.find(name); found != at.end()) numbers += joined(found->second) + "\n";
    }
    folder.write("calls.txt", text);
    folder.write("numbers.txt", numbers);
}

std::string main_in_cpp(const Calls& calls, const std::string& file, const std::string& space) {
    const auto array = [](const char* name, std::size_t size) {
        return fmt::format("double {0}[{1}]; for (int k = 0; k < {2}; ++k) {0}[k] = next();\n", name, size + 1,
                           size);
    };
    std::string text = fmt::format(
        "#include <cstdio>\n#include \"{}\"\ndouble next() {{ double x = 0; return std::scanf(\"%lf\", &x) == 1 ? "
        "x : 0; }}\n"
        "int main() {{ for (int n = 0; n < {}; ++n) {{\nconst double t = next();\n",
        file, states);
    text += array("state", calls.size) + array("rate", calls.size) +
            fmt::format("double par[{}]; for (int k = 0; k < {}; ++k) par[k] = next();\n", calls.length + 1,
                        calls.parameters) +
            array("inputs", calls.inputs);
    if (calls.length > calls.parameters) text += space + "::prepare(par);\n";
    for (const Called& one : calls.functions) {
        text += "{ ";
        std::string given = fmt::format("{}", fmt::join(one.takes, ", ")), shown;
        for (const auto& [name, size] : one.gives) {
            text += fmt::format("double of_{}[{}] = {{}}; ", name, size + 1);
            given += ", of_" + name;
            shown += fmt::format("for (int k = 0; k < {}; ++k) std::printf(\"%.17g \", of_{}[k]); ", size, name);
        }
        text += fmt::format("{}::{}({}); {}}}\n", space, one.name, given, shown);
    }
    return text + "} }\n";
}

std::string main_in_rust(const Calls& calls, const std::string& name, const std::string& type) {
    std::string text = fmt::format(
        "mod {0};\nuse std::io::Read;\nfn main() {{\n    let mut text = String::new();\n"
        "    std::io::stdin().read_to_string(&mut text).unwrap();\n"
        "    let mut all = text.split_whitespace().map(|word| word.parse::<f64>().unwrap() as {1});\n"
        "    let mut next = |n: usize| -> Vec<{1}> {{ (0..n).map(|_| all.next().unwrap()).collect() }};\n"
        "    for _ in 0..{2} {{\n        let t = next(1)[0];\n        let state = next({3});\n        let rate = "
        "next({3});\n"
        "        let mut par = next({4});\n        let inputs = next({5});\n        par.resize({6}, 0.0);\n"
        "        {0}::prepare(&mut par);\n",
        name, type, states, calls.size, calls.parameters, calls.inputs, calls.length);
    for (const Called& one : calls.functions) {
        std::string given, shown;
        for (const std::string& argument : one.takes) given += (argument == "t" ? "" : "&") + argument + ", ";
        text += "        {\n";
        for (const auto& [array, size] : one.gives) {
            text += fmt::format("            let mut of_{} = vec![0.0; {}];\n", array, size);
            given += fmt::format("&mut of_{}, ", array);
            shown += fmt::format("            for x in &of_{} {{ print!(\"{{:?}} \", x); }}\n", array);
        }
        text += fmt::format("            {}::{}({});\n{}        }}\n", name, one.name,
                            given.substr(0, given.size() - 2), shown);
    }
    return text + "    }\n}\n";
}

/// Holds numbers against those of the C++: to this share of the largest number of an array of a call.
void compare(const std::vector<double>& expected, const std::vector<double>& found, const Calls& calls,
             double share = 1e-12) {
    REQUIRE(found.size() == expected.size());
    std::size_t at = 0;
    for (int n = 0; n < states; ++n)
        for (const Called& one : calls.functions) {
            std::size_t count = 0;
            for (const auto& [name, size] : one.gives) count += size;
            double largest = 0, off = 0;
            for (std::size_t k = at; k < at + count; ++k) {
                if (std::isnan(expected[k])) {
                    CHECK(std::isnan(found[k]));
                    continue;
                }
                if (expected[k] == found[k]) continue;
                largest = std::max(largest, std::abs(expected[k]));
                off = std::max(off, std::abs(expected[k] - found[k]));
            }
            INFO(one.name << " of call " << n << ": off by " << off << " of " << largest);
            CHECK(off <= share * largest);
            at += count;
        }
    CHECK(at == expected.size());
}

std::string tool(const std::string& name) {
    return test::source_path("tests/languages/" + name);
}

std::vector<double> numbers_of(const test::Folder& folder, const std::string& command) {
    const std::string text = folder.told(command);
    CAPTURE(text.substr(0, 2000));
    REQUIRE(text.find("status") != 0);
    std::vector<double> numbers;
    std::istringstream words(text);
    for (std::string word; words >> word;) numbers.push_back(std::stod(word));
    return numbers;
}

Emission written(const test::Folder& folder, const Scene& scene, EmissionOptions options, CodeLanguage language,
                 std::size_t longest) {
    options.language = language;
    Emission e = emission(scene, options);
    if (longest > 0) {
        EmitOptions text{.language = language, .functions = e.functions, .longest_function = longest};
        e.source = emit(e.derivatives ? e.derivatives->program : e.choice.program, text);
    }
    for (const SourceFile& file : files_of(e)) folder.write(file.name, file.text);
    return e;
}

/// Writes a scene in all languages, and compares what their functions give with the C++, or with `expected`, if
/// that has numbers. Gives the numbers of the C++.
std::vector<double> agree(const Scene& scene, const EmissionOptions& options = {}, std::size_t longest = 0,
                          const std::vector<double>& expected_before = {}) {
    const test::Folder folder;
    const Emission e = written(folder, scene, options, CodeLanguage::cpp, 0);
    const Calls calls = calls_of(e);
    write_calls(folder, calls);
    std::vector<double> expected = expected_before;
    if (expected.empty()) {
        const std::string name =
            ascii_identifier((e.derivatives ? e.derivatives->program : e.choice.program).name);
        folder.write("main.cpp", main_in_cpp(calls, e.source.file, name));
        REQUIRE(folder.runs("g++ -std=c++20 -O0 -w main.cpp -o by_cpp"));
        expected = numbers_of(folder, "./by_cpp < numbers.txt");
    }
    for (const Dialect& dialect : dialects()) {
        if (!dialect.is_shaped()) continue;
        CAPTURE(dialect.name);
        const Emission other = written(folder, scene, options, dialect.language, longest);
        const std::string& file = other.source.file;
        const std::string module = file.substr(0, file.find('.'));
        CHECK(file == module + "." + std::string(dialect.extension));
        const bool in_parts = other.source.text.find("carried") != std::string::npos;
        CHECK(in_parts == (longest > 0 && dialect.results == ResultArrays::filled));
        const auto holds = [&](const std::string& command) {
            compare(expected, numbers_of(folder, command), calls);
        };
        switch (dialect.language) {
            case CodeLanguage::python:
                if (!test::is_provided(folder.runs("python3 -c 'import numpy'"), "NumPy")) break;
                holds(fmt::format("python3 -B -W ignore {} {} calls.txt", tool("calls.py"), module));
                break;
            case CodeLanguage::julia:
                holds(fmt::format("python3 -B {} julia {} calls.txt", tool("straight_line.py"), file));
                if (!find_program("julia").empty())  // Debian has none
                    holds(fmt::format("julia --startup-file=no {} {} calls.txt", tool("calls.jl"), module));
                break;
            case CodeLanguage::matlab:
                if (test::has_program("octave-cli"))
                    holds(fmt::format("octave-cli --norc {} {} calls.txt 2>octave.log", tool("calls.m"), module));
                break;
            case CodeLanguage::rust:
                if (!test::has_program("rustc")) break;
                folder.write("main.rs", main_in_rust(calls, module, "f64"));
                REQUIRE(folder.told("rustc --edition 2018 -D warnings -A unused main.rs -o by_rust") == "");
                holds("./by_rust < numbers.txt");
                break;
            case CodeLanguage::modelica:
                holds(fmt::format("python3 -B {} modelica {} calls.txt", tool("straight_line.py"), file));
                break;
            default:
                FAIL("a language without a test");
        }
    }
    return expected;
}

std::vector<double> agree(const std::string& scene, const EmissionOptions& options = {}) {
    CAPTURE(scene);
    return agree(read_scene(test::source_path(scene)), options);
}

/// Functions by points of all kinds; states lie beyond their ends too, where e has no value.
constexpr const char* tables = R"toml([coordinates]
x = { initial = 0.1, rate = 0.2 }
[[particle]]
name = "car"
mass = 1.5
position = ["x", 0]
[tables]
e = { arguments = ["v"], points = [[-0.1, 0.2], [0.1, 0.5], [0.4, 0.1]] }
f = { arguments = ["x"], interpolation = "pchip", outside = "line", points = [[-0.1, -3], [0, -1], [0.05, 0], [0.1, 1.2], [0.3, 2]] }
g = { arguments = ["t"], period = 0.7, points = [[0, 0], [0.3, 1], [0.6, -0.5]] }
h = { arguments = ["x", "v"], outside = "hold", interpolation = "cubic", points = [[-0.1, -0.1, 0.1], [-0.1, 0, 0.4], [-0.1, 0.2, 0.2], [0, -0.1, 0.3], [0, 0, 0.2], [0, 0.2, 0.5], [0.2, -0.1, 0], [0.2, 0, 0.1], [0.2, 0.2, 0.4]] }
k = { arguments = ["x", "v"], outside = "line", points = [[-0.1, -0.1, 0.1], [-0.1, 0.1, 0.2], [0, -0.1, 0.3], [0, 0.1, 0.5], [0.1, -0.1, 0], [0.1, 0.1, 0.4]] }
[forces]
x = "-f(x) + g(t) - h(x, x')*x' - k(x, x')*x'"
[outputs]
measured = "e(x') + f(x)"
)toml";

}  // namespace

TEST_CASE("emit: files of five further languages compute what the C++ computes, with Jacobians and constraints") {
    const EmissionOptions with_jacobian{.jacobian = true};
    agree("scenes/textbook/double_pendulum.toml", with_jacobian);
    agree("scenes/textbook/four_bar.toml", with_jacobian);
    agree("scenes/textbook/sled.toml");
    agree("scenes/textbook/rolling_disc_in_space.toml");
    agree("scenes/textbook/bouncing_ball.toml");
}

TEST_CASE("emit: functions of robots, tables and inputs from outside are the same in five further languages") {
    agree("scenes/gallery/six_joint_arm.toml",
          {.functions = {"inverse", "mass", "gravity", "com_jacobian"}, .frames = {"flange"}});
    agree("scenes/gallery/six_joint_arm.toml", {.fold = true, .wrenches = {"flange"}});
    agree("scenes/elements/drag_table.toml", {.jacobian = true});
    agree("scenes/elements/cam.toml", {.jacobian = true});
    agree("scenes/elements/hill_muscle.toml");
    agree("scenes/elements/dc_motor.toml", {.jacobian = true});
    agree(parse_scene(tables, "tables.toml"), {.jacobian = true});
}

TEST_CASE(
    "emit: functions that are too long for one are written in parts in Julia and Rust, and whole elsewhere") {
    agree(read_scene(test::source_path("scenes/benchmark/trees/arm7.toml")), {}, 60);
}

TEST_CASE("emit: reserved words of each language as names, and texts that would end a comment, change nothing") {
    const std::vector<std::vector<std::string>> names = {
        {"g", "m", "l", "c", "theta", "s"},
        {"lambda", "def", "None", "xp", "numpy", "is"},
        {"end", "function", "begin", "local", "where", "NaN"},
        {"elseif", "ans", "endfunction", "zeros", "scene", "choose"},
        {"fn", "match", "Some", "R", "self", "crate"},
        {"algorithm", "equation", "der", "Motion", "within", "size"},
        {"array_of", "values", "out", "root_or_nan", "table_place", "x1"},
        {"PARAMETER_VALUES", std::string(70, 'a'), std::string(70, 'a') + "b", "end_", "arcsin", "INITIAL_TIME"}};
    const std::string text = R"(''' \" #= =# %{ %} // */ --> </script> $(x) {{{head}}} \u000aimport os\u2028end;)";
    std::vector<double> expected;
    for (const std::vector<std::string>& six : names) {
        CAPTURE(six[0]);
        const bool is_first = expected.empty();
        const Scene scene = parse_scene(test::spring_scene(six, is_first ? "m" : text, true),
                                        is_first ? "named.toml" : six[0] + ".toml");
        expected = agree(scene, {}, 0, expected);
    }
}

TEST_CASE("emit: Rust computes in floats, and stands in a crate without std") {
    if (!test::has_program("rustc")) return;
    const test::Folder folder;
    const Scene scene = read_scene(test::source_path("scenes/textbook/double_pendulum.toml"));
    const Emission e = written(folder, scene, {}, CodeLanguage::rust, 0);
    const Calls calls = calls_of(e);
    write_calls(folder, calls);
    const auto by = [&](const std::string& type) {
        folder.write("main.rs", main_in_rust(calls, "double_pendulum", type));
        REQUIRE(folder.told("rustc --edition 2018 -D warnings -A unused main.rs -o by_rust") == "");
        return numbers_of(folder, "./by_rust < numbers.txt");
    };
    const std::vector<double> doubles = by("f64"), floats = by("f32");
    CHECK(doubles != floats);
    compare(doubles, floats, calls, 1e-4);  // accelerations lose two of seven digits
    folder.write("library.rs", "#![no_std]\n#![deny(warnings)]\npub mod double_pendulum;\n");
    CHECK(folder.told("rustc --edition 2018 --crate-type rlib library.rs") == "");
}

TEST_CASE("emit: what is not written in a further language is refused") {
    const Scene scene = read_scene(test::source_path("scenes/textbook/double_pendulum.toml"));
    for (const Dialect& dialect : dialects()) {
        if (!dialect.is_shaped()) continue;
        CAPTURE(dialect.name);
        for (const EmissionOptions& wishes : {EmissionOptions{.batch = true}, EmissionOptions{.standalone = true},
                                              EmissionOptions{.casadi = true}}) {
            EmissionOptions in_language = wishes;
            in_language.language = dialect.language;
            CHECK_THROWS_AS(emission(scene, in_language), ModelError);
        }
        CHECK(dialect_of(dialect.option) == &dialect);
        CHECK(language_of(dialect.option) == dialect.language);
    }
    CHECK(dialect_of("fortran") == nullptr);
}

}  // namespace emit_languages
