// SPDX-License-Identifier: MIT
// Numbers that no option, initial value or count can be, handed to the C++ library, to Python, to an emitted
// program in C and to a functional mock-up unit: the same message by each.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <functional>
#include <tuple>

#include "alembert/ode/integrate.hpp"
#include "by_python.hpp"
#include "fmu_master.hpp"
#include "simulate/bench.hpp"
#include "simulate/evaluate.hpp"
#include "simulate/fmu/unit.hpp"
#include "simulate/simulate.hpp"
#include "simulate/sweep.hpp"
#include "stability/equilibrium/equilibria.hpp"
#include "stability/exponents.hpp"
#include "stability/linear/about.hpp"
#include "stability/stability.hpp"

namespace generator_wrong_numbers {

using namespace alembert;
using namespace alembert::test;

namespace {

const char* const pendulum = R"toml(
gravity = [0, "-g"]
[parameters]
l = 0.5
g = 9.81
[coordinates]
theta = 0.1
[[particle]]
name = "bob"
mass = 1
position = ["l*sin(theta)", "-l*cos(theta)"]
)toml";

std::string message_of(const std::function<void()>& function) {
    try {
        function();
    } catch (const std::exception& e) {
        return e.what();
    }
    return "nothing was wrong";
}

/// Messages of a unit, which come through its logger.
std::vector<std::string> told_by_unit;
void log_of_2(void*, const char*, int, const char*, const char* form, ...) {
    std::va_list values;
    va_start(values, form);
    char line[400];
    std::vsnprintf(line, sizeof line, form, values);
    va_end(values);
    told_by_unit.emplace_back(line);
}
void log_of_3(void*, int, const char*, const char* line) {
    told_by_unit.emplace_back(line);
}

/// A unit for co-simulation that is called with a wrong number; gives the one message.
class CalledUnit {
public:
    explicit CalledUnit(int version)
        : version_(version),
          exported_(functional_unit(read_scene(temporary("pendulum.toml", pendulum)), {.version = version})),
          unit_(exported_.archive, exported_.token, version) {}

    std::string message(const std::function<int(void* instance, const CalledUnit& unit)>& call,
                        bool has_begun) const {
        told_by_unit.clear();
        void* const one = made();
        if (has_begun) begin(one);
        CHECK(call(one, *this) == failed);
        unit_.call<void>(version_ == 2 ? "fmi2FreeInstance" : "fmi3FreeInstance", one);
        REQUIRE(told_by_unit.size() == 1);
        return told_by_unit[0];
    }
    int start(void* one, bool has_tolerance, double tolerance, bool has_stop, double stop) const {
        if (version_ == 2)
            return unit_.call("fmi2SetupExperiment", one, has_tolerance ? 1 : 0, tolerance, 0.0, has_stop ? 1 : 0,
                              stop);
        return unit_.call("fmi3EnterInitializationMode", one, has_tolerance, tolerance, 0.0, has_stop, stop);
    }
    int step(void* one, double length) const {
        if (version_ == 2) return unit_.call("fmi2DoStep", one, 0.0, length, 1);
        bool event = false, over = false, early = false;
        double last = 0;
        return unit_.call("fmi3DoStep", one, 0.0, length, true, &event, &over, &early, &last);
    }
    int set(void* one, const std::string& name, double value) const {
        const unsigned reference = unit_.description.reference.at(name);
        const double* const at = &value;
        if (version_ == 2) return unit_.call("fmi2SetReal", one, &reference, std::size_t{1}, at);
        return unit_.call("fmi3SetFloat64", one, &reference, std::size_t{1}, at, std::size_t{1});
    }

private:
    void* made() const {
        const char *name = "one", *token = unit_.token.c_str(), *nowhere = nullptr;
        if (version_ == 2)
            return unit_.call<void*>("fmi2Instantiate", name, 1, token, nowhere,
                                     static_cast<const void*>(callbacks_), 0, 0);
        return unit_.call<void*>("fmi3InstantiateCoSimulation", name, token, nowhere, false, false, false, false,
                                 static_cast<const unsigned*>(nullptr), std::size_t{0},
                                 static_cast<void*>(nullptr), &log_of_3, static_cast<void*>(nullptr));
    }
    void begin(void* one) const {
        const std::string prefix = version_ == 2 ? "fmi2" : "fmi3";
        CHECK(start(one, false, 0, false, 0) == 0);
        if (version_ == 2) CHECK(unit_.call("fmi2EnterInitializationMode", one) == 0);
        CHECK(unit_.call(prefix + "ExitInitializationMode", one) == 0);
    }

