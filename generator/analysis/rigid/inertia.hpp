// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The mass, mass centre and inertia tensor of a body, or of several bodies together as one rigid body (Zhang &
/// Qin (2004), chapter 3).
///
///     const SceneInertia found = inertia(read_scene("scenes/textbook/gyrocompass.toml"), {.of = {"rotor"}});
///     found.tensor(0, 0);            // about the mass centre, along the body's own axes
///     found.principal[0].moment;
///
/// Steiner's theorem: I_P = I_C + m (d·d E − d dᵀ), with d from P to the mass centre.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "alembert/base/rotation.hpp"
#include "analysis/state/prepared.hpp"
#include "program/lower/start.hpp"

namespace alembert {

struct InertiaOptions {
    std::vector<std::string> of = {};  ///< bodies and particles; if empty, all of the scene
    std::string about = {};            ///< a point, particle or body; if empty, the common mass centre
    Overrides at = {};                 ///< the state and parameters for the numbers, as with `--at`
};

struct PrincipalMoment {
    double moment = 0;
    std::array<double, 3> axis{};
};

struct SceneInertia : Prepared {
    std::vector<std::string> of = {};
    std::string about = {};   ///< if empty, the mass centre
    std::string along = "N";  ///< the frame along whose axes the tensor is given; for a single body, its own
    double mass = 0;
    std::array<double, 3> centre{};  ///< along N, from O
    Matrix3<double> tensor = Matrix3<double>::Zero();
    std::vector<PrincipalMoment> principal = {};  ///< ascending, along the same axes
    /// The same in symbols, if they are short; the products of inertia are given as elements of the tensor.
    std::optional<std::string> mass_text = {};
    std::array<std::optional<std::string>, 3> centre_text = {};
    std::array<std::array<std::optional<std::string>, 3>, 3> tensor_text = {};
};

/// Throws what `prepared` throws, and ModelError for unknown names and for a scene without bodies and particles.
SceneInertia inertia(Scene scene, const InertiaOptions& options = {});

}  // namespace alembert
