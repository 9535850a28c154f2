// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A joint as geometry: where it puts the body that it places, or which conditions close its loop.
///
/// P and C being the bodies' frames, J the joint's axes in the parent and K those in the child (they come together
/// where the coordinates are 0), d the way from the joint's point of the parent to that of the child:
///     R_PC = R_PJ R_JK(q) R_KC,      r_C = r_P + R_NP p_P + R_NJ d(q) − R_NC p_C.
/// The turns R_JK are about axes that each turn takes along (about x, then the y reached; angles in the order of
/// `angles`); the shifts d are along J. From a placed child to its parent the same is gone backwards.
///
/// A loop's rows, in the order x, y, z of J, translations first (Haug, Computer Aided Kinematics and Dynamics of
/// Mechanical Systems (1989), §9.4, with the signs that make λ the force or torque on the child along that axis):
///     translation along e:   f = d·e,               f' = (relative velocity)·e,
///     rotation about e:      f = a_K·(e × a)_J,     f' = (ω_C − ω_P)·e  where f = 0,
/// a an axis at right angles to e. For a joint with one free turn, a is its axis and e, e' are two directions
/// across it; where no turn is free each of x, y, z has the next axis but one. Universal: f = −x_J·y_K. A screw's
/// shift and turn obey
///     (relative velocity)·a − pitch (ω_C − ω_P)·a = 0,
/// a velocity row: the turn, counted over many revolutions, is no function of where the bodies are.

#include "model/places.hpp"

namespace alembert {

/// Of the body that the joint places.
Orientation orientation_by(const Joint& joint, Places& places);
Vector3 position_by(const Joint& joint, Places& places);
/// The same as steps of the skeleton.
int point_by(const Joint& joint, Places& places);

/// As an arc or a chord of the system graph; bodies are left at the ground.
JointArc arc_of(const Joint& joint, Places& places);

struct ClosingRow {
    bool holonomic;
    GiNaC::ex value;
};

/// As many as locked_directions(joint.type).
std::vector<ClosingRow> closing_rows(const Joint& joint, Places& places);

}  // namespace alembert
