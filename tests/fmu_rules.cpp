// SPDX-License-Identifier: MIT
// What FMI demands of a unit whose importer errs: an error with a message, and no motion. Derivatives by inputs,
// and start values that constraints tie together.
#include <doctest/doctest.h>

#include "fmu_exports.hpp"

namespace fmu_rules {

using namespace alembert::test;

namespace {

std::string pendulum_on_cart() {
    return temporary("support.toml", R"toml(
gravity = [0, "-g"]
[parameters]
g = 9.81
a = 0.1
[inputs]
s = { value = "a*sin(5*t)", unit = "m" }
F = { value = "2*cos(3*t)", unit = "N" }
[coordinates]
phi = { initial = 0.5, unit = "rad" }
[[particle]]
name = "bob"
mass = 2
position = ["s + sin(phi)", "-cos(phi)"]
[forces]
phi = "F*sin(phi)"
[outputs]
side = "s + sin(phi)"
)toml");
}

/// Enters and leaves the initialization; the status of leaving it.
int begun(Instance& one, int version) {
    if (version == 2)
        one.ok("fmi2EnterInitializationMode");
    else
        one.ok("fmi3EnterInitializationMode", false, 0.0, 0.0, false, 0.0);
    return one.status(one.prefix() + "ExitInitializationMode");
}

void remember(void* environment, int, const char*, const char* message) {
    static_cast<std::vector<std::string>*>(environment)->emplace_back(message);
}

}  // namespace

TEST_CASE("fmu: a derivative by an input that was never set is the one that a difference of set inputs gives") {
    const std::string scene = pendulum_on_cart();
    for (const int version : {2, 3}) {
        const Unit unit = exported(scene, version);
        for (const std::string of : {"der(phi,2)", "energy.total", "side"})
            for (const std::string by : {"F", "s", "der(s)", "der(s,2)"}) {
                CAPTURE(of);
                CAPTURE(by);
                Instance one(unit, false), other(unit, false);
                one.begin();
                other.begin();
                const double exact = one.derivative(of, by), h = 1e-5;
                std::map<std::string, double> now;
                for (const char* const input : {"F", "s", "der(s)", "der(s,2)"}) now[input] = other.get(input);
                for (const char* const input : {"F", "s", "der(s)", "der(s,2)"}) other.set(input, now[input]);
                const double here = now[by];
                other.set(by, here + h);
                const double above = other.get(of);
                other.set(by, here - h);
                const double below = other.get(of);
                CHECK(exact == doctest::Approx((above - below) / (2 * h)).epsilon(1e-6));
                // The input still is the scene's function of time.
                one.update();
                one.at(0.3, one.state());
                CHECK(one.get("F") == doctest::Approx(2 * std::cos(0.9)).epsilon(1e-14));
            }
    }
}

TEST_CASE("fmu: start values that an importer sets stay, and others follow the constraints, or it is an error") {
    const std::string scene = source_path("scenes/textbook/slider_crank.toml");
    for (const int version : {2, 3})
        for (const bool steps : {true, false}) {
            const Unit unit = exported(scene, version);
            Instance one(unit, steps), both(unit, steps), impossible(unit, steps), as_given(unit, steps);
            const double alpha = one.get("alpha") + 0.2;
            one.set("alpha", alpha);
            CHECK(begun(one, version) == 0);
            CHECK(one.get("alpha") == doctest::Approx(alpha).epsilon(1e-11));
            CHECK(0.15 * std::sin(alpha) == doctest::Approx(0.4 * std::sin(one.get("beta"))).epsilon(1e-10));
            CHECK(one.get("x") ==
                  doctest::Approx(0.15 * std::cos(alpha) + 0.4 * std::cos(one.get("beta"))).epsilon(1e-10));
            both.set("alpha", alpha);
            both.set("x", both.get("x") + 0.05);
            CHECK(begun(both, version) == failed);
            impossible.set("x", 5);
            CHECK(begun(impossible, version) == failed);
            for (const char* const name : {"alpha", "beta", "x"}) as_given.set(name, as_given.get(name));
            CHECK(begun(as_given, version) == 0);
        }
}

TEST_CASE("fmu: scenes may be called as what the sources of units declare") {
    const std::string body = R"toml([coordinates]
x = 1
y = { guess = 2 }
[[particle]]
name = "p"
mass = 1
position = ["x", "y"]
[[constraint]]
name = "line"
holonomic = "y - 2*x"
[[event]]
name = "wall"
when = "x - 5"
impulses = { x = "-1" }
)toml";
    for (const char* const name :
         {"first", "is", "in", "along", "measure", "scene", "given", "held", "step", "unit"})
        for (const int version : {2, 3}) {
            CAPTURE(name);
            const Unit unit = exported(temporary(fmt::format("{}.toml", name), body), version);
            Instance one(unit, true);
            CHECK(begun(one, version) == 0);
        }
}

