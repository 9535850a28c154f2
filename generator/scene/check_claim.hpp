// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What a claim may contain: names that it leaves open, forces of friction that sticks, a state near which it
/// holds.
///
///     check_claim(scene.claims[0], {scene, names, quantities, diagnostics});

#include "scene/quantity.hpp"

namespace alembert {

/// What is known of a scene when its parts are checked.
struct CheckedParts {
    const Scene& scene;
    const NameSpaces& names;
    Quantities& quantities;  ///< with the definitions described
    std::vector<Diagnostic>& diagnostics;
};

/// Adds the mistakes in the claim to the diagnostics.
void check_claim(const Claim& claim, const CheckedParts& of);

}  // namespace alembert
