// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The verb `derive`: a scene's equations of motion as a reader sees them.
///
///     const DerivedScene d = derive(read_scene("scenes/textbook/double_pendulum.toml"), {.by = "lagrange"});
///     latex(d.shown.equations[0].lhs);

#include "derive/derivation.hpp"
#include "derive/derived.hpp"

namespace alembert {

struct ShowOptions {
    std::string by = {};     ///< a formalism; empty: the one that a teacher would choose
    bool reactions = false;  ///< the share of each constraint along each coordinate, and what joints bear
};

/// Reactions of unilateral constraints stand in the equations, zero while their gap is open, unless the formalism
/// is one for independent coordinates.
struct DerivedScene : Derived {
    Derivation shown = {};
    std::vector<Statement> joint_loads = {};  ///< F_x … M_z on the child of each joint, as far as they are short
    bool has_unilateral_reactions = false;
};

/// Throws as `derived` does.
DerivedScene derive(Scene scene, const ShowOptions& options = {});

}  // namespace alembert
