// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A scene with its mechanism, checked at the numbers for which it is used.
///
///     const Prepared p = prepared(read_scene("scenes/textbook/coin.toml"));
///     p.mechanism.constraints.size();
///     for (const std::string& warning : p.warnings) std::cerr << warning;
///
/// Every verb begins with one. Nothing is printed; messages for the user are in `warnings`, with their places in
/// the scene.

#include <string>
#include <vector>

#include "model/mechanism.hpp"
#include "model/root_sheets.hpp"
#include "program/lower/start.hpp"
#include "scene/scene.hpp"

namespace alembert {

struct Prepared {
    Scene scene;
    Mechanism mechanism;
    std::vector<std::string> warnings;        ///< lines for the user, each ending with a line break
    std::shared_ptr<RootSheets> sheets = {};  ///< set if the mechanism was built on them

    /// Reports warnings at once, or keeps them in `warnings` (Scene::on_warning), but for kinds that the scene
    /// allows.
    void warn(std::vector<Diagnostic> found);
    /// The same of one that has no place; `text` is a line for people.
    void warn(const std::string& kind, const std::string& text);
};

/// Whether a scene without coordinates, bodies that are welded, will do.
enum class Coordinates { needed, optional };

/// Builds the mechanism and checks the bodies at the scene's values, some of which `at` replaces. A moment of
/// inertia that breaks the triangle inequality is a warning. Throws SceneError for a mistake in the scene, and for
/// a mass or a principal moment that is negative at these values; ModelError for a name in `at` that the scene
/// does not have. With `on_sheets`, roots of squares are on the sheet of the initial state
/// (model/root_sheets.hpp). Throws ModelError for a scene without coordinates where they are
/// needed.
Prepared prepared(Scene scene, const Overrides& at = {}, bool on_sheets = false,
                  Coordinates coordinates = Coordinates::needed);

/// Only the check of the bodies, at other values. Returns the warnings; throws like `prepared`.
std::vector<Diagnostic> check_bodies(const Scene& scene, const Mechanism& mechanism, const Overrides& at);

}  // namespace alembert
