// SPDX-License-Identifier: MIT
// Emitted C++ in a program of one's own, as its user builds it: any number of systems, by header and source, by
// the source in several units or namespaces, with strict warnings of two compilers, and with other types of
// numbers. What such programs print is held against the interpreter of `eval`, and other numbers against a program
// in quadruple precision.
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "codegen/emit/interface.hpp"
#include "emitted.hpp"
#include "near.hpp"
#include "scene/scene.hpp"
#include "scenes.hpp"
#include "simulate/evaluate.hpp"

namespace emit_programs {

using namespace alembert;

namespace {

std::vector<std::string> compilers() {
    std::vector<std::string> found{"g++"};
    if (std::system("clang++ --version >/dev/null 2>&1") == 0) found.emplace_back("clang++");
    return found;
}

Scene textbook(const std::string& name) {
    return read_scene(test::source_path("scenes/textbook/" + name + ".toml"));
}

/// A scene with every function that emitted code may call.
Scene with_all_functions() {
    return parse_scene(R"toml(
[parameters]
a = 1.3
b = { value = 40, unit = "deg" }
[coordinates]
x = { initial = 0.3, rate = 0.2 }
y = { initial = 0.4, rate = -0.1 }
[[particle]]
name = "P"
mass = 1
position = ["x", "y"]
[forces]
x = "sin(x) + cos(y) + tan(a*x) + asin(x/2) + acos(y/2) + atan(x) + )toml"
                       R"toml(sqrt(1 + y^2) + abs(x) + min(x, 0.1*y) + max(a, x)"
y = "sinh(x) + cosh(y) + tanh(x) + exp(-x) + ln(2 + y) + atan2(x, a) + (2 + x)^a + sign(y) + cos(2*a*b - x)*0.1"
[outputs]
d = "x - 0.7*y"
[[event]]
name = "wall"
when = "x - 3"
stop = true
)toml",
                       "all.toml");
}

/// The rates at the start, coordinates first, as `eval` gives them.
std::vector<double> rates_of(const Scene& scene) {
    const Evaluation at = evaluate(scene);
    std::vector<double> rates = at.rates;
    rates.insert(rates.end(), at.accelerations.begin(), at.accelerations.end());
    return rates;
}

constexpr const char* strict = "-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror";

/// Prints the rates of a system at its start, by header.
std::string printing(const std::string& name) {
    return fmt::format(
        "void print_{0}() {{\n    const {0}::State rate = {0}::rhs({0}::initial_time, {0}::initial_state, "
        "{0}::defaults());\n"
        "    for (int k = 0; k < {0}::state_size; ++k) std::printf(\"%.17g\\n\", {0}::numbers(rate)[k]);\n}}\n",
        name);
}

}  // namespace

TEST_CASE("emitted C++: a hundred systems are in one program, each in a unit of its own") {
    const test::Folder folder;
    std::vector<double> expected;
    std::string includes = "#include <cstdio>\n", functions, calls, sources;
    for (int k = 0; k < 100; ++k) {
        const std::string name = fmt::format("pendulum{}", k);
        const Scene scene = parse_scene(
            fmt::format(
                "gravity = [0, -9.81]\n[parameters]\nl = {}\n[coordinates]\ntheta = 0.3\n[[particle]]\nname = "
                "\"p\"\nmass = 1\nposition = [\"l*sin(theta)\", \"-l*cos(theta)\"]\n",
                1 + 0.01 * k),
            "pendulum.toml");
        folder.emit(scene, {.name = name});
        includes += fmt::format("#include \"{}.hpp\"\n", name);
        functions += printing(name);
        calls += fmt::format("    print_{}();\n", name);
        sources += " " + name + ".cpp";
        for (const double rate : rates_of(scene)) expected.push_back(rate);
    }
    folder.write("main.cpp", includes + "namespace {\n" + functions + "}\nint main() {\n" + calls + "}\n");
    for (const std::string& compiler : compilers()) {
        CAPTURE(compiler);
        test::check_near(
            folder.numbers(compiler + " -std=c++17 -O0 main.cpp" + sources + " -o program && ./program"), expected,
            1e-14);
    }
}

