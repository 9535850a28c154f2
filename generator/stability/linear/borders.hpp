// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Borders between states at which the equations follow different formulas: the knots of tables, and the zeros of
/// what signs, absolute values, smaller and larger values depend on.
///
///     const Borders borders(residuals.program, residuals.forcing);
///     borders.variables();               // on which the side of a border depends: x of max(0, x - 50)
///     borders.passed(one, other);        // how many borders lie between two states, at the least
///
/// What is far from a state, or between two states, is seen only by these: a force that is zero near all states at
/// which it was tried may act elsewhere.

#include <span>
#include <vector>

#include "stability/linear/tangent.hpp"

namespace alembert {

class Borders {
public:
    /// Those of what `roots` need. A table that is the same everywhere has none.
    /// `inputs` are those of Residuals, which an Instant gives.
    Borders(const Program& program, std::span<const int> roots, std::vector<int> inputs = {});

    bool empty() const { return sides_.empty() && arguments_.empty(); }
    std::vector<Variable> variables() const;

    /// Borders between the states, each function of the state taken as one that rises or falls on the way.
    long passed(const Instant<long double>& one, const Instant<long double>& other) const;

    /// Whether a coordinate can change by this much everywhere without another side or another part of a table.
    bool has_period(std::size_t coordinate, long double period, const Instant<long double>& at) const;

    /// An argument of a table: the node, and the places in which its pieces are looked at, one between any two
    /// knots and one beyond the ends, where there are values.
    struct Argument {
        int node;
        const TableAxis* axis;
        std::vector<double> middles, widths;
        double width;  ///< of a piece, on the average
    };
    const std::vector<Argument>& arguments() const { return arguments_; }
    /// The value of an argument and its derivatives by all coordinates and speeds.
    struct Slope {
        long double value = 0;
        std::vector<long double> by_q, by_u;
    };
    Slope slope(const Argument& argument, const Instant<long double>& at) const;

private:
    template <typename Real>
    State<Real> state_of(const Instant<long double>& at) const;
    std::vector<long double> values(const Instant<long double>& at) const;
    void add_table(int id);

    Program program_;
    std::vector<int> inputs_, sides_, needed_;
    std::vector<Argument> arguments_;
};

}  // namespace alembert
