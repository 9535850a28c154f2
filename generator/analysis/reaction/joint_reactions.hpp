// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Reactions of joints: the force and the moment that a joint exerts on its child, found by cutting the joint; and
/// the normal reactions of bodies that roll (rolling_release.hpp).
///
///     const JointReactions reactions = joint_reactions(scene, mechanism);
///     // program: of any formalism, at q, q' (or q, u)
///     const std::vector<JointLoad> loads = reactions.at(program, state);
///     loads[0].force[2];
///     reactions.normals_at(program, state);    // numbers in the order of reactions.normals
///
/// Before each joint a massless link with six coordinates c (three shifts and three turns along the joint's axes)
/// is inserted. To hold them at c = 0 takes the loads
///     R = ∂T-terms(c) − Q(c) − A_cᵀλ,
/// which are the force and the moment in the joint, by the principle of virtual displacements for a released joint
/// (Schiehlen, Technische Dynamik (1986), §4.2: the columns Q̄ of the reactions; Featherstone, Rigid Body Dynamics
/// Algorithms (2008), §5.3: f_i). Everything that acts along c counts, including springs, dampers, forces at
/// points, rolling and loops. Loads along the joint's own coordinate ([forces], dampers along it) do no work along
/// c and therefore belong to the reaction: along a free axis R is the contribution of the drive. The reaction of a
/// joint that closes a loop comes from its multipliers only, R = −A_cᵀλ, because its link is attached to the
/// parent only. The first two terms come from one sweep for all joints (program/lower/held_loads.hpp); with
/// [energy] kinetic from M and f.
///
/// The force acts on the child at the joint's point of the child, the moment is about that point; both along the
/// joint's axes in the body that is placed before the joint: the parent, unless the joint places its parent.
/// Multipliers of constraints that were left out because they hold identically are 0; those of constraints that
/// follow from others are the multipliers of least norm.

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
    std::vector<std::string> rollings;     ///< the rollings whose normal reactions are determined
    std::vector<std::string> normals;      ///< and these: "lambda_wheel_normal" …
    std::vector<std::string> multipliers;  ///< the names of the variables of kind `unknown`
    Program program;  ///< roots "force" and "moment", three for each joint, then a "force" for each normal
                      ///< reaction, as functions of q, q', q'' and multipliers

    /// `program` gives q'' and the multipliers; `state` is in the order of that program.
    std::vector<JointLoad> at(const Program& program, const State<double>& state) const;

    /// The same, with 0 for values that are only rounding (program/without_rounding.hpp).
    std::vector<JointLoad> without_rounding(const Program& program, const State<double>& state) const;

    std::vector<double> normals_at(const Program& program, const State<double>& state) const;
    std::vector<double> normals_without_rounding(const Program& program, const State<double>& state) const;
};

/// Whether the scene has joints, or bodies that roll.
bool has_reactions(const Mechanism& mechanism);

/// Throws what `build` throws for the scene with released joints, and ModelError if a Lagrangian is given and
/// there are joints.
JointReactions joint_reactions(const Scene& scene, const Mechanism& mechanism);

}  // namespace alembert