TEST_CASE("emitted C++: sources in one unit, one source in two units, and in namespaces of one's own") {
    const test::Folder folder;
    const Scene first = textbook("double_pendulum"), second = textbook("sled");
    folder.emit(first, {.jacobian = true});
    folder.emit(second);
    folder.write("other.cpp",
                 "#include <cmath>\n#include \"double_pendulum.cpp\"\ndouble other(double x) { return sin(x); }\n"
                 "namespace mine {\n#include \"sled.cpp\"\n}\nconst void* table_of_mine() { return "
                 "&mine::sled::table; }\n");
    folder.write("unity.cpp",
                 "#include <cstdio>\n#include <cmath>\n#include \"double_pendulum.hpp\"\n"
                 "#include \"double_pendulum.cpp\"\n#include \"sled.cpp\"\n#include \"sled.hpp\"\n"
                 "double other(double x);\nconst void* table_of_mine();\n" +
                     printing("double_pendulum") + printing("sled") +
                     "int main() {\n    print_double_pendulum();\n    print_sled();\n"
                     "    const double x = 1;\n"
                     "    return other(x) == sin(x) && table_of_mine() != nullptr ? 0 : 1;\n}\n");
    std::vector<double> expected = rates_of(first);
    for (const double rate : rates_of(second)) expected.push_back(rate);
    for (const std::string& compiler : compilers()) {
        CAPTURE(compiler);
        test::check_near(folder.numbers(compiler + " -std=c++20 -O1 unity.cpp other.cpp -o program && ./program"),
                         expected, 1e-13);
    }
}

TEST_CASE("emitted C++: a file that includes the source as before goes on working") {
    const test::Folder folder;
    const Scene scene = textbook("double_pendulum");
    folder.emit(scene);
    // The program that stood at the head of the file before there were namespaces.
    folder.write("before.cpp", R"cpp(
#include <cstdio>
#include "double_pendulum.cpp"
        int main() {
            const double state[4] = {0.5, 0.8, 0, 0};
            double par[64], rate[4], again[4];
            for (int k = 0; k < table.parameters; ++k) par[k] = parameter_values[k];
            prepare(par);
            rhs(0.0, state, par, rate);
            table.rhs(0.0, state, par, again);
            for (int k = 0; k < 4; ++k) {
                if (again[k] != rate[k] || alembert_solver() != &table) return 1;
                std::printf("%.17g\n", rate[k]);
            }
        }
    )cpp");
    folder.write(
        "header.cpp",
        "#include <cstdio>\n#include \"double_pendulum.hpp\"\nint main() {\n"
        "    double_pendulum::State y;\n    double* const state = double_pendulum::numbers(y);\n"
        "    state[0] = 0.5, state[1] = 0.8;\n"
        "    const double_pendulum::State rate = double_pendulum::rhs(0, y, double_pendulum::defaults());\n"
        "    for (int k = 0; k < 4; ++k) std::printf(\"%.17g\\n\", double_pendulum::numbers(rate)[k]);\n}\n");
    CHECK(folder.numbers("c++ -std=c++20 before.cpp -o before && ./before") ==
          folder.numbers("c++ -std=c++20 header.cpp double_pendulum.cpp -o header && ./header"));
}

