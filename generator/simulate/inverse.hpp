// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The verb `inverse`: the loads along the coordinates that given accelerations need.
///
///     const Scene scene = read_scene("scenes/gallery/six_joint_arm.toml");
///     const InverseLoads needed = inverse(scene, {.at = {{"q1''", 2}, {"q1", 0.3}}});
///     needed.loads[0];      // N m, along needed.coordinates[0]

#include "analysis/derive/derived.hpp"

namespace alembert {

struct InverseOptions {
    std::string by = {};
    /// "q''" names an acceleration, "u'" the rate of a speed of the scene; other names as for `evaluate`.
    Overrides at = {};
};

struct InverseLoads : Derived {
    double time = 0;
    std::vector<std::string> coordinates = {};
    std::vector<double> q = {}, rates = {}, accelerations = {}, loads = {};
    std::vector<std::pair<std::string, double>> multipliers = {};
    /// The scene's own speeds, and the loads along them that have the same power. Empty without such speeds, and
    /// the loads also where the speeds do not determine the rates.
    std::vector<std::string> speeds = {};
    std::vector<double> speed_values = {}, speed_rates = {}, speed_loads = {};
    bool given_in_speeds = false;  ///< whether rates of speeds were given
};

/// With rates of speeds, those that are not given are 0, and the loads act along speeds: those along the
/// coordinates have the same power. Otherwise: M q'' = f + Aᵀλ + τ with A q'' = γ, for the loads τ. Accelerations
/// that are not given follow from those that are (as many as there are degrees of freedom, or fewer); without
/// constraints they are 0. If all are given, the loads are those of least norm that produce them. Throws
/// ModelError for accelerations of unknown names, for those that break a constraint, and for accelerations of
/// coordinates together with rates of speeds; IntegrationError if the given ones do not determine the motion.
InverseLoads inverse(Scene scene, const InverseOptions& options);

}  // namespace alembert
