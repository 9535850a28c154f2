// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// One call of the program `alembert`.

#include <string>
#include <vector>

namespace alembert {

/// Does what the words after the program's name ask for: {"derive", "scene.toml", "--json"}. What a verb throws
/// becomes one message on standard error. Gives the exit code (docs/commands.md).
int command_line(std::vector<std::string> words);

}  // namespace alembert
