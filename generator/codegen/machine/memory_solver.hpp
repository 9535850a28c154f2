// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A Program as machine code in memory, ready in milliseconds and without a compiler.
///
///     if (const std::optional<MemorySolver> solver = memory_solver(program)) {
///         const std::vector<double> par = prepared(solver->module);
///         solver->module.table().rhs(t, state, par.data(), rate);
///     }
///
/// The tables are those of the file that `emit` writes of the same program: the functions have the same arguments,
/// and `par` the same constants. Their values differ in the last digits, because a compiler orders and fuses the
/// operations in its own way. Every result is written as soon as it is known, so that the arrays of results must
/// not overlap those that are given.
///
/// Nothing is returned where the processor is not of the kind x86-64 with AVX2 and FMA, where the system does not
/// allow memory to be made executable, or where a function would need more than a megabyte of the stack.

#include <functional>
#include <optional>

#include "alembert/native/module.hpp"
#include "program/program.hpp"

namespace alembert {

struct MemorySolver {
    Module module;
    /// From now on, the tables of `module` have the functions of a module that was compiled from the same program.
    std::function<void(const Module& compiled)> go_over;
};

/// `with_packs`: with the functions for eight systems at once, as a file that is emitted with `--batch`. Less than
/// the processor has may be used: `registers`, 16 or 32 of them, with `lanes` numbers, 4 or 8, in those of packs.
/// Throws ModelError as `emit` does.
std::optional<MemorySolver> memory_solver(const Program& program, bool with_packs = false,
                                          std::optional<int> registers = {}, std::optional<int> lanes = {});

}  // namespace alembert
