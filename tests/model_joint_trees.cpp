// SPDX-License-Identifier: MIT
// Trees of bodies on joints: against accelerations computed elsewhere, their graphs, and what all joints have in
// common.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include "analysis/agree/agree.hpp"
#include "joint_scenes.hpp"
#include "mechanisms.hpp"
#include "model/formalism/dalembert.hpp"
#include "model/formalism/kane.hpp"
#include "model/formalism/lagrange.hpp"
#include "model/formalism/roberson_wittenburg.hpp"
#include "model/formalism/schiehlen.hpp"
#include "scene/joint_moves.hpp"

namespace model_joint_trees {

using namespace alembert;
using namespace alembert::test;

TEST_CASE("joints: trees of bodies accelerate as computed elsewhere") {
    int compared = 0;
    for (const ReferenceTree& tree : reference_trees()) {
        CAPTURE(tree.name);
        const Mechanism m = tree.mechanism();
        for (const Equations& equations :
             {lagrange(m), kane(m), dalembert(m), schiehlen(m), roberson_wittenburg(m)}) {
            CAPTURE(equations.formalism);
            CHECK(relative_distance(group(lowered(m, equations), start_of(m).state(), Group::acceleration),
                                    tree.accelerations) < 1e-12);
            ++compared;
        }
    }
    CHECK(compared == 35);
}

// A hangs on the ground, C on A, B on C by a joint from B to C; D closes a loop from B to the ground; P is a
// particle on its own.
TEST_CASE("joints: incidence and path matrix of the system graph are inverse to each other") {
    std::string text = "[coordinates]\nx = 0\n[[particle]]\nname = \"P\"\nmass = 1\nposition = [\"x\", 0]\n";
    for (const char* body : {"A", "B", "C"}) text += fmt::format("[[body]]\nname = \"{}\"{}", body, masses);
    const auto joint = [](const char* name, const char* type, const char* parent, const char* child,
                          const char* q) {
        return fmt::format("[[joint]]\nname = \"{}\"\ntype = \"{}\"\nparent = \"{}\"\nchild = \"{}\"\n{}", name,
                           type, parent, child,
                           *q != 0 ? fmt::format("coordinates = {{ {} = 0 }}\n", q) : std::string());
    };
    const Mechanism m =
        from_text(text + joint("b", "revolute", "B", "C", "q1") + joint("d", "spherical", "N", "B", "") +
                  joint("c", "revolute", "A", "C", "q2") + joint("a", "prismatic", "N", "A", "q3"));
    const SystemGraph g = system_graph(m);
    REQUIRE(g.arcs.size() == 4);
    CHECK(g.chords == std::vector<std::string>{"d: N -> B"});
    // Bodies P, A, B, C; arcs P (its own), a: N -> A, c: A -> C, b: B -> C.
    CHECK(g.S_0 == std::vector<int>{1, 1, 0, 0});
    CHECK(g.S == std::vector<std::vector<int>>{{-1, 0, 0, 0}, {0, -1, 1, 0}, {0, 0, 0, 1}, {0, 0, -1, -1}});
    CHECK(g.T == std::vector<std::vector<int>>{{-1, 0, 0, 0}, {0, -1, -1, -1}, {0, 0, -1, -1}, {0, 0, 1, 0}});
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t k = 0; k < 4; ++k) {
            int unit = 0, ground = 0;
            for (std::size_t a = 0; a < 4; ++a) {
                unit += g.T[i][a] * g.S[a][k];
                ground += g.S_0[a] * g.T[a][k];
            }
            CHECK(unit == (i == k ? 1 : 0));
            CHECK(ground == -1);
        }
}

TEST_CASE("joints: every formalism that applies gives the same equations of the gallery's mechanisms") {
    for (const char* name : {"slider_crank_joints", "four_bar_joints", "gimballed_gyroscope",
                             "universal_double_pendulum", "furuta_joints", "rssr"}) {
        CAPTURE(name);
        const Mechanism m =
            prepared(read_scene(source_path(fmt::format("scenes/gallery/{}.toml", name)))).mechanism;
        const Derivations derivations = derive_all(m);
        CHECK(derivations.equations.size() >= 3);
        CHECK(agree(derivations.equations, m).verdict == Agreement::Verdict::proved);
    }
}

// Of six directions a joint leaves those in which it moves; a quaternion is four coordinates for three of them.
TEST_CASE("joints: locked and free directions are six in all") {
    for (const std::string& name : joint_types()) {
        CAPTURE(name);
        const Joint::Type type = joint_type_named(name).value();
        CHECK(moves_of(type).name == name);
        Joint joint;
        joint.type = type;
        const std::size_t by_quaternion = coordinates_of(joint);
        joint.angles = "zxz";
        CHECK(locked_directions(type) + static_cast<int>(coordinates_of(joint)) == 6);
        CHECK(by_quaternion == coordinates_of(joint) + (moves_of(type).has(Move::Kind::turn_in_space) ? 1 : 0));
    }
    CHECK_FALSE(joint_type_named("hinge"));
}

}  // namespace model_joint_trees
