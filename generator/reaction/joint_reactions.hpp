// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What joints bear: the force and the moment that a joint exerts on its child, by cutting it.
///
///     const JointReactions reactions = joint_reactions(scene, mechanism);
///     // program: of any formalism, at q, q' (or q, u)
///     const std::vector<JointLoad> loads = reactions.at(program, state);
///     loads[0].force[2];
///
/// Before each joint a massless link with six coordinates c (three shifts, three turns along the joint's axes) is
/// put. Held at c = 0 these need the loads
///     R = ∂T-terms(c) − Q(c) − A_cᵀλ,
/// which are the force and the moment that the joint bears: the principle of virtual displacements for a released
/// joint (Schiehlen, Technische Dynamik (1986), §4.2: the columns Q̄ of the reactions; Featherstone, Rigid Body
/// Dynamics Algorithms (2008), §5.3: f_i). All that acts along c is counted, springs, dampers, forces at points,
/// rolling and loops included. Loads along the joint's own coordinate ([forces], dampers along it) do nothing
/// along c and so belong to what the joint bears: along a free axis R is the drive's share. A joint that closes a
/// loop bears what its multipliers do, R = −A_cᵀλ, its link hanging on the parent alone. The first two terms come
/// from one sweep for all joints (lower/held_loads.hpp); with [energy] kinetic from M and f.
///
/// The force acts on the child at the joint's point of the child, the moment is about that point; both along the
/// joint's axes in that of the two bodies which the joint finds placed: the parent, but for a joint that places
/// its parent. Multipliers of constraints that were left out because they say nothing are taken as 0; those of
/// constraints that follow from others are the least ones.

#include <array>
#include <string>
#include <vector>

#include "model/mechanism.hpp"
#include "program/interpret.hpp"

namespace alembert {

struct JointLoad {
    std::string joint;
    std::array<double, 3> force, moment;
};

struct JointReactions {
    std::vector<std::string> joints;       ///< in the order of the scene
    std::vector<std::string> multipliers;  ///< variables of kind `unknown`
    Program program;                       ///< "force", "moment": three for each joint, in q, q', q'', multipliers

    /// `program` gives q'' and the multipliers at the state that it counts by.
    std::vector<JointLoad> at(const Program& program, const State<double>& state) const;
};

/// Throws what `build` throws for the scene that has been cut, and ModelError where a Lagrangian is given.
JointReactions joint_reactions(const Scene& scene, const Mechanism& mechanism);

}  // namespace alembert