    int version_;
    FunctionalUnit exported_;
    Unit unit_;
    const void* callbacks_[5] = {reinterpret_cast<const void*>(&log_of_2)};
};

}  // namespace

TEST_CASE("wrong numbers: a wrong number gives the same message by C++, Python, a program in C and a unit") {
    const Scene scene = parse_scene(pendulum, "pendulum.toml");
    const std::string file = temporary("pendulum.toml", pendulum), folder = temporary_folder("program");
    REQUIRE(test::run({"emit", file, "-o", folder, "--language", "c", "--standalone"}).exit == 0);
    REQUIRE(run_shell("cd " + folder + " && cc -std=c99 pendulum_main.c pendulum.c -lm -o run").exit == 0);
    const auto by_program = [&](const std::string& words) {
        const auto told = run_shell("cd " + folder + " && ./run " + words);
        CHECK(told.exit == 3);
        return told.err.substr(0, told.err.find('\n'));
    };
    const CalledUnit second(2), third(3);
    std::string code, expected;
    const auto by_all = [&](const std::string& message, const std::vector<std::function<void()>>& library,
                            const std::vector<std::string>& python) {
        CAPTURE(message);
        for (const auto& call : library) CHECK(message_of(call) == message);
        for (const std::string& call : python) {
            code +=
                "try:\n    " + call + "\n    print('nothing was wrong')\nexcept Exception as e:\n    print(e)\n";
            expected += message + "\n";
        }
    };
    const auto by_units = [&](const std::string& message, bool has_begun,
                              const std::function<int(void*, const CalledUnit&)>& call) {
        CAPTURE(message);
        for (const CalledUnit* unit : {&second, &third}) CHECK(unit->message(call, has_begun) == message);
    };
    const Rhs decay = make_rhs(1, [](double, const double* y, double* rate) { rate[0] = -y[0]; });
    const Grid grid{{{"theta", 0, 1, 3}}};
    const double nan = std::nan("");
    code += "from math import inf, nan\nscene = alembert.Scene('" + file + "')\nsystem = scene.system()\n";

    for (const auto& [value, text, words] :
         {std::tuple{-1.0, "-1", "a number of zero or more"}, std::tuple{nan, "nan", "a finite number"},
          std::tuple{-nan, "-nan", "a finite number"}, std::tuple{HUGE_VAL, "inf", "a finite number"}}) {
        const double duration = value;
        const std::string shown = std::isnan(duration) ? "nan" : text,
                          message = fmt::format("duration={}: expected {}", shown, words);
        by_all(
            message,
            {[&] { simulate(scene, {.duration = duration}); }, [&] { sweep(scene, grid, {.duration = duration}); },
             [&] { bench(scene, {.wishes = {.duration = duration}}); },
             [&] { integrate(decay, {1}, {.duration = duration}); }},
            {fmt::format("scene.simulate({})", text), fmt::format("scene.sweep({{'theta': [0, 1]}}, {})", text),
             fmt::format("scene.bench({})", text)});
        CHECK(by_program(text) == message);
        by_units(message, false,
                 [&](void* one, const CalledUnit& unit) { return unit.start(one, false, 0, true, duration); });
    }
    for (const auto& [value, text, words] :
         {std::tuple{0.0, "0", "a number above zero"}, std::tuple{-1e-9, "-1e-09", "a number above zero"},
          std::tuple{nan, "nan", "a finite number"}}) {
        const double number = value;
        const std::string message = fmt::format("tolerance={}: expected {}", text, words);
        by_all(message,
               {[&] { simulate(scene, {.duration = 1, .tolerance = number}); },
                [&] { sweep(scene, grid, {.duration = 1, .tolerance = number}); },
                [&] { integrate(decay, {1}, {.duration = 1, .tolerance = number}); },
                [&] { lyapunov_exponents(scene, {.tolerance = number}); }},
               {fmt::format("scene.simulate(1, {})", text),
                fmt::format("scene.sweep({{'theta': [0, 1]}}, 1, {})", text)});
        CHECK(by_program(fmt::format("1 {}", text)) == message);
        by_units(message, false,
                 [&](void* one, const CalledUnit& unit) { return unit.start(one, true, number, false, 0); });
        const std::string step = fmt::format("step={}: expected {}", text, words);
        by_all(step, {[&] { simulate(scene, {.method = "rk4", .duration = 1, .step = number}); }},
               {fmt::format("scene.simulate(1, method='rk4', step={})", text)});
        by_units(step, true, [&](void* one, const CalledUnit& unit) { return unit.step(one, number); });
    }
    for (const char* const name : {"theta", "l"}) {
        const std::string message = fmt::format("{}=inf: expected a finite number", name);
        by_all(message,
               {[&] {
                    evaluate(scene, {.at = {{name, HUGE_VAL}}});
                },
                [&] {
                    sweep(scene, {{{name, 1, 1, 1}}, {HUGE_VAL}});
                },
                [&] {
                    sweep(scene, {{{name, 0, HUGE_VAL, 3}}});
                }},
               {fmt::format("scene.eval({{'{}': inf}})", name),
                fmt::format("scene.sweep({{'{}': [1, inf]}})", name)});
        by_units(message, false, [&](void* one, const CalledUnit& unit) { return unit.set(one, name, HUGE_VAL); });
    }
    by_all("l=nan: expected a finite number", {[&] {
               linearize(scene, {.at = {{"l", nan}}});
           }},
           {"system.set(l=nan)", "scene.stability({'l': nan})"});
    by_all("initial[0]=nan: expected a finite number", {[&] { integrate(decay, {nan}, {.duration = 1}); }}, {});
    by_all("budget=0: expected a number above zero", {[&] { simulate(scene, {.budget = 0}); }},
           {"scene.simulate(budget=0)"});
    by_all("threads=-1: expected a whole number of zero or more", {[&] { sweep(scene, grid, {}, -1); }},
           {"scene.sweep({'theta': [1]}, threads=-1)"});
    by_all("count of theta=0: expected a whole number above zero", {[&] {
               sweep(scene, {{{"l", 1, 2, 3}, {"theta", 0, 1, 0}}});
           }},
           {"scene.sweep({'l': [1], 'theta': []})"});
    by_all(message_of([&] { sweep(scene, {}); }), {[&] { sweep(scene, {}, {.duration = 1}); }},
           {"scene.sweep({})"});
    by_all("count=-1: expected a whole number of zero or more",
           {[&] { lyapunov_exponents(scene, {.count = -1}); }}, {"scene.exponents(-1)"});
    by_all("starts=-5: expected a whole number of zero or more", {[&] { equilibria(scene, {.starts = -5}); }},
           {"scene.equilibrium(starts=-5)"});
    by_all("period=-2: expected a number above zero", {[&] { stability(scene, {.period = -2}); }},
           {"scene.stability(period=-2)"});
    by_all("fmi=4: there are the versions 2 and 3", {[&] { functional_unit(scene, {.version = 4}); }},
           {"scene.fmu('none.fmu', fmi=4)"});
    if (const std::optional<std::string> printed = by_python(code)) CHECK(*printed == expected);
}

TEST_CASE("wrong numbers: what a grid cannot be is told and divides by nothing") {
    const Scene scene = parse_scene(pendulum, "pendulum.toml");
    const auto told = [&](const Grid& grid, const char* words) {
        const std::string message = message_of([&] { sweep(scene, grid, {.duration = 1}); });
        CAPTURE(message);
        CHECK(message.find(words) != std::string::npos);
    };
    told({}, "there is nothing to vary");
    told({{{"theta", 0, 1, 2}, {"theta", 0, 1, 2}}}, "'theta' is varied twice");
    told({{{"theta", 0, 1, 1'000'000'000}, {"l", 1, 2, 1'000'000'000}}}, "more than");
    told({{{"theta", 0, 1, 2}}, {0.1, 0.2, 0.3}}, "3 numbers are no 2 points of 1 values");
    told({{{"theta", 0, 1, 2}, {"l", 1, 2, 3}}, {0.1, 1, 0.2, 1}}, "expected as many of each");
    told({{{"nobody", 0, 1, 2}}}, "nobody");
}

}  // namespace generator_wrong_numbers
