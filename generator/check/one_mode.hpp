// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The claims of a scene about motions in which the same friction sticks (check/check.hpp tells how they are
/// judged).
///
///     const Checked result = check_of_one_mode(scene, mechanism, sheets, "");

#include "check/check.hpp"

namespace alembert {

/// What sticks has become constraints of the scene (scene/sticking.hpp). The arguments are those of `check`.
Checked check_of_one_mode(const Scene& scene, const Mechanism& mechanism,
                          const std::shared_ptr<RootSheets>& sheets, const std::string& by);

/// The scene with these claims only.
Scene with_some_claims(Scene scene, const std::vector<std::size_t>& claims);

}  // namespace alembert
