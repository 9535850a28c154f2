// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Simplifies sums of parameters in which terms cancel: z + (A − C − z) is A − C.
///
/// A sum inside a sum is expanded if the result has no more terms than before. It is kept if it is shared and
/// nothing cancels.

#include "program/program.hpp"

namespace alembert {

Program with_simple_constants(const Program& program);

}  // namespace alembert
