// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The verb `derive`: a scene's equations of motion for a reader.
///
///     const DerivedScene d = derive(read_scene("scenes/textbook/double_pendulum.toml"), {.by = "lagrange"});
///     latex(d.shown.equations[0].lhs);

#include "analysis/derive/derivation.hpp"
#include "analysis/derive/derived.hpp"

namespace alembert {

struct ShowOptions {
    std::string by = {};  ///< a formalism; if empty, the one that a teacher would choose
    /// Whether to give the reaction of each constraint along each coordinate, and those of joints.
    bool reactions = false;
    /// Whether equations that exceed a page are made too: those of a contact that sticks, and those of large trees
    /// of joints.
    bool full = true;
    PartDone done = {};
};

/// The equations contain the reactions of unilateral constraints, which are zero while their gap is open, unless
/// the formalism needs independent coordinates.
struct DerivedScene : Derived {
    Derivation shown = {};
    std::vector<Statement> normal_reactions = {};  ///< N of each body that rolls, where it is determined and short
    std::vector<Statement> joint_loads = {};       ///< F_x … M_z on the child of each joint, if they are short
    bool has_unilateral_reactions = false;
};

/// The derivation of equations that are derived already, without reactions.
DerivedScene explained(Derived derived, const PartDone& done = {});

/// Throws what `derived` throws.
DerivedScene derive(Scene scene, const ShowOptions& options = {});

}  // namespace alembert
