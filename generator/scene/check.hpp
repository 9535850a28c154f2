// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Checks that need no algebra: every name is declared once and known where it is used, nothing is defined by
/// itself, every quantity depends only on what it may depend on, and vectors and scalars stand where they belong.

#include <vector>

#include "scene/looks.hpp"

namespace alembert {

/// The mistakes. What is not wrong but has no effect, or is hardly meant, is added to `warnings`.
std::vector<Diagnostic> check_scene(const Scene& scene, const Looks& looks, std::vector<Diagnostic>& warnings);

/// The same checks for the claims only, of a scene that has been read already.
std::vector<Diagnostic> check_claims(const Scene& scene);

}  // namespace alembert