TEST_CASE("fmu: at the start guesses move and what is given stays, as in eval") {
    // The joint at the wrist closes a loop; of the coordinates b and x are guesses.
    const std::string scene = temporary("crank.toml", R"toml(
[parameters]
r = 0.04
l = 0.15
a = 0.05
[[body]]
name = "crank"
mass = 0.6
inertia = 8e-4
[[body]]
name = "rod"
mass = 0.5
inertia = 1.5e-3
[[body]]
name = "piston"
mass = 0.4
[[joint]]
name = "main"
type = "revolute"
parent = "N"
child = "crank"
coordinates = { q = { initial = 30, unit = "deg", rate = 9000 } }
[[joint]]
name = "crankpin"
type = "revolute"
parent = "crank"
child = "rod"
parent_point = ["r", 0]
child_point = ["-a", 0]
coordinates = { b = { guess = -38, rate_guess = 0, unit = "deg" } }
[[joint]]
name = "guide"
type = "prismatic"
parent = "N"
child = "piston"
axis = "x"
coordinates = { x = { guess = "0.18", rate_guess = 0 } }
[[joint]]
name = "wrist"
type = "revolute"
parent = "rod"
child = "piston"
parent_point = ["l-a", 0]
)toml");
    using Values = std::vector<std::pair<std::string, double>>;
    const std::vector<Values> starts = {
        {{"q", 2}}, {{"l", 0.16}}, {{"q", -2.5}, {"l", 0.2}}, {{"q", 1}, {"der(q)", 3}}, {}};
    for (const int version : {2, 3}) {
        const Unit unit = exported(scene, version);
        for (const Values& values : starts) {
            Instance one(unit, true);
            std::vector<std::string> words{"eval", scene};
            for (const auto& [name, value] : values) {
                one.set(name, value);
                const std::string unit_of = name == "q" ? " rad" : name == "l" ? "" : " rad/s";
                if (words.size() == 2) words.emplace_back("--at");
                words.push_back(fmt::format("{}={:.17g}{}", name == "der(q)" ? "q'" : name, value, unit_of));
            }
            CHECK(begun(one, version) == 0);
            const Json expected = json_of(words);
            for (const char* const name : {"q", "b", "x"}) {
                CAPTURE(name);
                const double value = expected["coordinates"][name], rate = expected["rates"][name];
                CHECK(std::abs(one.get(name) - value) <= 1e-11 * std::max(1.0, std::abs(value)));
                CHECK(std::abs(one.get(fmt::format("der({})", name)) - rate) <=
                      1e-10 * std::max(1.0, std::abs(rate)));
            }
        }
    }
}

