// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A scene with its mechanism, checked at the numbers that it is asked for.
///
///     const Prepared p = prepared(read_scene("scenes/textbook/coin.toml"));
///     p.mechanism.constraints.size();
///     for (const std::string& warning : p.warnings) std::cerr << warning;
///
/// Every verb begins with one. Nothing is printed: what a person should be told stands in `warnings`, with its
/// place in the scene.

#include <string>
#include <vector>

#include "lower/start.hpp"
#include "model/mechanism.hpp"
#include "model/root_sheets.hpp"
#include "scene/scene.hpp"

namespace alembert {

struct Prepared {
    Scene scene;
    Mechanism mechanism;
    std::vector<std::string> warnings;        ///< lines for a person, each ending with a line break
    std::shared_ptr<RootSheets> sheets = {};  ///< of a mechanism that was built on them

    /// Tells it at once, or keeps it in `warnings` (Scene::on_warning).
    void warn(std::string warning);
};

/// Builds the mechanism and checks the bodies at the scene's values with those of `at` in their place. A moment of
/// inertia that breaks the triangle inequality is a warning. Throws SceneError for a mistake in the scene, and for
/// a mass or a principal moment that is negative at these values; ModelError for a name in `at` that the scene
/// does not have.
/// `on_sheets`: with roots of squares on the sheet of the initial state (model/root_sheets.hpp).
Prepared prepared(Scene scene, const Overrides& at = {}, bool on_sheets = false);

/// The check of the bodies alone, at other values. Gives the warnings; throws as `prepared`.
std::vector<std::string> check_bodies(const Scene& scene, const Mechanism& mechanism, const Overrides& at);

}  // namespace alembert
