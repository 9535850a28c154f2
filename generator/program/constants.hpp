// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Sums of parameters without terms that cancel: z + (A − C − z) is A − C.
///
/// A sum inside a sum is taken apart where the result has no more terms than before; where it is shared and
/// nothing cancels, it stays.

#include "program/program.hpp"

namespace alembert {

Program with_simple_constants(const Program& program);

}  // namespace alembert
