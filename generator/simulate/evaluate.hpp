// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The verb `eval`: one evaluation of a scene, at its initial state or another. No compiler is needed.
///
///     const Scene scene = read_scene("scenes/textbook/double_pendulum.toml");
///     const Evaluation at = evaluate(scene, {.at = {{"theta1", 0.3}}});
///     at.accelerations[0];     // rad/s², of at.coordinates[0]

#include <array>
#include <optional>

#include "analysis/derive/derived.hpp"
#include "analysis/reaction/joint_reactions.hpp"

namespace alembert {

struct EvaluateOptions {
    std::string by = {};  ///< a formalism; if empty, the program chooses
    Overrides at = {};    ///< coordinates, rates, speeds, parameters, t
    /// Whether to give the reaction of each constraint along each coordinate, and those of joints.
    bool reactions = false;
    bool matrices = false;  ///< whether to give M(q) and C(q, q')
};

/// Names and values stand in the order of the scene; units are the scene's.
struct Evaluation : Derived {
    using Named = std::vector<std::pair<std::string, double>>;
    double time = 0;
    std::vector<std::string> coordinates = {};
    std::vector<double> q = {}, rates = {}, accelerations = {};
    Named speeds = {},
          speed_rates = {};  ///< the scene's generalized speeds and their rates; empty if there are none
    Named states = {}, state_rates = {};  ///< the scene's first-order states and their rates
    Named multipliers = {};               ///< also those of open contacts, which are 0
    double kinetic = 0, potential = 0, energy = 0;
    std::vector<std::pair<std::string, std::array<double, 2>>> residuals =
        {};  ///< for each constraint, the residuals of position and velocity
    std::optional<std::vector<std::string>> closed = {};  ///< unilateral contacts that are closed and stay so
    /// For each dry friction +1 or −1 if it slides in that direction, 0 if it sticks.
    std::vector<std::pair<std::string, int>> frictions = {};
    /// Lines that tell which values were moved so that the constraints hold.
    std::vector<std::string> adjusted = {};
    Named outputs = {};
    struct Reaction {
        std::string constraint, coordinate;
        double force;
    };
    std::vector<Reaction> reactions = {};                               ///< set if they were requested
    std::vector<JointLoad> joint_loads = {};                            ///< likewise
    std::vector<std::pair<std::string, double>> normal_reactions = {};  ///< likewise, of bodies that roll
    /// M(q) and C(q, q') of M q'' + C q' + g = Q by Christoffel's symbols (program/lower/robot_functions.hpp), row
    /// by row; set if they were requested.
    std::vector<std::vector<double>> mass = {}, coriolis = {};
    std::string no_coriolis = {};  ///< why there is no C
};

/// Throws what `derived` throws; ModelError for a name in `at` that the scene does not have and for a gap that is
/// negative; IntegrationError if the accelerations are not finite,
/// with the reason in terms of the scene.
Evaluation evaluate(Scene scene, const EvaluateOptions& options = {});

}  // namespace alembert
