// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The scene while contacts are closed. A closed contact is held like a constraint, gap = 0, with its multiplier
/// `lambda_NAME`, which is not negative as long as it lasts.
///
///     const Scene closed = with_closed_contacts(scene, {"wall"});

#include "scene/scene.hpp"

namespace alembert {

/// With constraints in place of the contacts of these names, which the scene has. Values at the start are guesses,
/// as the contacts need not be closed there.
Scene with_closed_contacts(Scene scene, const std::vector<std::string>& contacts);

/// The contacts that are closed according to a claim, in the order of the scene: those that it names at `closed`,
/// all if it names none, and those whose multiplier it assumes to be positive.
std::vector<std::string> closed_in(const Claim& claim, const Scene& scene);

}  // namespace alembert
