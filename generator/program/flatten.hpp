// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Sums of sums as one: a − (b + c·d) becomes a − b − c·d, where nobody else uses the sum inside.
///
/// A recursion adds two things at a time. Written as one sum, every product in it is a fused multiply-add, and
/// what comes last can be added last.

#include "program/program.hpp"

namespace alembert {

Program flattened(const Program& program);

}  // namespace alembert
