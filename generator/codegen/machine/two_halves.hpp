// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Eight systems by code for four.
///
///     write_function(code, lines);                                 // for four lanes, at `body`
///     code.align();
///     write_in_two_halves(code, body, 4);                          // a function of four arrays for eight systems

#include "codegen/machine/encoder.hpp"

namespace alembert::machine {

/// A function for eight systems that calls the one for four at `body` twice, with `arrays` pointers each time,
/// which for the second half begin four numbers later.
void write_in_two_halves(Encoder& code, std::size_t body, int arrays);

}  // namespace alembert::machine
