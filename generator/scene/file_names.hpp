// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The names that a scene file declares, found before it is read: expressions stand above the tables that declare
/// what is in them.

#include "scene/known_names.hpp"
#include "scene/toml.hpp"

namespace alembert {

KnownNames names_in(const toml::table& scene);

}  // namespace alembert
