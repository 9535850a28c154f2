// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The dimensions that the language gives to the values of a scene.
///
///     for (const ValueMeaning& meaning : meanings_of(scene, dimensions))
///         meaning.value, meaning.dimension, meaning.what;      // "l*sin(q)", m, "the position of 'P'"

#include <string>
#include <vector>

#include "scene/dimensions.hpp"

namespace alembert {

struct ValueMeaning {
    const Expression* value;  ///< in the scene
    Dimension dimension;
    std::string what;  ///< "the mass of 'P'", in the language of the reader
};

/// Positions, masses, moments of inertia, angles, gravity, forces, torques, stiffnesses, dampings, energies,
/// times, forces along coordinates with a unit. Energies are in J beside masses; by themselves they may have been
/// divided by a constant, which all share. The scene must outlive the result.
std::vector<ValueMeaning> meanings_of(const Scene& scene, Dimensions& dimensions);

/// Force times length.
const Dimension& energy_dimension();

}  // namespace alembert
