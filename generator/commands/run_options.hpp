// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// How a motion is to be integrated, for the commands that integrate one.

#include "alembert/integrate.hpp"
#include "commands/method.hpp"

namespace alembert {

/// The longest step allowed (s; 0: no bound): the command line's wish, else the scene's.
double longest_step(const Request& request, const Start& start);

/// The scene's wishes, those of the command line first. Throws ModelError for --max-step with a method that has a
/// fixed step.
Options options_of(const Request& request, const MethodChoice& choice, const Start& start);

}  // namespace alembert
