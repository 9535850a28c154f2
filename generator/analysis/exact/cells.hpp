// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The cells into which absolute values, signs, smaller and larger values cut the states of a mechanism.
///
///     const Cells cells(program, roots);               // of max(0, -x - 1/20): one side, x + 1/20
///     cells.of(values)                                 // 1 where it is positive, 0 where it is negative
///
/// A side is an expression on whose sign |·|, sign, min or max depends. In a cell every side has one sign, so that
/// all of these functions are smooth there, and exact arithmetic decides what holds. Modulo a prime, Legendre's
/// symbol takes the place of the sign: it multiplies as a sign does, and so a state modulo the prime belongs to a
/// cell; but it knows no order, and a cell that has such states need not have real ones.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "analysis/exact/real_values.hpp"
#include "program/modular.hpp"

namespace alembert {

/// Bit k: side k is positive.
using Cell = std::uint32_t;

class Cells {
public:
    static constexpr std::size_t most_sides = 20;

    /// Those of what `roots` need. Of a product each factor with an odd exponent is a side. Adds the differences
    /// of what min and max compare to the program, which must outlive it.
    Cells(Program& program, std::span<const int> roots);

    bool empty() const { return sides_.empty(); }
    /// The nodes whose signs count, in the same order in every run.
    const std::vector<int>& sides() const { return sides_; }

    /// The cell of a state at which the program has these values; nothing on a border.
    std::optional<Cell> of(const ModularValues& values) const;
    /// Nothing also where a side has no value.
    std::optional<Cell> of(const RealState& state) const;

private:
    void add(int node);

    const Program& program_;
    std::vector<int> sides_;
};

}  // namespace alembert
