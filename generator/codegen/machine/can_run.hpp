// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Whether there is machine code in memory: on x86-64 with AVX2 and FMA, where xbyak was there for the build.
///
///     if (can_run()) …       // one system, and packs of as many numbers as lanes_of_processor() says
///     if (can_run(8)) …      // packs of eight, which take AVX-512

namespace alembert::machine {

bool can_run(int lanes = 1);

/// How many numbers a register of the code for eight systems holds: 8 with AVX-512, else 4. Eight systems are two
/// packs of four then.
int lanes_of_processor();

/// How many the code may use: 16, with AVX-512 32.
int registers_of_processor();

}  // namespace alembert::machine
