// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What the generator assumes about the processor and the compiler that its code meets, with the measurements
/// behind it. Nothing here changes a result: these numbers decide which form is taken, in which order statements
/// stand, and where a function is cut. They hold for x86-64 processors from Haswell and Zen on; g++ 12 with -O2.

#include <cstddef>

namespace alembert::processor {

// Cycles from the arguments to the value (Fog, Instruction tables).
constexpr int step = 4;  ///< a multiplication, an addition, or both fused
constexpr int division = 14;
constexpr int function = 40;  ///< sine and cosine by the emitted polynomials, or a call of libm
constexpr int units = 2;      ///< for floating point, each begins one operation a cycle

/// Cycles of a right-hand side from its operations, functions and longest chain; fitted to tests/bench/rhs.sh.
constexpr double time_of(int operations, int functions, int chain) {
    return 0.36 * operations + 3 * functions + 0.65 * chain;
}

// The order of statements (emit/register_order.hpp).
constexpr int registers =
    30;  ///< values that stay in registers, of 32 with AVX-512 and, renamed, about as many without
constexpr double fused =
    0.6;  ///< instructions for each operation: many products are added in the same instruction
constexpr double look_ahead = 12;  ///< cycles of independent work that a processor finds by itself
constexpr std::size_t most_ordered =
    20000;                     ///< statements; beyond, the search for an order takes longer than compiling
constexpr int most_steps = 4;  ///< operations that wait for each other in one statement

// Vectors.
constexpr std::size_t lanes = 8;  ///< doubles in a vector of 512 bits; two of 256 where there are no wider ones
constexpr std::size_t widest_sincos = 8;  ///< angles whose sines the emitted `sincos` takes at once

// Taylor coefficients (emit/taylor). Chains of cycles from order to order:
constexpr double packed = 16;           ///< a value through a vector and memory
constexpr double gathered = 15;         ///< a sum of products over all lower orders
constexpr double solved = 12;           ///< each unknown of the linear system
constexpr int orders_to_settle = 12;    ///< after which these times repeat from order to order
constexpr std::size_t least_lanes = 4;  ///< of a vector that is worth its copies
constexpr std::size_t most_straight =
    250;  ///< operations at an order, up to which straight-line code for all orders is faster
constexpr std::size_t most_edges = 40;  ///< products whose first and last terms are added one by one
/// Cost of an operation at each order, and of eight products beside each other over the square of the order; 1 is
/// what a step takes beside its series. Measured on chains, planets and a governor.
constexpr double operation_cost = 0.0008, product_cost = 0.0055;

// What a compiler takes. The time of g++ grows with the square of a function's length from some thousand
// statements on.
constexpr std::size_t longest_function = 6000;  ///< statements; in parts, a function takes 17 % longer to run
constexpr std::size_t part_length = 400;        ///< statements
constexpr int most_in_packs =
    1000;  ///< operations of M and f; beyond, compiling their packs takes a second, and nobody steps by these

}  // namespace alembert::processor
