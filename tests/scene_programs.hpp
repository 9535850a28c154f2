// SPDX-License-Identifier: MIT
#pragma once

/// Programs of scenes, for tests that hold something against them in several states.
///
///     for_scene_programs(1, [&](const SceneProgram& one) {
///         State<double> s = one.start;
///         …
///         step_aside(s, random);
///     });

#include <random>
#include <string>

#include "analysis/state/prepared.hpp"
#include "model/formalism/formalisms.hpp"
#include "program/lower/choose.hpp"
#include "scenes.hpp"

namespace alembert::test {

struct SceneProgram {
    std::string name;  ///< the scene's path and the formalism
    Program program;
    State<double> start;
};

/// Those of the scenes of the textbook and of the gallery, every third from `first` on, by Routh's equations and
/// by Kane's, where their matrix is regular.
template <typename Use>
void for_scene_programs(std::size_t first, const Use& use) {
    for (const char* folder : {"scenes/textbook", "scenes/gallery"})
        for (const std::string& path : every_third(scenes_in(folder), first)) {
            const Mechanism m = prepared(read_scene(path)).mechanism;
            for (const char* by : {"routh", "kane"}) {
                if (formalism(by).obstacle(m)) continue;
                const Equations equations = formalism(by).derive(m);
                Program program = choose(m, equations).program;
                if (program.singular) continue;
                use(SceneProgram{path + " by " + by, std::move(program), state_of(start_of(m), m, equations)});
            }
        }
}

/// A tenth of a second later, and by up to 0.3 elsewhere.
inline void step_aside(State<double>& s, std::mt19937_64& random) {
    std::uniform_real_distribution<double> near(-0.3, 0.3);
    s.t += 0.1;
    for (double& q : s.q) q += near(random);
    for (double& u : s.qdot) u += near(random);
}

}  // namespace alembert::test
