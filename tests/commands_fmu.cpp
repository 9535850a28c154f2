// SPDX-License-Identifier: MIT
// Functional mock-up units, held by a master of our own (fmu_master.hpp): the archive is read, its description is
// held against the rules of FMI (unit_description.hpp), the binary is loaded, and its motions, by model exchange
// and by co-simulation, are compared with those of `simulate`.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "files.hpp"
#include "fmu_exports.hpp"
#include "json.hpp"
#include "shell.hpp"

namespace commands_fmu {

using namespace alembert::test;

namespace {

const Unit& cart(int version) {
    static const Unit two = exported(source_path("scenes/textbook/cart_pole.toml"), 2, Compiled::as_shipped),
                      three = exported(source_path("scenes/textbook/cart_pole.toml"), 3, Compiled::as_shipped);
    return version == 2 ? two : three;
}

}  // namespace

TEST_CASE("fmu: a unit of either version obeys the rules of its description and moves as simulate does") {
    const std::string scene = source_path("scenes/textbook/cart_pole.toml");
    const Json final = simulated(scene, 2);
    for (const int version : {2, 3}) {
        CAPTURE(version);
        const Unit& unit = cart(version);
        check_rules(unit.files.at("modelDescription.xml"), version);
        CHECK(unit.files.contains("sources/cart_pole.c"));
        CHECK(unit.files.contains("sources/buildDescription.xml") == (version == 3));
        CHECK(unit.description.at("F", "causality") == "input");
        CHECK(unit.description.at("der(theta)", "unit") == "rad/s");
        CHECK(unit.description.at("height", "unit") == "m");
        CHECK(unit.description.at("power", "unit") == "kg*m^2/s^3");
        CHECK(unit.description.model.at("fmiVersion") == (version == 2 ? "2.0" : "3.0"));
        for (const auto& [name, bytes] : unit.files)
            CHECK_MESSAGE(bytes.find(std::filesystem::temp_directory_path().string() + "/") == std::string::npos,
                          name);

        Instance exchanged(unit, false);
        exchanged.begin();
        exchange(exchanged, 2, 4000);
        CHECK(difference(exchanged, final) < 1e-9);

        // Two instances at once; the second is saved in the middle and goes on from there after a detour.
        Instance one(unit, true, 1e-12), other(unit, true, 1e-12);
        one.begin();
        other.set("F", 0);
        other.begin();
        for (int k = 0; k < 20; ++k) {
            CHECK(one.step(0.1 * k, 0.1));
            CHECK(other.step(0.1 * k, 0.1));
        }
        CHECK(difference(one, final) < 1e-9);
        CHECK(difference(other, final) > 1e-3);
        CHECK(one.get("energy.total") ==
              doctest::Approx(one.get("energy.kinetic") + one.get("energy.potential")).epsilon(1e-14));
        CHECK(one.get("height") == doctest::Approx(0.5 * std::cos(one.get("theta"))).epsilon(1e-14));
        CHECK(one.get("F") == doctest::Approx(2 * std::cos(8.0)).epsilon(1e-14));
        CHECK(one.get("event.pole_level") == doctest::Approx(std::cos(one.get("theta"))).epsilon(1e-14));
    }
}

TEST_CASE("fmu: a state is saved, written as bytes and restored, and the motion repeats bit for bit") {
    const Unit& unit = cart(2);
    Instance one(unit, true), other(unit, true);
    one.begin();
    other.begin();
    one.step(0, 0.7);
    void* saved = nullptr;
    one.ok("fmi2GetFMUstate", &saved);
    std::size_t size = 0;
    one.ok("fmi2SerializedFMUstateSize", saved, &size);
    std::string bytes(size, '\0');
    one.ok("fmi2SerializeFMUstate", saved, bytes.data(), size);
    one.step(0.7, 0.4);
    const double there = one.get("theta");
    one.ok("fmi2SetFMUstate", saved);
    one.set("F", 3);
    one.step(0.7, 0.4);
    CHECK(one.get("theta") != there);
    one.ok("fmi2SetFMUstate", saved);
    one.step(0.7, 0.4);
    CHECK(one.get("theta") == there);
    one.ok("fmi2FreeFMUstate", &saved);
    CHECK(saved == nullptr);

    void* read = nullptr;
    other.ok("fmi2DeSerializeFMUstate", static_cast<const char*>(bytes.data()), size, &read);
    other.ok("fmi2SetFMUstate", read);
    other.ok("fmi2FreeFMUstate", &read);
    other.step(0.7, 0.4);
    CHECK(other.get("theta") == there);
    other.ok("fmi2Reset");
    CHECK(other.get("theta") == 0.15);

    // Another token is refused.
    const void* callbacks[5] = {};
    CHECK(unit.call<void*>("fmi2Instantiate", "one", 0, "{other}", static_cast<const char*>(nullptr),
                           static_cast<const void*>(callbacks), 0, 0) == nullptr);
}

TEST_CASE("fmu: directional derivatives agree with differences, by states, inputs and parameters") {
    const Unit& unit = cart(3);
    Instance one(unit, false);
    one.begin();
    one.set("theta", 0.4);
    one.set("der(theta)", -0.3);
    one.set("F", 1.7);
    for (const std::string of :
         {"der(x,2)", "der(theta,2)", "energy.total", "energy.power", "height", "power", "x"})
        for (const std::string by : {"x", "theta", "der(x)", "der(theta)", "F", "m", "l"}) {
            CAPTURE(of);
            CAPTURE(by);
            const double exact = one.derivative(of, by), here = one.get(by), h = 1e-5;
            one.set(by, here + h);
            const double above = one.get(of);
            one.set(by, here - h);
            const double below = one.get(of);
            one.set(by, here);
            // The difference is off by h² times a third derivative, and by rounding over h.
            CHECK(exact == doctest::Approx((above - below) / (2 * h)).epsilon(1e-6));
        }
}

TEST_CASE("fmu: inputs and the rates that the equations need can be set, and given functions come back") {
    const std::string scene = temporary("support.toml", R"toml(
gravity = [0, "-g"]
[parameters]
g = 9.81
a = 0.1
[inputs]
s = { value = "a*sin(5*t)", unit = "m" }
[coordinates]
phi = { initial = 0.5, unit = "rad" }
[[particle]]
name = "bob"
mass = 2
position = ["s + sin(phi)", "-cos(phi)"]
[outputs]
speed = "dot(vel(bob), vel(bob))"
)toml");
    const Json final = simulated(scene, 1);
    const Unit unit = exported(scene, 2, Compiled::as_shipped);
    // The equation has s'', the energy s'; each input is set to what the scene has.
    Instance given(unit, false);
    given.begin();
    exchange(given, 1, 1000, [&](double t) {
        given.set("s", 0.1 * std::sin(5 * t));
        given.set("der(s)", 0.5 * std::cos(5 * t));
        given.set("der(s,2)", -2.5 * std::sin(5 * t));
    });
    CHECK(difference(given, final) < 1e-9);
    CHECK(given.get("der(s)") == doctest::Approx(0.5 * std::cos(5.0)).epsilon(1e-14));

    // The scene's own function, with its amplitude tuned.
    Instance tuned(unit, true, 1e-12);
    tuned.set("a", 0);
    tuned.begin();
    tuned.step(0, 1);
    CHECK(tuned.get("s") == 0);
    CHECK(difference(tuned, final) > 1e-3);

    // In co-simulation an input follows the derivatives that it is given: s = t²/2 needs one step only.
    Instance followed(unit, true, 1e-12), wanted(unit, false);
    const unsigned s = unit.description.reference.at("s");
    followed.set("s", 0);
    const int order = 2, *const orders = &order;
    const double second = 1, *const values = &second;
    followed.ok("fmi2SetRealInputDerivatives", &s, std::size_t{1}, orders, values);
    followed.begin();
    followed.step(0, 1);
    wanted.begin();
    exchange(wanted, 1, 1000, [&](double t) {
        wanted.set("s", t * t / 2);
        wanted.set("der(s)", t);
        wanted.set("der(s,2)", 1);
    });
    CHECK(followed.get("phi") == doctest::Approx(wanted.get("phi")).epsilon(1e-9));
    CHECK(followed.get("s") == doctest::Approx(0.5).epsilon(1e-14));
}

TEST_CASE("fmu: constraints stay satisfied, and the same scene gives the same bytes") {
    const std::string scene = source_path("scenes/textbook/slider_crank.toml"), again = file_name("again.fmu");
    const Json final = simulated(scene, 1);
    const Unit unit = exported(scene, 2, Compiled::as_shipped);
    check_rules(unit.files.at("modelDescription.xml"), 2);
    Instance one(unit, true, 1e-12), exchanged(unit, false, 1e-12);
    one.begin();
    one.step(0, 1);
    CHECK(difference(one, final) < 1e-9);
    exchanged.begin();
    exchange(exchanged, 1, 4000);
    CHECK(difference(exchanged, final) < 1e-9);
    CHECK(one.get("x") ==
          doctest::Approx(0.15 * std::cos(one.get("alpha")) + 0.4 * std::cos(one.get("beta"))).epsilon(1e-12));
    // A longer rod: the start values do not fit, and are brought to the constraints.
    Instance longer(unit, true, 1e-12);
    longer.set("l", 0.45);
    longer.begin();
    CHECK(longer.get("x") ==
          doctest::Approx(0.15 * std::cos(longer.get("alpha")) + 0.45 * std::cos(longer.get("beta")))
              .epsilon(1e-14));
    REQUIRE(run({"fmu", scene, "-o", again}).exit == 0);
    CHECK(contents(again) == unit.archive);
}

// A pendulum with two bobs: the length of the second follows from that of the first, with l2 = 2 l1 alone, and for
// every mass and gravity.
TEST_CASE("fmu: parameters with which a constraint that was left out holds keep their values") {
    const std::string rod = temporary("tied.toml", R"toml(
gravity = [0, "-g"]
[parameters]
g = 9.81
m = 1
l1 = 1
l2 = 2
[coordinates]
x1 = { guess = 0.6, rate_guess = 0 }
y1 = { guess = -0.8, rate_guess = 0 }
x2 = { guess = 1.2, rate_guess = 0 }
y2 = { guess = -1.6, rate_guess = 0 }
[[particle]]
name = "A"
mass = "m"
position = ["x1", "y1"]
[[particle]]
name = "B"
mass = "m"
position = ["x2", "y2"]
[[constraint]]
name = "a"
holonomic = "x1^2 + y1^2 = l1^2"
[[constraint]]
name = "b"
holonomic = "x2 = 2*x1"
[[constraint]]
name = "c"
holonomic = "y2 = 2*y1"
[[constraint]]
name = "d"
holonomic = "x2^2 + y2^2 = l2^2"
[simulation]
duration = 1
)toml");
    for (const int version : {2, 3}) {
        const Unit unit = exported(rod, version, Compiled::as_shipped);
        check_rules(unit.files.at("modelDescription.xml"), version);
        Instance one(unit, true, 1e-12);
        for (const char* const tied : {"l1", "l2"}) {
            CHECK(unit.description.at(tied, "variability") == "fixed");
            CHECK(one.status_of_set(tied, 1.5) == failed);
            CHECK(one.status_of_set(tied, one.get(tied)) == 0);
        }
        for (const char* const free : {"g", "m"}) {
            CHECK(unit.description.at(free, "variability") == "tunable");
            CHECK(one.status_of_set(free, 1.5) == 0);
        }
    }
    const auto all = json_of({"fmu", rod, "-o", file_name("rod.fmu")});
    CHECK(all["fixed_parameters"] == Json{"l1", "l2"});
    CHECK(all["parameters"] == Json{"g", "m"});
}

TEST_CASE("fmu: events with impulses, events that end the run, and kinks are followed") {
    const std::string scene = temporary("court.toml", R"toml(
gravity = [0, "-g"]
[parameters]
g = 9.81
m = 0.5
k = 40
[coordinates]
x = 0.2
y = { initial = 1, rate = 0.3 }
[[particle]]
name = "ball"
mass = "m"
position = ["x", "y"]
[forces]
x = "-k*x - 0.7*sign(x)"
[[event]]
name = "floor"
when = "y"
direction = "down"
impulses = { y = "-1.8*m*y'" }
[[event]]
name = "out"
when = "t - 1.75"
stop = true
)toml");
    const Json final = simulated(scene, 3);
    CHECK(final["time"] == doctest::Approx(1.75).epsilon(1e-12));
    const Unit unit = exported(scene, 2, Compiled::as_shipped);
    Instance one(unit, true, 1e-12);
    one.begin();
    bool goes_on = true;
    for (int k = 0; k < 30 && goes_on; ++k) goes_on = one.step(0.1 * k, 0.1);
    CHECK(!goes_on);
    CHECK(one.get("time") == doctest::Approx(1.75).epsilon(1e-12));
    CHECK(difference(one, final) < 1e-9);
    Instance exchanged(unit, false);
    exchanged.begin();
    CHECK(exchange(exchanged, 3, 6000));
    CHECK(exchanged.get("time") == doctest::Approx(1.75).epsilon(1e-12));
    CHECK(difference(exchanged, final) < 1e-9);
}

TEST_CASE("fmu: rates that are no numbers are a failure, not a motion") {
    const std::string scene = temporary("root.toml", R"toml(
[parameters]
m = 1
[coordinates]
x = { initial = 1, rate = -1, unit = "m" }
[[particle]]
name = "P"
mass = "m"
position = ["x", 0]
[forces]
x = "-sqrt(x)"
)toml");
    for (const int version : {2, 3}) {
        CAPTURE(version);
        const Unit unit = exported(scene, version, Compiled::as_shipped);
        Instance exchanged(unit, false), one(unit, true);
        exchanged.begin();
        exchanged.update();
        exchanged.at(0, {-1, 0});  // the root of a negative number
        Numbers rates(2);
        const auto rate_of = [&](Instance& instance) {
            return instance.status(version == 2 ? "fmi2GetDerivatives" : "fmi3GetContinuousStateDerivatives",
                                   rates.data(), rates.size());
        };
        CHECK(rate_of(exchanged) == discarded);
        exchanged.at(0, {4, 0});  // a master may go back and take a shorter step
        CHECK(rate_of(exchanged) == 0);
        CHECK(rates == Numbers{0, -2});
        // It reaches x = 0 at some time before 2 s, and no step leads beyond.
        one.begin();
        CHECK(one.step_status(0, 2) >= discarded);
    }
}

TEST_CASE("fmu: what a unit cannot follow is refused, with what to do") {
    const auto refused = [](const char* scene, const char* words) {
        const auto result = run({"fmu", source_path(scene), "-o", file_name("none.fmu")});
        CHECK(result.exit == 3);
        CHECK_MESSAGE(result.err.find(words) != std::string::npos, result.err);
    };
    refused("scenes/friction/block_on_slope.toml", "[[friction]]");
    const auto named = run({"fmu", source_path("scenes/textbook/slider_crank.toml"), "-o", file_name("unit.zip")});
    CHECK(named.exit == 3);
    CHECK(named.err.find("call it NAME.fmu") != std::string::npos);
}

TEST_CASE("fmu: a unit says in which units the scene gives its variables") {
    const std::string scene = temporary("own_units.toml", R"toml(
[parameters]
k = { value = 0.4, unit = "N/mm" }
[coordinates]
x = { initial = 30, rate = -100, unit = "mm" }
phi = { initial = 30, unit = "deg" }
[[particle]]
name = "cart"
mass = 2
position = ["x", 0]
[energy]
kinetic = "0.1*phi'^2"
[[spring]]
along = "x"
stiffness = "k"
)toml");
    for (const int version : {2, 3}) {
        const Unit unit = exported(scene, version, Compiled::as_shipped);
        CHECK(unit.description.at("phi", "unit") == "rad");
        CHECK(unit.description.at("phi", "displayUnit") == "deg");
        CHECK(unit.description.at("der(x)", "displayUnit") == "mm/s");
        CHECK(unit.description.at("k", "displayUnit") == "N/mm");
        const std::string& text = unit.files.at("modelDescription.xml");
        CHECK(text.find("<DisplayUnit name=\"mm\" factor=\"1000\"/>") != std::string::npos);
        check_rules(text, version);
    }
}

}  // namespace commands_fmu
