// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A file of claims: one equation a line, `#` comments, and lines that begin with a word.
///
///     unknowns lambda1 lambda2        what the claims leave open, the same in all that follow
///     m*xC'' = lambda1*tan(phi)
///     constants c
///     m*xC'^2 + J*phi'^2 = c
///     rest | impact | motion          what the claims that follow speak of
///     sticking slope                  of the motion while this friction sticks; without names, all of them
///     closed wall                     of the motion while this contact is closed; without names, all of them
///     where lambda_wall > 0           this is assumed; without an inequality, nothing is any more

#include "scene/scene.hpp"

namespace alembert {

/// The scene with the file's claims in place of its own. Its file and text become those of the claims, for
/// messages. Throws SceneError, with the line, for anything that cannot be read.
Scene with_claims(Scene scene, const std::string& file);

/// The same from a text in memory; `file` is only the name that messages give it.
Scene with_claims(Scene scene, std::string text, std::string file);

}  // namespace alembert