TEST_CASE("fmu: calls out of order, what is no number, steps backwards and states of other units are errors") {
    const std::string scene = pendulum_on_cart();
    for (const int version : {2, 3}) {
        CAPTURE(version);
        const Unit unit = exported(scene, version),
                   other = exported(source_path("scenes/textbook/cart_pole.toml"), version);
        Instance one(unit, true), exchanged(unit, false), foreign(other, true);
        const std::string prefix = one.prefix(), saved_name = version == 2 ? "FMUstate" : "FMUState";
        Numbers x(2);
        CHECK(one.step_status(0, 0.1) == failed);  // before the start
        CHECK(one.status(prefix + "ExitInitializationMode") == failed);
        CHECK(one.status_of_set("phi", NAN) == failed);
        CHECK(one.status_of_set("g", INFINITY) == failed);
        one.begin();
        foreign.begin();
        CHECK(one.status(prefix + "ExitInitializationMode") == failed);
        CHECK(one.status(prefix + "EnterEventMode") == failed);
        CHECK(one.status(prefix + "SetTime", 0.5) == failed);
        CHECK(one.status(prefix + "SetContinuousStates", x.data(), x.size()) == failed);
        CHECK(one.status_of_set("phi", 0.7) == failed);
        for (const auto& [from, length] : {std::array{0.0, -0.1},
                                           {0.0, 0.0},
                                           {0.0, double(NAN)},
                                           {double(NAN), 0.1},
                                           {3.0, 0.1},
                                           {0.0, double(INFINITY)}})
            CHECK(one.step_status(from, length) == failed);
        CHECK(one.get("phi") == 0.5);
        CHECK(one.step_status(0, 0.1) == 0);
        CHECK(one.step_status(0, 0.1) == failed);  // it is at 0.1
        CHECK(one.step_status(0.1, 0.1) == 0);
        const double there = one.get("phi");

        void *mine = nullptr, *theirs = nullptr;
        one.ok(prefix + "Get" + saved_name, &mine);
        foreign.ok(prefix + "Get" + saved_name, &theirs);
        CHECK(one.status(prefix + "Set" + saved_name, theirs) == failed);
        CHECK(exchanged.status(prefix + "Set" + saved_name, mine) == failed);  // of an instance for co-simulation
        CHECK(one.status(prefix + "Set" + saved_name, static_cast<void*>(nullptr)) == failed);
        CHECK(one.status(prefix + "Set" + saved_name, mine) == 0);
        CHECK(one.get("phi") == there);
        one.ok(prefix + "Free" + saved_name, &mine);
        foreign.ok(prefix + "Free" + saved_name, &theirs);
        one.ok(prefix + "Terminate");
        CHECK(one.step_status(0.2, 0.1) == failed);
        CHECK(one.status_of_set("g", 9.8) == failed);
        one.ok(prefix + "Reset");
        one.begin();
        CHECK(one.step_status(0, 0.2) == 0);
        CHECK(one.get("phi") == doctest::Approx(there).epsilon(1e-7));

        CHECK(exchanged.status(prefix + "SetContinuousStates", x.data(), x.size()) == failed);
        exchanged.begin();
        CHECK(exchanged.step_status(0, 0.1) == failed);
        CHECK(exchanged.status(prefix + "SetContinuousStates", x.data(), x.size()) == failed);  // in event mode
        exchanged.update();
        CHECK(exchanged.status(prefix + "SetTime", double(NAN)) == failed);
        x[0] = NAN;
        CHECK(exchanged.status(prefix + "SetContinuousStates", x.data(), x.size()) == failed);
        CHECK(unit.call("fmi" + std::to_string(version) + "Reset", static_cast<void*>(nullptr)) == failed);
    }
}

TEST_CASE("fmu: each error has a message that says what is wrong") {
    const Unit unit = exported(pendulum_on_cart(), 3);
    std::vector<std::string> messages;
    const char *name = "one", *token = unit.token.c_str(), *nowhere = nullptr;
    void* const one = unit.call<void*>("fmi3InstantiateCoSimulation", name, token, nowhere, false, true, false,
                                       false, static_cast<const unsigned*>(nullptr), std::size_t{0},
                                       static_cast<void*>(&messages), &remember, static_cast<void*>(nullptr));
    REQUIRE((one != nullptr));
    bool event = false, over = false, early = false;
    double last = 0;
    const auto step = [&](double from, double length) {
        return unit.call("fmi3DoStep", one, from, length, true, &event, &over, &early, &last);
    };
    CHECK(step(0, 0.1) == failed);
    CHECK(unit.call("fmi3EnterInitializationMode", one, false, 0.0, 0.0, false, 0.0) == 0);
    CHECK(unit.call("fmi3ExitInitializationMode", one) == 0);
    CHECK(step(0, -1) == failed);
    CHECK(step(2, 1) == failed);
    REQUIRE(messages.size() == 3);
    CHECK(messages[0].find("out of order") != std::string::npos);
    CHECK(messages[1] == "step=-1: expected a number above zero");
    CHECK(messages[2].find("where the last one has ended") != std::string::npos);
    unit.call<void>("fmi3FreeInstance", one);
}

}  // namespace fmu_rules
