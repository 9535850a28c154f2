// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A scene whose inputs can be set while it runs.
///
///     const FreeInputs free = with_free_inputs(read_scene("scenes/textbook/cart_pole.toml"));
///     free.inputs[0].value;                        // "F_set_value": the parameter that holds F
///
/// Each input F(t) becomes s (F₀ + F₁ (t − τ) + F₂ (t − τ)²/2) + (1 − s) F(t) with parameters s, F₀, F₁, F₂ of its
/// own and τ of all. While s = 0 it is the scene's function; with s = 1 and τ = t it has the value F₀ and the
/// derivatives F₁, F₂. F and its two derivatives become outputs too, so that they can be shown.

#include <array>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace alembert {

struct FreeInput {
    std::string name, unit, about;
    std::string is_set = {};           ///< the name of the parameter s
    std::array<std::string, 3> given;  ///< of F₀, F₁, F₂
    std::array<std::string, 3> shown;  ///< of the outputs F, F', F''
};

struct FreeInputs {
    Scene scene;
    std::vector<FreeInput> inputs;
    std::string time;  ///< the name of the parameter τ; empty if there are no inputs
};

/// The new parameters stand after those of the scene, τ last.
FreeInputs with_free_inputs(Scene scene);

}  // namespace alembert
