// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Fractions as plain TeX writes them.

#include "check/written/tokens.hpp"

namespace alembert {

/// {A \over B} becomes \frac{A}{B}, and \partial{\dot q} becomes \partial \dot q.
std::vector<WrittenToken> with_fractions(std::vector<WrittenToken> tokens);

}  // namespace alembert
