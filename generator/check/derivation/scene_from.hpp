// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A scene from a derivation's own first lines, for people who have none: its coordinates are the letters that
/// carry dots, its parameters the other letters, its energies those that the derivation states.
///
///     const DraftedScene drafted = scene_from(read_derivation(text, "homework.tex"));
///     parse_scene(drafted.text, "homework.toml");
///
/// Numbers are assumed; `assumed` says which, and how each letter was understood.

#include <string>
#include <vector>

#include "check/written/read.hpp"

namespace alembert {

struct DraftedScene {
    std::string text;                  ///< in the language of scenes, with what was assumed as comments
    std::vector<std::string> assumed;  ///< in words
};

/// Throws ModelError for a derivation that states no energies, or none from which a scene can be made.
DraftedScene scene_from(const Written& written);

}  // namespace alembert
