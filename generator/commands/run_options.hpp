// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// How a motion is to be integrated, for the commands that integrate one.

#include "alembert/integrate.hpp"
#include "commands/method.hpp"

namespace alembert {

/// The scene's wishes, those of the command line first.
Options options_of(const Request& request, const MethodChoice& choice, const Start& start);

}  // namespace alembert
