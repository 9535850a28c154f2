// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// From a scene's file to its program: the part of the way that all commands share.

#include <nlohmann/json.hpp>

#include "commands/command.hpp"
#include "lower/choose.hpp"
#include "lower/start.hpp"

namespace alembert {

using Json = nlohmann::ordered_json;

struct Derived {
    Scene scene;
    Mechanism mechanism;
    Equations equations;
    double seconds = 0;  ///< processor time
};

/// Prints a warning for each inertia that breaks the triangle inequality at the scene's values and these; throws SceneError
/// for a mass or a principal moment that is negative there.
void check_bodies(const Scene& scene, const Mechanism& mechanism, const Overrides& overrides);

/// What equations are for: to be read (without --by the ones that a teacher would choose), to be run, or to be asked for numbers at
/// a state, M among them.
enum class Use { shown, run, asked };

/// Reads, builds and derives. To be run, a large tree of joints gets the recursive equations at once, which are the fastest there. Prints the scene's warnings to standard error. Throws what the stages throw;
/// ModelError for a formalism that does not exist or does not apply.
Derived derived(const Request& request, Use use = Use::shown);

/// The same scene with another mechanism (constraints added); by the formalism of that name, or the teacher's choice.
Derived derived_again(const Derived& derived, Mechanism mechanism, const std::string& by);

/// Throws ModelError for equations in generalized speeds, which contacts cannot change.
void need_rates(const Derived& derived);

/// Lowered in the form that takes the fewest operations.
Choice lowered(const Derived& derived, const Request& request);

/// Why the numbers fail at a state, in the terms of the scene: a combination of rates that no inertia resists, constraints
/// that lose their rank, or the term of the body that is not finite. Nothing if none is the case. (The form with intermediate symbols knows
/// whose term each value is; the textbook's has merged them.)
std::optional<std::string> failure_at(const Derived& derived, const State<double>& state);

/// The values of --at. Throws ModelError for what is not NAME=VALUE.
Overrides overrides_of(const Request& request);

/// As it is printed; bytes that are not UTF-8 (of a file's name, say) are U+FFFD.
std::string as_text(const Json& json);

/// Processor time of this process and its finished children, in seconds.
double process_seconds();

/// {name: value} for all coordinates.
Json by_coordinate(const Program& program, const double* values);

}  // namespace alembert
