// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Merges sums of sums: a − (b + c·d) becomes a − b − c·d, if the inner sum is not used elsewhere.
///
/// A recursion adds two values at a time. In a single sum every product becomes a fused multiply-add, and the
/// value that is ready last can be added last.

#include "program/program.hpp"

namespace alembert {

Program flattened(const Program& program);

}  // namespace alembert
