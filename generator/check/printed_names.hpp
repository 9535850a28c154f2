// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Names that `derive` gives, which claims may hold: u1 for a speed that the formalism chooses, and z1 for a
/// definition in equations beyond the readable size.
///
///     if (speaks_of_printed_names(scene)) names = printed_names(explained(derived).shown);

#include <string>
#include <utility>
#include <vector>

#include "analysis/derive/derivation.hpp"
#include "scene/scene.hpp"

namespace alembert {

/// Each with its value, in earlier ones.
using PrintedNames = std::vector<std::pair<std::string, Expression>>;

PrintedNames printed_names(const Derivation& shown);

/// N_wheel, F_x_hinge: reactions as `derive` shows them on request, where a claim of the scene speaks of one.
PrintedNames reaction_names(const Scene& scene);

/// Whether a claim of the scene holds a name of this form.
bool speaks_of_printed_names(const Scene& scene);

}  // namespace alembert
