// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The geometry of a joint: where it puts the body that it places, or the conditions that close its loop.
///
/// Let P and C be the bodies' frames, J the joint's axes in the parent and K those in the child (J and K coincide
/// when the coordinates are 0), and d the vector from the joint's point of the parent to that of the child. Then
///     R_PC = R_PJ R_JK(q) R_KC,      r_C = r_P + R_NP p_P + R_NJ d(q) − R_NC p_C.
/// R_JK consists of successive turns about axes that the turns before carry along (about x, then about the new y,
/// with the angles in the order of `angles`); the shifts d are along J. If the child is placed and the joint
/// places the parent, the inverse relations are used.
///
/// A loop's rows, in the order x, y, z of J, translations first (Haug, Computer Aided Kinematics and Dynamics of
/// Mechanical Systems (1989), §9.4, with the signs that make λ the force or torque on the child along that axis):
///     translation along e:   f = d·e,               f' = (relative velocity)·e,
///     rotation about e:      f = a_K·(e × a)_J,     f' = (ω_C − ω_P)·e  where f = 0,
/// where a is an axis perpendicular to e. For a joint with one free turn, a is its axis and e runs over two
/// directions perpendicular to it; if no turn is free, the axis a of each of x, y, z is the one after the next.
/// Rows of the second kind hold too where the axes are antiparallel, and without a free turn where they have
/// changed places; the products of axes that are to coincide (coinciding_axes) tell the roots apart.
/// For a universal joint f = −x_J·y_K. A screw's shift and turn obey
///     (relative velocity)·a − pitch (ω_C − ω_P)·a = 0,
/// a condition on velocities, because a turn counted over many revolutions is no function of the positions of the
/// bodies.

#include "model/places.hpp"

namespace alembert {

/// The orientation of the body that the joint places.
Orientation orientation_by(const Joint& joint, Places& places);
Vector3 position_by(const Joint& joint, Places& places);
/// The same as steps of the skeleton.
int point_by(const Joint& joint, Places& places);

/// The joint as an arc or a chord of the system graph. Its bodies are not filled in and remain the ground.
JointArc arc_of(const Joint& joint, Places& places);

struct ClosingRow {
    bool holonomic;
    GiNaC::ex value;
    std::vector<GiNaC::ex> lengths = {};  ///< whose sizes a distance comes from; none for the cosine of an angle
};

/// The rows that close the loop, as many as locked_directions(joint.type).
std::vector<ClosingRow> closing_rows(const Joint& joint, Places& places);

/// The products a_J·a_K of the axes that the rows let coincide: one where one turn is free, three where none is.
/// Where the rows hold, all are 1; or −1 or 0 where the child is turned. None for other joints, and without those
/// that are 1 in every position.
std::vector<GiNaC::ex> coinciding_axes(const Joint& joint, Places& places);

}  // namespace alembert
