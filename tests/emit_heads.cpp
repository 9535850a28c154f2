// SPDX-License-Identifier: MIT
// What surrounds the equations in an emitted file: names that no macro and no keyword can change, comments that no
// text of a scene can close, and a calling example that works as it stands.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "analysis/derive/derived.hpp"
#include "codegen/emit/comment.hpp"
#include "codegen/emit/emit.hpp"
#include "codegen/emit/names.hpp"
#include "codegen/emit/reserved_words.hpp"
#include "emitted.hpp"
#include "program/differentiate.hpp"
#include "program/lower/lower.hpp"
#include "program/tangent.hpp"
#include "scene/scene.hpp"
#include "scenes.hpp"
#include "simulate/evaluate.hpp"

namespace emit_heads {

using namespace alembert;

namespace {

std::vector<std::string> lines_of(const std::string& file) {
    std::ifstream stream(file);
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

/// The program in the comment at the head of a file: all that follows its first #include.
std::string example_in(const std::string& text) {
    std::istringstream stream(text);
    std::string program;
    for (std::string line; std::getline(stream, line) && line != "*/";) {
        if (line.starts_with("//"))
            line = line.substr(2);
        else if (line.empty() && text.starts_with("//"))
            break;
        if (!program.empty() || line.find("#include") != std::string::npos) program += line + "\n";
    }
    return program;
}

constexpr const char* strict = "-pedantic -Wall -Wextra -Werror -O0 ";

/// The numbers that the example at the head of the emitted file prints, as a stranger would get them.
std::vector<double> rates_of_example(const Scene& scene, CodeLanguage language, const std::string& flags) {
    const test::Folder folder;
    const bool is_c = language == CodeLanguage::c;
    const Emission e = emission(scene, {.jacobian = true, .language = language});
    folder.write(e);
    folder.write(is_c ? "example.c" : "example.cpp", example_in(e.source.text));
    if (is_c) CHECK(example_in(e.source.header->text) == example_in(e.source.text));
    if (!is_c) folder.write("by_header.cpp", example_in(e.source.header->text));
    const std::string compiler = is_c ? "cc -std=c99 example.c " + e.source.file : "c++ -std=c++20 example.cpp";
    CAPTURE(e.source.text.substr(0, 3000));
    REQUIRE(folder.runs(compiler + " " + strict + (is_c ? "" : "-Wno-unused-function -Wno-pedantic ") + flags +
                        " -lm -o example && ./example > rates"));
    std::vector<double> rates;
    for (const std::string& line : lines_of(folder.file("rates"))) rates.push_back(std::stod(line));
    if (is_c) return rates;
    // The example of the header has the state with all its digits.
    REQUIRE(folder.runs("c++ -std=c++17 by_header.cpp " + e.source.file + " " + strict + flags +
                        " -o by_header && ./by_header > rates"));
    std::size_t k = 0;
    double size = 1;
    for (const double rate : rates) size = std::max(size, std::abs(rate));
    for (const std::string& line : lines_of(folder.file("rates")))
        CHECK(std::abs(std::stod(line) - rates.at(k++)) <= 1e-9 * size);
    CHECK(k == rates.size());
    return rates;
}

/// The last rates are the accelerations that `eval` gives by its interpreter. States have 12 digits, and the mass
/// matrix of an arm with seven joints costs five or six more.
void check_example(const Scene& scene, CodeLanguage language, const std::string& flags = "") {
    const std::vector<double> rates = rates_of_example(scene, language, flags);
    const Evaluation at = evaluate(scene);
    const std::size_t n = at.q.size();
    const bool own_speeds = !at.speeds.empty() || rates.size() != 2 * n;
    double size = 1;
    for (const double x : at.accelerations) size = std::max(size, std::abs(x));
    REQUIRE(rates.size() >= n);
    for (std::size_t i = 0; i < n; ++i) CHECK(std::abs(rates[i] - at.rates[i]) <= 1e-9 * std::max(1.0, size));
    for (std::size_t i = 0; i < n && !own_speeds; ++i)
        CHECK(std::abs(rates[n + i] - at.accelerations[i]) <= 1e-9 * size);
}

/// A pendulum on a spring whose four parameters have these names.
std::string spring_scene(const std::vector<std::string>& names, const std::string& text = "m") {
    return fmt::format(
        R"toml(title = """{4}"""
gravity = [0, "-{0}"]
[parameters]
"{0}" = {{ value = 9.81, unit = "m", about = """{4}""" }}
"{1}" = 2.5
"{2}" = 0.7
"{3}" = 40
[coordinates]
theta = {{ initial = 0.4, unit = "m", about = """{4}""" }}
s = {{ initial = 0.1, rate = 0.3 }}
[[particle]]
name = "bob"
mass = "{1}"
position = ["({2} + s)*sin(theta)", "-({2} + s)*cos(theta)"]
[forces]
s = "-{3}*s - abs(s)*{1} + min(s, {2}) + sqrt({3} + s^2) + 0.1*atan2(s, {0})"
)toml",
        names[0], names[1], names[2], names[3], text);
}

Scene scene_of(const std::string& text, const std::string& name) {
    return parse_scene(text, name);
}

}  // namespace

TEST_CASE("emit: no name in emitted code is a keyword or a macro of the compiler's headers") {
    const test::Folder folder;
    std::string headers;
    for (const char* const header :
         {"assert", "complex", "ctype",  "errno",  "fenv",    "float",    "inttypes", "iso646",
          "limits", "locale",  "math",   "setjmp", "signal",  "stdalign", "stdarg",   "stdbool",
          "stddef", "stdint",  "stdio",  "stdlib", "string",  "tgmath",   "time",     "uchar",
          "wchar",  "wctype",  "unistd", "fcntl",  "termios", "pthread"})
        headers += fmt::format("#if __has_include(<{0}.h>)\n#include <{0}.h>\n#endif\n", header);
    folder.write("all.c", "#define _GNU_SOURCE\n" + headers);
    folder.write("all.cpp", "#include <version>\n" + headers);
    REQUIRE(folder.runs("cc -dM -E all.c > macros && c++ -dM -E all.cpp >> macros"));
    std::set<std::string> macros;
    for (const std::string& line : lines_of(folder.file("macros"))) {
        const std::string name = line.substr(8, line.find_first_of(" (", 8) - 8);  // after "#define "
        if (name[0] != '_') macros.insert(name);
    }
    REQUIRE(macros.size() > 1000);
    for (const std::string& macro : macros) {
        Names names;
        const std::string first = names.fresh(macro), second = names.fresh(macro), third = names.fresh(macro);
        CAPTURE(macro);
        for (const std::string& name : {first, second, third}) CHECK_MESSAGE(!macros.contains(name), name);
        CHECK(std::set<std::string>{first, second, third}.size() == 3);
    }
    Names names;
    for (const char* const plain : {"theta", "m1", "I1", "Ixx", "M", "omega", "Omega_0"})
        CHECK(names.fresh(plain) == plain);
    CHECK(label_of(names.fresh("EI")) == "EI");
    CHECK(label_of("register_") == "register_");
}

TEST_CASE("emit: no name of a scene is that of an argument of an emitted function") {
    const Scene scene = read_scene(test::source_path("scenes/textbook/cartesian_pendulum.toml"));
    const Derived derived = alembert::derived(scene, {.use = Use::run});
    const Program plain = lowered(derived).program;
    const auto derivatives = differentiated(plain, {.parameters = true, .power = true});
    REQUIRE(derivatives);
    const std::regex function(R"(void \w+\(([^()]*)\))"), argument(R"((\w+)(?=,|$))");
    std::set<std::string> found;
    for (const Program& program : {derivatives->program, with_tangent(plain)})
        for (const CodeLanguage language : {CodeLanguage::cpp, CodeLanguage::c}) {
            const std::string text = emit(program, {.language = language}).text;
            for (std::sregex_iterator f(text.begin(), text.end(), function), end; f != end; ++f) {
                const std::string arguments = (*f)[1];
                for (std::sregex_iterator a(arguments.begin(), arguments.end(), argument); a != end; ++a)
                    found.insert((*a)[1]);
            }
        }
    for (const char* const name : {"state", "par", "values", "direction", "change"})
        CHECK_MESSAGE(found.contains(name), name);
    for (const std::string& name : found) CHECK_MESSAGE(Names().fresh(name) != name, name);
}

TEST_CASE("emit: parameters with the names of macros and keywords give the rates of parameters with plain names") {
    const std::string everything =
        "-include math.h -include errno.h -include assert.h -include stdio.h -include stdlib.h ";
    const std::vector<double> plain =
        rates_of_example(scene_of(spring_scene({"g", "m", "l", "c"}), "plain.toml"), CodeLanguage::c, "");
    for (const double rate : plain) CHECK(std::isfinite(rate));
    for (const std::vector<std::string>& names :
         std::vector<std::vector<std::string>>{{"NAN", "M_PI", "EOF", "INFINITY"},
                                               {"errno", "stdin", "I", "assert"},
                                               {"HUGE_VAL", "ALEMBERT_REAL", "RAND_MAX", "BUFSIZ"},
                                               {"register", "class", "restrict", "typeof"},
                                               {"M_PI_2", "NULL", "signbit", "linux"}}) {
        CAPTURE(names[0]);
        const Scene scene = scene_of(spring_scene(names), "named.toml");
        CHECK(rates_of_example(scene, CodeLanguage::c, everything + "-include complex.h -D_GNU_SOURCE") == plain);
        check_example(scene, CodeLanguage::cpp, everything);
    }
}

TEST_CASE("emit: no text of a scene leaves the comment in which it stands") {
    for (const char* const text : {"a */ int x; /* b", "*/*/ #error //*", "kg \\\\ ?\?/", "Ω·m²\u202e*/"}) {
        CAPTURE(text);
        const Scene scene = scene_of(spring_scene({"g", "m", "l", "c"}, text), "text.toml");
        check_example(scene, CodeLanguage::c, "-Wcomment -trigraphs");
        check_example(scene, CodeLanguage::cpp, "-Wcomment");
    }
    CHECK(comment_text("µm/°C") == "µm/°C");
    CHECK(comment_text("a\nb\\") == "a b");
    CHECK(comment_text("***/*") == "*** / *");
    CHECK(comment_text("\xff\xc3") == "");
}

TEST_CASE("emit: the example at the head of a file compiles as it stands and prints the rates that eval gives") {
    for (const char* const name :
         {"textbook/double_pendulum", "textbook/rolling_disc", "textbook/watt_governor",
          "textbook/heavy_top_joint", "textbook/sled", "gallery/rssr", "benchmark/trees/arm7"}) {
        CAPTURE(name);
        const Scene scene = read_scene(test::source_path(fmt::format("scenes/{}.toml", name)));
        check_example(scene, CodeLanguage::c);
        check_example(scene, CodeLanguage::cpp);
    }
    const char* const bare = R"toml([coordinates]
x = { initial = 1, rate = -2 }
[[particle]]
name = "P"
mass = 2
position = ["x", "0"]
[forces]
x = "-3*x"
)toml";
    check_example(scene_of(bare, "bare.toml"), CodeLanguage::c);
    check_example(scene_of(bare, "bare.toml"), CodeLanguage::cpp);
}

}  // namespace emit_heads
