// SPDX-License-Identifier: MIT
// A main program of `emit --standalone` ends where an event stops the motion, also where its function only touches
// zero or passes it twice within a step. Times are known in closed form.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <string>

#include "program.hpp"
#include "shell.hpp"

namespace commands_standalone_events {

using alembert::test::run;
using alembert::test::run_shell;
using alembert::test::temporary;
using alembert::test::temporary_folder;

namespace {

/// The time at which the program ends, by the first number of its last row. x = t, or x = cos(t) with a spring.
double end_of(const std::string& when, const std::string& more, bool swings, const std::string& language) {
    const std::string scene = temporary(
        "stops.toml",
        fmt::format("[parameters]\nw = 1e-5\n[coordinates]\nx = {{ initial = {}, rate = {} }}\n[[particle]]\n"
                    "name = \"b\"\nmass = 1\nposition = [\"x\", 0]\n{}[[event]]\nname = \"a\"\nwhen = \"{}\"\n"
                    "stop = true\n{}[simulation]\nduration = 3\n",
                    swings ? 1 : 0, swings ? 0 : 1, swings ? "[[spring]]\nalong = \"x\"\nstiffness = 1\n" : "",
                    when, more));
    const std::string folder = temporary_folder("stops-" + language);
    const auto emitted = run({"emit", scene, "-o", folder, "--language", language, "--standalone"});
    REQUIRE_MESSAGE(emitted.exit == 0, emitted.err);
    const std::string compiled = language == "c"
                                     ? "cc -std=c99 -pedantic -Wall -Wextra -Werror -O1 stops_main.c stops.c -lm"
                                     : "c++ -std=c++20 -Wall -Wextra -Werror -O1 stops_main.cpp";
    const auto result = run_shell(fmt::format("cd {} && {} -o run && ./run | tail -n 1", folder, compiled));
    REQUIRE_MESSAGE(result.exit == 0, result.err);
    return std::strtod(result.out.c_str(), nullptr);
}

struct Stop {
    const char* when;
    double time;
    const char* more = "";
};

}  // namespace

TEST_CASE("emit: a main program ends where an event touches zero, or passes it twice within a step") {
    const double narrow = std::sqrt(std::log(2.0));
    for (const Stop& one :
         {Stop{"exp(-((x - 1)/1e-6)^2) - 0.5", 1 - 1e-6 * narrow}, Stop{"(x - 1)*(x - 1.0000001)", 1},
          Stop{"max(0, 1 - abs(x - 1)/1e-4) - 0.5", 1 - 0.5e-4}, Stop{"abs(x - 1) - w", 1 - 1e-5},
          Stop{"(x - 1)^2 - 1e-10", 1 - 1e-5}, Stop{"cos(x - 1) - 0.9999999999", 1 - std::acos(0.9999999999)},
          Stop{"sin(300*x) - 0.9999999", std::asin(0.9999999) / 300},
          Stop{"sqrt((x - 1)^2 + 1e-8) - 2e-4", 1 - std::sqrt(3.0) * 1e-4},
          Stop{"1/(1 + ((x - 1)/w)^2) - 0.5", 1 - 1e-5}, Stop{"abs(x - 1)", 1}, Stop{"(x - 1)^2", 1},
          Stop{"-(x - 1.01)^2", 1.01}, Stop{"abs(x - 1.02)", 1.02},  // at the end of a row
          Stop{"abs(x - 1)", 1, "direction = \"down\"\n"}, Stop{"1 - cos(x - 1)", 1}, Stop{"x - 1", 1}}) {
        CAPTURE(one.when);
        CHECK(std::abs(end_of(one.when, one.more, false, "c") - one.time) < 2e-8);
    }
    for (const Stop& one : {Stop{"(x - 0.3)^2", std::acos(0.3)}, Stop{"abs(x - 0.3) - w", std::acos(0.3 + 1e-5)},
                            Stop{"exp(-((x - 0.3)/w)^2) - 0.5", std::acos(0.3 + 1e-5 * narrow)}})
        for (const char* const language : {"c", "cpp"}) {
            CAPTURE(one.when);
            CHECK(std::abs(end_of(one.when, "", true, language) - one.time) < 1e-7);
        }
}

TEST_CASE("emit: a main program does not end where an event comes near zero, or touches it from the other side") {
    for (const Stop& one :
         {Stop{"(x - 1)^2 + 1e-9", 3}, Stop{"abs(x - 1) + 1e-7", 3}, Stop{"exp(-((x - 1)/1e-6)^2) - 1.001", 3},
          Stop{"x + 1", 3}, Stop{"abs(x - 1)", 3, "direction = \"up\"\n"},
          Stop{"-(x - 1)^2", 3, "direction = \"down\"\n"}}) {
        CAPTURE(one.when);
        CHECK(end_of(one.when, one.more, false, "c") == 3);
    }
}

// The mass 2 - t/2 of the rocket is used up at t = 4; the second particle keeps the equations regular there.
TEST_CASE("emit: a main program ends with status 4 where nothing is left of a mass") {
    const auto scene = [](const char* rate) {
        return temporary("burnt.toml", fmt::format(R"toml([coordinates]
h = {{ initial = 0, rate = 1 }}
[states]
m = {{ rate = "{}", initial = 2 }}
[[particle]]
name = "rocket"
mass = "m"
position = [0, "h"]
leaves = [0, "-m"]
[[particle]]
name = "load"
mass = 3
position = [0, "h"]
[simulation]
duration = 5
)toml",
                                                   rate));
    };
    for (const std::string language : {"c", "cpp"}) {
        const std::string compiler = language == "c" ? "cc -std=c99 -pedantic -Wall -Wextra -Werror -O1"
                                                     : "c++ -std=c++20 -Wall -Wextra -Werror -O1";
        const auto ended = [&](const char* rate) {
            const std::string folder = temporary_folder("burnt-" + language);
            const auto emitted = run({"emit", scene(rate), "-o", folder, "--language", language, "--standalone"});
            REQUIRE_MESSAGE(emitted.exit == 0, emitted.err);
            return run_shell(fmt::format("cd {0} && {1} burnt_main.{2} {3} -lm -o run && ./run", folder, compiler,
                                         language, language == "c" ? "burnt.c" : ""));
        };
        CAPTURE(language);
        const auto burnt = ended("-0.5"), kept = ended("-0.25");
        CHECK(burnt.exit == 4);
        CHECK_MESSAGE(burnt.err.find("at t = 4 nothing is left of the mass of 'rocket'") != std::string::npos,
                      burnt.err);
        CHECK(kept.exit == 0);
    }
}

}  // namespace commands_standalone_events
