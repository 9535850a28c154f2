// SPDX-License-Identifier: MIT
// Scenes made by a program are those that a file would give.
#include <doctest/doctest.h>

#include <limits>

#include "scene/draft.hpp"

namespace scene_draft {

using namespace alembert;

namespace {

SceneDraft pendulum() {
    SceneDraft draft;
    draft.set("title", "A \"quoted\" \\ title\nof two lines").set("gravity", {0, "-g"});
    draft.table("parameters").set("m", 1e-300).set("l", 0.1).set("g", 9.81).set("größe", 2.0);
    draft.table("coordinates").set("theta", DraftTable().set("initial", 0.3).set("unit", "rad"));
    draft.add("particle").set("name", "bob").set("mass", "m").set("position", {"l*sin(theta)", "-l*cos(theta)"});
    return draft;
}

std::string message(const SceneDraft& draft) {
    try {
        draft.scene("made");
    } catch (const SceneError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("draft: a scene of a program has the values that were set, to the last bit") {
    const Scene scene = pendulum().scene();
    CHECK(scene.title == "A \"quoted\" \\ title\nof two lines");
    REQUIRE(scene.parameters.size() == 4);
    CHECK(std::stod(scene.parameters[0].value.text) == 1e-300);
    CHECK(std::stod(scene.parameters[1].value.text) == 0.1);
    CHECK(scene.parameters[3].name.text == "größe");
    CHECK(scene.coordinates.at(0).unit == "rad");
    CHECK(scene.particles.at(0).name.text == "bob");
}

TEST_CASE("draft: entries of a list keep their order, and a table is made once") {
    SceneDraft draft = pendulum();
    DraftTable& first = draft.add("spring");
    draft.add("spring").set("along", "theta").set("stiffness", 2);
    first.set("along", "2*theta").set("stiffness", 1);
    draft.table("parameters").set("late", 3);
    draft.add("frame").set("name", "F").set("rotate", DraftValue::list({{"z", "theta"}}));
    const Scene scene = draft.scene();
    REQUIRE(scene.springs.size() == 2);
    CHECK(scene.springs[0].along.text == "2*theta");
    CHECK(scene.parameters.size() == 5);
    REQUIRE(scene.frames.size() == 1);
    CHECK(scene.frames[0].rotations.size() == 1);
}

TEST_CASE("draft: mistakes are told as those of a file") {
    SceneDraft unknown = pendulum();
    unknown.table("coordinates").set("phi", "thetta");
    CHECK(message(unknown).find("unknown name 'thetta'") != std::string::npos);
    SceneDraft twice = pendulum();
    twice.table("parameters").set("m", 2);
    CHECK(message(twice).find("made:") != std::string::npos);
    SceneDraft infinite = pendulum();
    infinite.table("parameters").set("big", std::numeric_limits<double>::infinity());
    CHECK(message(infinite).find("big") != std::string::npos);
    SceneDraft table = pendulum();
    table.add("no such table").set("a b", true);
    CHECK(message(table).find("no such table") != std::string::npos);
}

}  // namespace scene_draft
