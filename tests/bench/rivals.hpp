// SPDX-License-Identifier: MIT
#pragma once

/// What other programs need for q, q', τ → q'' of a chain of bodies on revolute joints, and those programs that
/// are there.
///
///     const std::optional<Tree> tree = tree_of("arm7", "tests/bench/systems");
///     for (const Rival& rival : rivals_of(*tree)) rival.accelerations(q, u, a);
///
/// A body's frame is its joint's. At q = 0 it stands in the parent's frame at p, with its axes along the columns
/// of R; then it turns by q about `axis`. Mass centre and inertia (about the mass centre: xx xy xz yy yz zz) are
/// along it. SI units. The torques are the tree's own and stay as they are. Each rival has a file of its own,
/// rivals_NAME.cpp.

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace alembert::bench {

using Vector = std::array<double, 3>;

struct TreeBody {
    int parent = -1;
    std::array<Vector, 3> R;  ///< row by row
    Vector p, axis;
    double mass = 0;
    Vector com;
    std::array<double, 6> inertia;
};

struct Tree {
    std::string name;
    Vector gravity;
    std::vector<TreeBody> bodies;
    std::vector<double> tau;
};

/// `pendN` from its formula, others from FOLDER/NAME.json; nothing where there is no such file.
std::optional<Tree> tree_of(const std::string& name, const std::string& folder);

struct Rival {
    std::string name;
    std::function<void(const double* q, const double* u, double* a)> accelerations;
};

Rival mujoco(const Tree& tree);
Rival kdl(const Tree& tree);
Rival bullet(const Tree& tree);
Rival simbody(const Tree& tree);
Rival dart(const Tree& tree);

/// Those that were found when this was configured.
std::vector<Rival> rivals_of(const Tree& tree);

}  // namespace alembert::bench
