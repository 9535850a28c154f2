// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// From a scene to its equations of motion, and on to the program that runs: the part of the way that all verbs
/// share.
///
///     const Derived d = derived(read_scene("scenes/textbook/double_pendulum.toml"), {.by = "kane"});
///     d.equations.M;
///     const Program program = lowered(d).program;

#include "formalism/equations.hpp"
#include "lower/choose.hpp"
#include "state/prepared.hpp"

namespace alembert {

/// What equations are for: to be read (where no formalism is named, the ones that a teacher would choose), to be
/// run, or to be asked for numbers at a state, M among them.
enum class Use { shown, run, asked };

struct DeriveOptions {
    std::string by = {};  ///< a formalism by its name; empty: the program chooses
    Use use = Use::shown;
    bool reactions = false;  ///< the share of each constraint along each coordinate becomes an output
    Overrides at = {};       ///< values at which the bodies are checked
    bool on_sheets = false;  ///< roots of squares on the sheet of the initial state
};

/// Which output of the mechanism is the share of a constraint along a coordinate.
struct ReactionOutput {
    std::size_t output;
    std::string constraint, coordinate;
};

/// A scene with its mechanism and equations. Redundant constraints are left out of the mechanism, and a warning
/// names them. Both share one table of intermediate symbols, which is the equations'.
struct Derived : Prepared {
    Equations equations = {};
    std::string by = {};  ///< the formalism that was asked for; empty: the program chose
    double seconds = 0;   ///< processor time
    std::vector<ReactionOutput> reaction_outputs = {};  ///< where they were asked for
};

/// Builds and derives. To be run, a large tree of joints gets the recursive equations at once, which are the
/// fastest there. Throws what the stages throw; ModelError for a formalism that does not exist or does not apply.
Derived derived(Scene scene, const DeriveOptions& options = {});

/// The same scene with another mechanism (constraints added); by the formalism of that name, or the teacher's
/// choice.
Derived derived_again(const Derived& derived, Mechanism mechanism, const std::string& by);

/// Throws ModelError for equations in generalized speeds, which contacts cannot change.
void need_rates(const Derived& derived);

/// Lowered in the form that takes the fewest operations. Where no formalism was asked for, the recursions compete.
/// `fold`: parameters become constants.
Choice lowered(const Derived& derived, bool fold = false);

/// Why the numbers fail at a state, in the terms of the scene: a combination of rates that no inertia resists,
/// constraints that lose their rank, or the term of the body that is not finite. Nothing if none is the case. (The
/// form with intermediate symbols knows whose term each value is; the textbook's has merged them.)
std::optional<std::string> failure_at(const Derived& derived, const State<double>& state);

}  // namespace alembert