TEST_CASE("emitted C++: no compiler warns, in C++17 and C++20, with packs, fast mathematics, without exceptions") {
    const test::Folder folder;
    folder.emit(with_all_functions(), {.jacobian = true, .batch = true});
    folder.emit(with_all_functions(), {.name = "plain", .jacobian = true});
    folder.emit(textbook("double_pendulum"), {.batch = true});
    folder.emit(textbook("sled"), {.jacobian = true, .functions = {"mass"}});
    folder.emit(read_scene(test::source_path("scenes/gallery/rssr.toml")), {.batch = true});
    for (const std::string& compiler : compilers())
        for (const char* const standard : {"-std=c++17", "-std=c++20"})
            for (const char* const flags :
                 {"-O0", "-O2 -ffast-math", "-O1 -fno-exceptions -fno-rtti", "-O1 -march=x86-64-v3 -ffast-math"})
                for (const char* const file : {"all", "plain", "double_pendulum", "sled", "rssr"}) {
                    if (std::string(flags).find("x86-64") != std::string::npos && std::string(file) != "all")
                        continue;
                    CAPTURE(file);
                    CHECK(folder.told(fmt::format("{} {} {} {} -c {}.cpp -o {}.o", compiler, standard, flags,
                                                  strict, file, file)) == "");
                    CHECK(folder.told(fmt::format("{} {} {} {} -x c++ -fsyntax-only {}.hpp", compiler, standard,
                                                  flags, strict, file)) == "");
                }
}

TEST_CASE("emitted C++: float, long double and a type of one's own have the accuracy of their own functions") {
    const test::Folder folder;
    folder.emit(with_all_functions());
    folder.write("types.cpp", R"cpp(
#include <cmath>
#include <cstdio>
#include "all.cpp"
        namespace own {  // a number that counts in long double, with functions that look-up by arguments finds
        struct Number {
            long double v;
            Number() = default;
            template <typename T>
            explicit Number(T x) : v(static_cast<long double>(x)) {}
        };
        Number operator+(Number a, Number b) {
            return Number(a.v + b.v);
        }
        Number operator-(Number a, Number b) {
            return Number(a.v - b.v);
        }
        Number operator-(Number a) {
            return Number(-a.v);
        }
        Number operator*(Number a, Number b) {
            return Number(a.v * b.v);
        }
        Number operator/(Number a, Number b) {
            return Number(a.v / b.v);
        }
        bool operator<(Number a, Number b) {
            return a.v < b.v;
        }
        bool operator>(Number a, Number b) {
            return a.v > b.v;
        }
        bool operator!=(Number a, Number b) {
            return a.v != b.v;
        }
#define FUNCTION(f)                 \
            inline Number f(Number a) {     \
                return Number(std::f(a.v)); \
            }
        FUNCTION(sin)
        FUNCTION(cos)
        FUNCTION(tan)
        FUNCTION(asin)
        FUNCTION(acos)
        FUNCTION(atan)
        FUNCTION(sinh)
        FUNCTION(cosh)
        FUNCTION(tanh)
        FUNCTION(exp)
        FUNCTION(log)
        FUNCTION(sqrt)
        FUNCTION(abs)
        inline Number pow(Number a, Number b) {
            return Number(std::pow(a.v, b.v));
        }
        inline Number atan2(Number a, Number b) {
            return Number(std::atan2(a.v, b.v));
        }
        }  // namespace own
        long double shown(own::Number x) {
            return x.v;
        }
        long double shown(long double x) {
            return x;
        }
        template <typename Real>
        void print() {
            Real par[64],
                state[4] = {Real(3) / Real(10), Real(2) / Real(5), Real(1) / Real(5), Real(-1) / Real(10)},
                rate[4];
            par[0] = Real(13) / Real(10);
            par[1] = Real(2) * Real(3.14159265358979323846264338327950288L) / Real(9);
            prepare(par);
            rhs(Real(0), state, par, rate);
            for (const Real& value : rate) std::printf("%.25Lg\n", shown(value));
        }
        int main() {
            print<double>();
            print<float>();
            print<long double>();
            print<own::Number>();
        }
    )cpp");
    for (const std::string& compiler : compilers()) {
        CAPTURE(compiler);
        const std::string text = folder.told(compiler + " -std=c++20 -O1 types.cpp -o types && ./types");
        CAPTURE(text);
        std::vector<long double> numbers;
        std::istringstream stream(text);
        for (std::string word; stream >> word;) numbers.push_back(std::stold(word));
        REQUIRE(numbers.size() == 16);
        for (std::size_t k = 0; k < 4; ++k) {
            const long double own = numbers[12 + k], size = std::max(1.0L, std::abs(own));
            CHECK(std::abs(numbers[k] - own) < 4e-15L * size);      // double
            CHECK(std::abs(numbers[4 + k] - own) < 2e-6L * size);   // float
            CHECK(std::abs(numbers[8 + k] - own) < 2e-18L * size);  // long double
        }
    }
}

