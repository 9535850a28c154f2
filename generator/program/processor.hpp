// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What the generator assumes about the processor and the compiler of its code, with the measurements behind these
/// assumptions. They do not change any result; they decide which form is taken, in which order statements stand,
/// and where a function is cut. They hold for x86-64 processors from Haswell and Zen on, and g++ 12 with -O2.

#include <cstddef>

namespace alembert::processor {

// Cycles from the arguments to the value (Fog, Instruction tables).
constexpr int step = 4;  ///< a multiplication, an addition, or both fused
constexpr int division = 14;
constexpr int function = 40;  ///< sine and cosine by the emitted polynomials, or a call of libm
constexpr int units = 2;      ///< number of floating-point units; each begins one operation per cycle

/// Cycles of a right-hand side from its operations, functions and longest chain; fitted to tests/bench/rhs.sh.
constexpr double time_of(int operations, int functions, int chain) {
    return 0.36 * operations + 3 * functions + 0.65 * chain;
}

// The order of statements (codegen/emit/register_order.hpp).
constexpr int registers = 30;  ///< values that stay in registers; there are 32 registers with AVX-512, and by
                               ///< renaming about as many without
constexpr double fused =
    0.6;  ///< instructions for each operation: many products are added in the same instruction
constexpr double look_ahead = 12;  ///< cycles of independent work that a processor finds without help
constexpr std::size_t most_ordered =
    20000;  ///< the most statements; for more, the search for an order takes longer than compiling
constexpr int most_steps = 4;  ///< operations that wait for each other in one statement

// Vectors.
/// Doubles in a vector of 512 bits, or in two of 256 bits if there are no wider ones.
constexpr std::size_t lanes = 8;
constexpr std::size_t widest_sincos = 8;  ///< angles whose sines the emitted `sincos` takes at once

// Taylor coefficients (emit/taylor). Cycles in the chain from one order to the next:
constexpr double packed = 16;           ///< for a value that passes through a vector and memory
constexpr double gathered = 15;         ///< for a sum of products over all lower orders
constexpr double solved = 12;           ///< for each unknown of the linear system
constexpr int orders_to_settle = 12;    ///< orders after which these times repeat from order to order
constexpr std::size_t least_lanes = 4;  ///< the fewest lanes of a vector for which copying pays
constexpr std::size_t most_straight =
    250;  ///< operations per order up to which straight-line code for all orders is faster
constexpr std::size_t most_edges = 40;  ///< the most products whose first and last terms are added one by one
/// The cost of an operation per order, and of eight products side by side per square of the order, in units of the
/// time that a step takes besides its series. Measured on chains, planets and a governor.
constexpr double operation_cost = 0.0008, product_cost = 0.0055;
/// By machine code in memory, an order takes this and more for each operation; fitted to
/// tests/bench/memory_code.sh.
constexpr double order_in_memory = 0.05, operation_in_memory = 0.00125;

// Compile times. The time of g++ grows with the square of a function's length from some thousand statements on.
/// Statements; a longer function is written in parts and then takes 17 % longer to run.
constexpr std::size_t longest_function = 6000;
constexpr std::size_t part_length = 400;  ///< statements in each part
constexpr int most_in_packs = 1000;  ///< the most operations of M and f; for more, compiling their packs takes a
                                     ///< second, although no integrator uses packed M and f

}  // namespace alembert::processor
