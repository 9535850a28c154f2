// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The value of an expression of numbers and parameters, for checks before there is a mechanism.
///
///     plain_number(shape.sizes[0], scene);      // -0.1 for "-r" with r = 0.1

#include <optional>

#include "scene/scene.hpp"

namespace alembert {

/// Nothing if it holds other names or functions, or is long.
std::optional<double> plain_number(const Expression& expression, const Scene& scene);

}  // namespace alembert
