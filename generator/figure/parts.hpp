// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The parts of a figure, each added to the sketch by a function of its own. Of draw.cpp alone; in this order, as
/// later ones look at the elements of earlier ones.

#include "figure/sketch.hpp"

namespace alembert {

/// What is asked for before the sketch is sampled: tracks of loads, springs and constraints.
struct Asked {
    std::vector<int> spring_along, damper_along;  ///< scalars; -1 where two points are given, -2: drawn already
    std::vector<int> forces, torques, impulses;   ///< vectors along N
    std::vector<int> constraints;                 ///< scalars, of holonomic ones; -1 of others
    std::vector<std::vector<int>> rows;           ///< of velocity constraints of small plane scenes, by coordinate
    std::vector<int> gaps;                        ///< scalars
    std::vector<int> contacts;                    ///< vectors, of rollings
};
Asked asked(Sketch& sketch);

/// Masses that move on one line would cover each other: they are drawn apart, with the springs between them and
/// the walls. Does nothing in other scenes. Springs and dampers that it has drawn are marked as such in `asked`.
void spread(Sketch& sketch, Asked& asked);

void add_bodies(Sketch& sketch, const Asked& asked);
void add_particles(Sketch& sketch);
void add_constraints(Sketch& sketch, const Asked& asked);
void add_springs(Sketch& sketch, const Asked& asked);
void add_hinges(Sketch& sketch);
void add_coordinates(Sketch& sketch);
void add_loads(Sketch& sketch, const Asked& asked);

}  // namespace alembert
