// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The rows of a display, joined where one goes on with the other.

#include "check/written/tokens.hpp"

namespace alembert {

/// Takes away what only groups or colours: \left. and \right., \boxed around an equation, environments that set
/// equations under each other.
std::vector<WrittenToken> without_frames(std::vector<WrittenToken> tokens);

/// A row ends where the text has the end of a line between a = b and c = d, though \\ was lost there.
std::vector<WrittenToken> with_lost_rows(std::vector<WrittenToken> tokens, std::string_view text);

/// Each list is one chain of sides, or several between signs such as \implies. A row goes on with the row above if
/// it begins with = or, after &, with + or -, if that one ended with a sign, or if it has no relation itself and
/// begins with a sign. The & between two equations in a row of `align` becomes a space.
std::vector<std::vector<WrittenToken>> chains_of(const std::vector<WrittenToken>& tokens, bool joins_rows);

}  // namespace alembert
