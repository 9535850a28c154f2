// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A rolling contact cut open, which gives the whole force there: its rows and their multipliers say nothing of
/// the direction in which the place of the body, by its coordinates, obeys the contact already.
///
///     const Scene released = with_rolling_released(scene, rule);       // three more coordinates at the end
///     const Mechanism m = build(released);
///     if (const auto n = normal_of(m, {.rolling = 0, .scene = &scene, .first = 5})) …
///
/// The body, and all that is placed relative to it, gets three shifts c along N. Held at zero, they demand the
/// force of the contact, F = T-terms(c) − Q(c) − A_cᵀλ over all other constraints. That is all of it only if
/// nothing else holds the body. So the masses whose places depend on its coordinates have to be shifted with it,
/// as well as the points at which forces and springs act.

#include <optional>
#include <string>

#include "model/mechanism.hpp"

namespace alembert {

/// Whether the scene places the body of this rolling by itself, and says what its forces are.
bool is_releasable(const Scene& scene, const RollingRule& rule);

/// The scene with three shifts c of the body, and with a particle without mass at the contact, each the last of
/// its kind.
Scene with_rolling_released(Scene scene, const RollingRule& rule);

struct ReleasedRolling {
    int rolling = 0;               ///< position in Mechanism::rollings
    const Scene* scene = nullptr;  ///< as it was given
    int coordinates = 0;           ///< the number of its coordinates
    int first = 0;                 ///< position of the first shift in the coordinates of the released mechanism
    int contact = 0;               ///< position of the particle at the contact in the particles of that scene
};

/// The unit vector along N from the ground into the body; the rows of `released` are along N. Nothing if the force
/// along it is not determined, or if it is that of a row.
std::optional<Vector3> normal_of(const Mechanism& given, const Mechanism& released, const ReleasedRolling& at);

/// "lambda_wheel_normal".
std::string normal_reaction_of(const RollingRule& rule);

}  // namespace alembert
