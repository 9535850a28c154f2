// SPDX-License-Identifier: MIT
// scenes/elements and scenes/modes: actuators, frictions, tyres, muscles and switches as scenes to copy from, each
// compared with a closed form or with scipy 1.17 (DOP853, rtol 1e-13, from one kink or event to the next).
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <tuple>

#include "json.hpp"
#include "scenes.hpp"

namespace commands_elements {

using namespace alembert::test;

namespace {

Json of_scene(const std::string& name, const std::vector<std::string>& more = {}) {
    return simulated(source_path("scenes/" + name + ".toml"), more);
}

/// Each value of the end by its name: of a coordinate, a rate or a state.
void ends_at(const Json& motion, const std::map<std::string, double>& end, double allowed) {
    for (const auto& [name, wanted] : end) {
        INFO(name);
        const Json& final = motion["final"];
        const bool is_rate = name.back() == '\'';
        const std::string plain = is_rate ? name.substr(0, name.size() - 1) : name;
        const double found = is_rate                               ? final["rates"][plain].get<double>()
                             : final["coordinates"].contains(name) ? final["coordinates"][name].get<double>()
                                                                   : final["states"][name].get<double>();
        CHECK(std::abs(found - wanted) < allowed * std::max(1.0, std::abs(wanted)));
    }
}

/// What the k-th event of this name records.
double recorded(const Json& motion, const std::string& event, int k, const std::string& column) {
    for (const Json& one : motion["events"])
        if (one["name"] == event && k-- == 0) return one["record"][column].get<double>();
    FAIL("no event " << event);
    return 0;
}

}  // namespace

TEST_CASE("elements: scenes of actuators, frictions and tyres end where scipy ends") {
    struct Element {
        const char* scene;
        std::map<std::string, double> end;
    };
    for (const Element& one : {
             Element{
                 "elements/dc_motor",
                 {{"theta", 15.0157174196814931}, {"theta'", 8.13996578051879929}, {"i", 1.92799806878805937}}},
             Element{"elements/filter",
                     {{"x", 1.7867108170823478}, {"x'", 0.5737623378506995}, {"F", -3.174473747056783}}},
             Element{
                 "elements/pid_anti_windup",
                 {{"x", 2.0042166188708026}, {"x'", -0.006911644483526382}, {"integral", 0.03487382757609107}}},
             Element{"elements/lugre", {{"x", 1.302939653570581}, {"x'", 0.2526385302224263}, {"z", 0.001}}},
             Element{"elements/hydraulic_cylinder",
                     {{"x", 0.10802659330547552}, {"x'", 0.10830250221546785}, {"p", 2669105.003646262}}},
             Element{"elements/tyre_relaxation",
                     {{"x", 17.054024186478326},
                      {"x'", 26.53662343074146},
                      {"phi'", 84.75308908908133},
                      {"s", -0.04185516407752897}}},
             Element{"elements/hill_muscle",
                     {{"q", 1.0580831921406093}, {"q'", 0.3986194493718632}, {"l_m", 0.09358627010308988}}},
             Element{"elements/winch",
                     {{"theta", 0.24989201381464107}, {"theta'", 1.3774411793622736}, {"l", 1.6}}},
             Element{"elements/backlash", {{"phi_1", 1.1400674091494118}, {"phi_2'", -1.1464102341576408}}},
             Element{"elements/hunt_crossley", {{"y", 0.016684372824766727}, {"y'", -0.8730907000464637}}},
         }) {
        INFO(one.scene);
        ends_at(of_scene(one.scene), one.end, 1e-9);
    }
}

TEST_CASE("elements: claims of their equations are proved") {
    for (const char* const name : {"dc_motor", "winch"})
        for (const Json& claim :
             json_of({"check", source_path(fmt::format("scenes/elements/{}.toml", name))})["claims"])
            CHECK(claim["verdict"] == "proved");
}

// v = c ln(M0/M) − g t while it burns, then free flight.
TEST_CASE("elements: a rocket has Tsiolkovsky's speed when its fuel is gone") {
    const Json motion = of_scene("elements/rocket");
    const double burnt = 70.0 / 8, c = 2500, g = 9.81, speed = c * std::log(100.0 / 30) - g * burnt,
                 height = c / 8 * (30 * std::log(0.3) + 70) - g * burnt * burnt / 2, rest = 20 - burnt;
    CHECK(std::abs(recorded(motion, "burnt", 0, "h'") / speed - 1) < 1e-11);
    CHECK(std::abs(recorded(motion, "burnt", 0, "h") / height - 1) < 1e-11);
    ends_at(motion, {{"h", height + speed * rest - g * rest * rest / 2}, {"h'", speed - g * rest}, {"M", 30}},
            1e-11);
}

TEST_CASE("elements: a ball with quadratic drag comes down where and when scipy says") {
    const Json motion = of_scene("elements/quadratic_drag");
    CHECK(std::abs(recorded(motion, "ground", 0, "t") - 4.669458731640678) < 1e-10);
    CHECK(std::abs(recorded(motion, "ground", 0, "x") - 109.84654869108405) < 1e-8);
    CHECK(std::abs(recorded(motion, "ground", 0, "y'") + 21.382766648747374) < 1e-9);
}

// The recursion from instant to instant, x ← x + v T + F T²/2, v ← v + F T, F ← −kp x − kd v.
TEST_CASE("modes: a sampled controller follows its recursion") {
    double x = 1, v = 0, F = -2;
    const double T = 0.1;
    for (int k = 0; k < 50; ++k) {
        const double step = k < 49 ? T : T / 2;
        x += v * step + F * step * step / 2;
        v += F * step;
        if (k < 49) F = -2 * x - 1.5 * v;
    }
    ends_at(of_scene("modes/sampled_hold"), {{"x", x}, {"x'", v}, {"F", F}, {"n", 49}}, 1e-10);
}

TEST_CASE(
    "modes: a rope goes slack, the stone flies, and it pulls tight again where a parabola meets the circle") {
    const Json motion = of_scene("modes/slack_rope");
    CHECK(std::abs(recorded(motion, "slack", 0, "t") - 0.4904670361532373) < 1e-10);
    CHECK(std::abs(recorded(motion, "slack", 0, "y") - 0.6394835202174654) < 1e-10);
    CHECK(std::abs(recorded(motion, "pulled", 0, "t") - 1.2756235803260019) < 1e-10);
    CHECK(std::abs(recorded(motion, "pulled", 0, "x") + 0.48877279814243657) < 1e-10);
    ends_at(motion, {{"x", -0.09781756343448593}, {"y", -0.9952043630751125}, {"x'", 2.097796472095785}}, 1e-9);
}

TEST_CASE("modes: a freewheel lets go and locks again when scipy says") {
    const Json motion = of_scene("modes/freewheel");
    CHECK(std::abs(recorded(motion, "free", 0, "t") - 1.4426111299627238) < 1e-10);
    CHECK(std::abs(recorded(motion, "lock", 0, "t") - 3.5131056885787175) < 1e-10);
    CHECK(std::abs(recorded(motion, "free", 1, "t") - 4.570808338184659) < 1e-10);
    ends_at(motion,
            {{"phi_1", -5.478788352437522},
             {"phi_2", 8.516344589712288},
             {"phi_1'", -5.101741816767694},
             {"phi_2'", 1.2133756214661722}},
            1e-9);
}

TEST_CASE("modes: a ratchet counts the teeth that scipy counts") {
    const Json motion = of_scene("modes/ratchet");
    CHECK(std::abs(recorded(motion, "tooth", 0, "t") - 0.23067767667281072) < 1e-10);
    CHECK(std::abs(recorded(motion, "tooth", 0, "phi'") - 3.0146497087836504) < 1e-9);
    CHECK(std::abs(recorded(motion, "tooth", 17, "t") - 3.784879568795745) < 1e-9);
    ends_at(motion, {{"phi", 4.745428964901083}, {"phi'", -4.802861121648448}, {"n", 18}}, 1e-9);
}

TEST_CASE("modes: a clutch slips, sticks, slips under a load and sticks again when scipy says") {
    const Json motion = of_scene("modes/clutch");
    const Json& told = motion["contacts"];
    REQUIRE(told.size() == 3);
    for (const auto& [k, time, what] :
         {std::tuple{0, 2.3627327192672554, "stick"}, {1, 4.0, "slip"}, {2, 4.960609691865848, "stick"}}) {
        CHECK(std::abs(told[k]["time"].get<double>() - time) < 1e-10);
        CHECK(told[k]["event"] == what);
    }
    CHECK(told[1]["side"] == 1);
    ends_at(motion,
            {{"phi_1", 428.9378092709625},
             {"phi_2", 268.7641865715482},
             {"phi_1'", 55.05512415294133},
             {"phi_2'", 55.05512415294133}},
            1e-9);
}

TEST_CASE("modes: a hoist takes a load, drops it, and it falls freely") {
    const Json motion = of_scene("modes/pick_and_drop");
    CHECK(std::abs(recorded(motion, "take", 0, "t") - 0.4) < 1e-12);
    CHECK(std::abs(recorded(motion, "drop", 0, "t") - 2.00981) < 1e-10);  // m g/k behind the hook
    CHECK(std::abs(recorded(motion, "drop", 0, "y'") - 0.5) < 1e-10);
    CHECK(std::abs(recorded(motion, "ground", 0, "t") - 2.515169614434713) < 1e-10);
    CHECK(std::abs(recorded(motion, "ground", 0, "y'") + 4.457577817604535) < 1e-9);
}

TEST_CASE("modes: a body slides off a sphere at two thirds of its height") {
    const Json motion = of_scene("modes/roll_off");
    CHECK(std::abs(recorded(motion, "off", 0, "y") - 2 * std::sqrt(0.91) / 3) < 1e-10);
}

}  // namespace commands_elements
