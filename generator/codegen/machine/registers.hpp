// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Writes the lines of a function as machine code.
///
///     Encoder code;
///     const std::size_t begin = code.getSize();
///     if (write_function(code, lines)) …      // the function begins at `begin`
///
/// The function is called as System V's ABI for x86-64 says: t in xmm0, the arrays in rdi, rsi, rdx, rcx, r8, r9.
/// With several lanes, the first of these registers has the address of the times, and the arrays have eight
/// numbers for each value, of which a function with four lanes takes the first four.

#include "codegen/machine/encoder.hpp"
#include "codegen/machine/lines.hpp"

namespace alembert::machine {

/// False, with an unusable rest of code, if the function would need too much room on the stack. Lines with sines
/// inside need `other`, where the same function with called sines begins: it is taken for large angles.
bool write_function(Encoder& code, const Lines& lines, std::size_t other = 0);

}  // namespace alembert::machine
