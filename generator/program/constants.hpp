// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Sums of parameters.
///
///     with_simple_constants(program)           // z + (A − C − z) is A − C
///     without_swallowed_constants(program)     // (2k − m g) − 2k s is 2k (1 − s) − m g

#include "program/program.hpp"

namespace alembert {

/// Simplifies sums in which terms cancel. A sum inside a sum is expanded if the result has no more terms than
/// before. It is kept if it is shared and nothing cancels.
Program with_simple_constants(const Program& program);

/// Takes the largest term out of a sum of parameters, if a smaller one would lose digits in it for the whole run,
/// and joins it to the term of the state with the same factor. If k = 8e5 and m g = 30, then 2k − m g is rounded
/// to 1e-10, which is 4e-12 of the weight: an error that is the same at every step. In 2k (1 − s) − m g, where
/// the processor fuses multiplication and addition, one rounding remains, which changes with the state. It takes
/// at most one more operation for each such sum. The sizes are those at the parameters' values.
Program without_swallowed_constants(const Program& program);

}  // namespace alembert