TEST_CASE("emitted C: floats are counted with the functions of floats") {
    const test::Folder folder;
    folder.emit(with_all_functions(), {.language = CodeLanguage::c, .standalone = false});
    folder.write("main.c", R"c(
#include <stdio.h>
#include "all.h"
int main(void) {
    const ALEMBERT_REAL state[all_state] = {(ALEMBERT_REAL)0.3, (ALEMBERT_REAL)0.4,
                                            (ALEMBERT_REAL)0.2, (ALEMBERT_REAL)-0.1};
    ALEMBERT_REAL par[all_par + 1], rate[all_state];
    all_defaults(par);
    all_rhs(0, state, par, rate);
    for (int k = 0; k < all_state; ++k) printf("%.17g\n", (double)rate[k]);
    return 0;
}
)c");
    const std::string build = "cc -std=c99 -O1 -Wall -Wextra -Wpedantic -Werror main.c all.c -lm -o program";
    const std::vector<double> expected = rates_of(with_all_functions());
    test::check_near(folder.numbers(build + " && ./program"), expected, 1e-14);
    test::check_near(folder.numbers(build + " -DALEMBERT_REAL=float && ./program"), expected, 2e-6);
    for (const char* const real : {"float", "double"})
        for (const std::string& compiler : compilers())
            CHECK(folder.told(fmt::format("{} -x c -std=c99 {} -Wdouble-promotion -DALEMBERT_REAL={} -c all.c -o "
                                          "all.o",
                                          compiler, strict, real)) == "");
    // No function of doubles is called, and no number is made a double.
    CHECK(folder.told(
              "cc -std=c99 -O1 -DALEMBERT_REAL=float -c all.c -o all.o && nm -u all.o | "
              "grep -wE 'U (sin|cos|sincos|tan|asin|acos|atan|sinh|cosh|tanh|exp|log|sqrt|pow|atan2)'; true") ==
          "");
    folder.emit(textbook("double_pendulum"), {.language = CodeLanguage::c, .standalone = true});
    const std::string main = "cc -std=c99 double_pendulum_main.c double_pendulum.c -lm -o alone";
    CHECK(folder.told(main) == "");
    CHECK(folder.told(main + " -DALEMBERT_REAL=float").find("needs_ALEMBERT_REAL_double") != std::string::npos);
}

TEST_CASE(
    "emitted C++: names of scenes that are words of the language or functions of C are namespaces of another "
    "name") {
    const test::Folder folder;
    const std::string body = "[coordinates]\nx = 1\n[[particle]]\nname = \"p\"\nmass = 2\nposition = [\"x\", 0]\n";
    for (const std::string name : {"switch", "time", "link", "gamma", "std", "state", "y0"}) {
        CAPTURE(name);
        folder.emit(parse_scene(body, name + ".toml"));
        folder.write("main.cpp",
                     fmt::format("#include <cmath>\n#include <cstdio>\n#include <ctime>\n#include <unistd.h>\n"
                                 "#include \"{0}.hpp\"\n{1}int main() {{ print_{0}_(); }}\n",
                                 name, printing(name + "_")));
        CHECK(folder.numbers(fmt::format("c++ -std=c++20 main.cpp {}.cpp -o program && ./program", name)) ==
              std::vector<double>{0, 0});
    }
    CHECK_THROWS_AS(emission(parse_scene(body, "x.toml"), {.name = "two words"}), ModelError);
}

