// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// One formula of a document, which may have many rows, becomes statements.

#include "check/written/read.hpp"
#include "check/written/tokens.hpp"

namespace alembert {

/// `joins_rows`: the rows of `multline` are one. The statements have no words but those of \text{…} in the
/// formula. A statement whose first side is missing (`= b`) has a null there: the last side of the statement
/// before it is meant.
std::vector<WrittenStatement> statements_of(std::vector<WrittenToken> tokens, bool joins_rows);

}  // namespace alembert
