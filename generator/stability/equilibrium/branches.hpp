// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The change of equilibria and steady motions with a parameter: `equilibrium --vary`.
///
///     const Branches found = branches(read_scene("scenes/textbook/rotating_hoop.toml"), {.name = "Omega",
///                                     .from = 0, .to = 10});
///     found.points[0].kind, found.points[0].parameter;       // pitchfork, sqrt(g/R)
///
/// All equilibria are searched at several values of the parameter; each one that is not on a known curve is
/// followed in both directions, and so are the branches that leave it. A closed curve between two of these values
/// to which no branch leads is not found.

#include "stability/equilibrium/crossing.hpp"
#include "stability/equilibrium/equilibria.hpp"

namespace alembert {

struct FollowOptions {
    std::string by = {};
    Overrides at = {};
    std::string name = {};  ///< a parameter, or the rate of a cyclic coordinate: "phi'"
    double from = 0, to = 1;
    std::function<void(std::string_view, double)> progress = {};
};

struct BranchPoint {
    double parameter = 0;
    std::vector<double> q;
    Stable stable = Stable::undecided;
    std::optional<PointKind> kind = {};  ///< the kind of a special point
};

struct Branch {
    std::vector<BranchPoint> points;
    bool closed = false;
    std::optional<double> family_at = {};  ///< the one value of the parameter at which all of its states are
};

struct SpecialPoint {
    PointKind kind;
    double parameter;
    std::vector<double> q;
    std::size_t branch;  ///< the branch on which it was found
};

struct Branches : Derived {
    std::string parameter = {};
    double from = 0, to = 1;
    std::vector<Branch> branches = {};
    std::vector<SpecialPoint> points = {};  ///< ordered by parameter
    std::vector<bool> is_angle = {}, essential = {};
    bool cut = false;  ///< whether a curve was abandoned before its end
};

/// Throws what `equilibria` throws, and ModelError for a name that is neither a parameter nor a cyclic rate, or a
/// range of no length.
Branches branches(Scene scene, const FollowOptions& options);

}  // namespace alembert
