// SPDX-License-Identifier: MIT
// A scene that is made by a program: a chain of n rods on a ceiling, let go horizontally. Prints how many
// operations one evaluation of its equations takes, and by how much a run changes the energy.
#include <alembert/scene/draft.hpp>
#include <alembert/simulate/simulate.hpp>
#include <cstdio>
#include <string>

namespace {

alembert::Scene chain(int rods) {
    alembert::SceneDraft draft;
    draft.set("title", "Chain of " + std::to_string(rods) + " rods").set("gravity", {0, "-g"});
    draft.table("parameters").set("m", 0.5).set("l", 0.2).set("g", 9.81);
    std::string end = "O";
    for (int i = 1; i <= rods; ++i) {
        const std::string k = std::to_string(i), angle = "q" + k, frame = "R" + k;
        draft.table("coordinates").set(angle, alembert::DraftTable().set("initial", "pi/2").set("unit", "rad"));
        draft.add("frame").set("name", frame).set("rotate", alembert::DraftValue::list({{"z", angle}}));
        draft.add("body")
            .set("name", "rod" + k)
            .set("mass", "m")
            .set("inertia", "m*l^2/12")
            .set("frame", frame)
            .set("from", end)
            .set("position", {0, "-l/2"})
            .set("axes", frame);
        draft.add("point").set("name", "P" + k).set("from", end).set("offset", {0, "-l"}).set("axes", frame);
        end = "P" + k;
    }
    return draft.scene();
}

}  // namespace

int main() {
    using namespace alembert;
    for (const int rods : {1, 4}) {
        const Run run = simulate(chain(rods), {.duration = 2, .tolerance = 1e-11});
        std::printf("%d rods: the energy keeps %s\n", rods,
                    run.energy.drift < 1e-9 ? "to 1e-9" : "less than 9 digits");
        if (!run.distrust_reasons.empty()) return 1;
    }
}
