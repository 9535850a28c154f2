// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Roberson and Wittenburg's formalism: the system graph, its matrices, and the equations in terms of them.
///
///     const SystemGraph graph = system_graph(mechanism);
///     graph.S[i][a], graph.T[a][i];
///     const Equations equations = roberson_wittenburg(mechanism);
///
/// Vertices are the bodies, arcs the joints, each from its parent to its child. Joints that close loops are chords
/// and enter by their constraints. A body that no joint places, or a particle, is connected with the ground by an
/// arc of its own, whose motion follows from its position and frame. The speeds are the rates.

#include "model/formalism/newton_euler.hpp"
#include "model/formalism/steps.hpp"

namespace alembert {

/// S is the incidence matrix: S_ia = 1 where arc a begins at body i, −1 where it ends there; S_0 the row of the
/// ground. T is the path matrix: T_ai = 1 where arc a lies on the path from body i to the ground and points to the
/// ground, −1 where it points away. T S = E, S_0 T = (−1 … −1). (Wittenburg, Dynamics of Multibody Systems (2008),
/// chapter 5.)
struct SystemGraph {
    struct Arc {
        std::string name;
        int from, to;    ///< positions in Mechanism::masses; −1 is the ground
        bool outwards;   ///< whether `to` is farther from the ground than `from`
        int joint = -1;  ///< position in Mechanism::joints; −1 for a body that no joint places
    };
    std::vector<std::string> bodies;
    std::vector<Arc> arcs;            ///< as many as bodies; each comes after the other arcs of its path
    std::vector<std::string> chords;  ///< "rocker: coupler -> arm"
    std::vector<int> S_0;
    std::vector<std::vector<int>> S;  ///< bodies × arcs
    std::vector<std::vector<int>> T;  ///< arcs × bodies
};
SystemGraph system_graph(const Mechanism& mechanism);

/// Throws ModelError with the obstacle if there is one.
Equations roberson_wittenburg(const Mechanism& mechanism);
/// Why the equations do not apply: the obstacle of `schiehlen`, or a scene without joints, which has no graph.
std::optional<std::string> obstacle_to_roberson_wittenburg(const Mechanism& mechanism);
/// The graph in words, S and T.
std::vector<Section> outline_of_roberson_wittenburg(const Mechanism& mechanism);

}  // namespace alembert