TEST_CASE("emitted C: each file has its licence and the command that makes it in its head") {
    for (const CodeLanguage language : {CodeLanguage::c, CodeLanguage::cpp}) {
        const bool is_c = language == CodeLanguage::c;
        const Emission e =
            emission(textbook("double_pendulum"), {.language = language, .standalone = true, .casadi = is_c});
        const std::string command = fmt::format("alembert emit double_pendulum.toml -o .{} --standalone{}\n",
                                                is_c ? " --language c" : "", is_c ? " --casadi" : "");
        const std::vector<SourceFile> files = files_of(e);
        CHECK(files.size() == (is_c ? 4 : 3));
        for (const SourceFile& file : files) {
            CAPTURE(file.name);
            const std::string head = file.text.substr(0, 600);
            CHECK(head.find("SPDX-License-Identifier: MIT\n") <= 6);
            CHECK(head.find("  " + command) != std::string::npos);
        }
    }
}

// Its header would stand before the compiler's own where its folder is given with -I.
TEST_CASE("emitted C: a scene that is called as a header of C has files of another name") {
    const std::string body = "[coordinates]\nx = 1\n[[particle]]\nname = \"p\"\nmass = 2\nposition = [\"x\", 0]\n";
    for (const std::string name : {"math", "stdio", "string", "float"}) {
        CAPTURE(name);
        const test::Folder folder;
        folder.emit(parse_scene(body, name + ".toml"), {.language = CodeLanguage::c, .standalone = true});
        CHECK(folder.told(fmt::format("cc -std=c99 -Wall -Werror -I. {0}_scene_main.c {0}_scene.c -lm -o program "
                                      "&& ./program 1 1e-9 1 | tail -n 1",
                                      name)) == "1,1,0\n");
    }
    CHECK(emission(parse_scene(body, "math.toml")).source.file == "math.cpp");
}

TEST_CASE(
    "emitted C++: the header has parameters in SI units, whatever the scene gives them in, and says in what") {
    const Emission e = emission(with_all_functions());
    REQUIRE(e.source.header);
    const std::string& text = e.source.header->text;
    CHECK(text.find("double b = 0.6981317007977318;  ///< [rad] 40 deg") != std::string::npos);
    CHECK(text.starts_with("// SPDX-License-Identifier: MIT\n"));
    CHECK(e.source.text.starts_with("// SPDX-License-Identifier: MIT\n"));
    // With quaternions another matrix is solved than M of T, and both are called what they are.
    const std::string quaternion = emission(textbook("free_body_quaternion"), {.by = "routh"}).source.text;
    CHECK(quaternion.find("M + c A^T A row by row") != std::string::npos);
    CHECK(quaternion.find("/// M + c A^T A (row-major) and f + c A^T gamma, with a c for the norm of each "
                          "quaternion.") != std::string::npos);
    const Emission in_c = emission(textbook("free_body_quaternion"), {.by = "routh", .language = CodeLanguage::c});
    CHECK(in_c.source.header->text.find("/* M + c A^T A (row-major) and f + c A^T gamma") != std::string::npos);
    CHECK(emission(textbook("sled")).source.text.find("c A^T A") == std::string::npos);
    // Rows and multipliers have their names; the row that follows from the others stands last.
    const std::string cart = emission(parse_scene(R"toml(
[coordinates]
x = 1
y = 0
z = 0
[[particle]]
name = "p"
mass = 1
position = ["x", "y", "z"]
[[constraint]]
name = "in_plane"
holonomic = "z"
[[constraint]]
name = "again"
holonomic = "2*z"
)toml",
                                                  "cart.toml"))
                                 .source.text;
    CHECK(cart.find("rows of A       in_plane, again (follows from the others)") != std::string::npos);
    CHECK(cart.find("lambda[2]: lambda_in_plane, lambda_again") != std::string::npos);
    // The state obeys the constraints to all digits, where guesses were adjusted.
    const Scene scene = read_scene(test::source_path("scenes/gallery/rssr.toml"));
    const Evaluation at = evaluate(scene);
    const std::string header = emission(scene).source.header->text;
    for (const double q : at.q) CHECK(header.find(fmt::format("    {},  // ", q)) != std::string::npos);
}

}  // namespace emit_programs
