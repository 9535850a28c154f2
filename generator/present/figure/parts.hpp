// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The parts of a figure; each function adds one of them to the sketch. Only draw.cpp uses these functions, in
/// this order, because later parts depend on the elements of earlier ones.

#include "present/figure/sketch.hpp"

namespace alembert {

/// The tracks of loads, springs and constraints that are requested before the sketch is sampled.
struct Asked {
    std::vector<int> spring_along,
        damper_along;  ///< scalars; -1 if two points are given, -2 if it is drawn already
    std::vector<int> forces, torques, impulses;  ///< vectors along N
    std::vector<int> constraints;                ///< scalars for holonomic constraints, -1 for others
    std::vector<std::vector<int>> rows;  ///< rows of velocity constraints of small plane scenes, by coordinate
    std::vector<int> gaps;               ///< scalars
    std::vector<int> contacts;           ///< vectors of rolling conditions
};
Asked asked(Sketch& sketch);

/// Masses that move on one line would cover each other: they are drawn apart, with the springs between them and
/// the walls. For other scenes it does nothing. Springs and dampers that it has drawn are marked in `asked`.
void spread(Sketch& sketch, Asked& asked);

/// Adds the points about which particles turn as sites, where the scene has no name for them.
void find_centres(Sketch& sketch);

void add_bodies(Sketch& sketch, const Asked& asked);
void add_particles(Sketch& sketch);
/// The circle on which a wheel rolls, if the wheel's centre `wheel` keeps its distance from the fixed point
/// `middle` and the radius of that circle is a parameter, also where the wheel's radius is `changed` because all
/// parameters are. Returns whether it was added.
bool add_round_ground(Sketch& sketch, int middle, int wheel, std::optional<double> changed = {});
void add_constraints(Sketch& sketch, const Asked& asked);
void add_springs(Sketch& sketch, const Asked& asked);
void add_hinges(Sketch& sketch);
void add_coordinates(Sketch& sketch);
void add_loads(Sketch& sketch, const Asked& asked);

}  // namespace alembert
