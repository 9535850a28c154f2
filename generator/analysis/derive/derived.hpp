// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// From a scene to its equations of motion, and on to the program that runs. All verbs share these steps.
///
///     const Derived d = derived(read_scene("scenes/textbook/double_pendulum.toml"), {.by = "kane"});
///     d.equations.M;
///     const Program program = lowered(d).program;

#include "analysis/state/prepared.hpp"
#include "model/formalism/equations.hpp"
#include "program/differentiate.hpp"
#include "program/lower/choose.hpp"

namespace alembert {

/// The purpose of equations: to be read (if no formalism is named, by the one that a teacher would choose); to be
/// read, or counted where nobody would read them; to be run; or to be evaluated at a state, including M.
enum class Use { shown, shown_or_counted, run, asked };

struct DeriveOptions {
    std::string by = {};  ///< the name of a formalism; if empty, the program chooses
    Use use = Use::shown;
    bool reactions = false;    ///< whether the reaction of each constraint along each coordinate becomes an output
    Overrides at = {};         ///< the values at which the bodies are checked
    bool with_states = false;  ///< whether the scene's first-order states are among the speeds of the equations
    bool on_sheets = false;    ///< whether roots of squares are on the sheet of the initial state
    Coordinates coordinates = Coordinates::needed;
};

/// The output of the mechanism that is the reaction of a constraint along a coordinate.
struct ReactionOutput {
    std::size_t output;
    std::string constraint, coordinate;
};

/// A scene with its mechanism and equations. Redundant constraints are left out of the mechanism, and a warning
/// names them. Both use the same table of intermediate symbols, that of the equations.
struct Derived : Prepared {
    Equations equations = {};
    std::string by = {};                                ///< the requested formalism; empty if the program chose
    double seconds = 0;                                 ///< processor time
    std::vector<ReactionOutput> reaction_outputs = {};  ///< set if they were requested
};

/// Builds the mechanism and derives its equations. If they are to be run or counted, a large tree of joints gets
/// the recursive equations at once, because these are the fastest there. Throws what the stages throw; ModelError
/// for a formalism that does not exist or does not apply.
Derived derived(Scene scene, const DeriveOptions& options = {});

/// The same scene with another mechanism (constraints added); by the formalism of that name, or the one that a
/// teacher would choose.
Derived derived_again(const Derived& derived, Mechanism mechanism, const std::string& by);

/// Throws ModelError for equations in generalized speeds, which contacts cannot change.
void need_rates(const Derived& derived);

/// Lowers the equations in the form that takes the fewest operations. If no formalism was requested, the
/// recursions compete too. With `fold`, parameters become constants.
Choice lowered(const Derived& derived, bool fold = false);

/// The derivatives of a program that `lowered` gave with the same `fold`, by the tree of joints too where there is
/// one (program/lower/perturbed_tree.hpp).
std::optional<Differentiated> derivatives_of(const Derived& derived, const Program& program,
                                             DerivativeWishes wishes = {}, bool fold = false);

/// The reason, in terms of the scene, why the computation fails at a state: a combination of rates that has no
/// inertia, constraints that lose rank, or a term of a body that is not finite. Nothing if none of these is the
/// case. (The form with intermediate symbols knows the origin of each value; in the textbook form terms have been
/// merged.)
std::optional<std::string> failure_at(const Derived& derived, const State<double>& state);

/// Whether the accelerations divide by zero at a state, and nothing that `failure_at` looks at before is the case.
bool divides_by_zero_at(const Derived& derived, const State<double>& state);

/// The message of a state without finite accelerations, with its time and the reason.
std::string no_accelerations_at(const Derived& derived, const State<double>& state);

}  // namespace alembert
