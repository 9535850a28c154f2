// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Products that were written without blanks: mgl is m·g·l, ml² is m·l², and mglsinθ ends with a sine, where the
/// scene has the letters and nothing is called mgl.
///
///     written = with_products(std::move(written), letters);

#include "check/derivation/letters.hpp"
#include "check/written/read.hpp"

namespace alembert {

Written with_products(Written written, const Letters& letters);

}  // namespace alembert
