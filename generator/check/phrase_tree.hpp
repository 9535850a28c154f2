// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A phrase as a tree of the scene language: that of its text, without a place in it.
///
///     tree_of(readable(f))        // the same tree as that of parse_expression(text(readable(f)), …)

#include "algebra/notation/phrase.hpp"
#include "scene/expression.hpp"

namespace alembert {

/// Its nodes have the offset −1.
TreePtr tree_of(const Phrase& phrase);

}  // namespace alembert
