// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Sums in which the term that is ready last is added last.
///
///     const ScheduledSum sum({.outer = "per_z", .inner = "per_k",
///                       .terms = {{.late = "gathered[0]", .ready = {.node = 7, .before = 2, .delay = 15},
///                       .is_inner = true},
///                                 {.weight = "Real(2)", .factor = "x_one", .late = "z_before", .ready = {3, 1},
///                                 .is_inner = true},
///                                 {.factor = "x_0", .late = "y", .ready = {5, 0}}}});
///     sum.value(times).text        // "per_z * (per_k * (gathered[0] + Real(2) * x_one * z_before) + x_0 * y)"
///
/// The coefficients of a series wait for each other, order after order, in a chain of additions and
/// multiplications: in any other order, a sum would wait for its latest term and then still have to add others.

#include <array>
#include <string>
#include <vector>

#include "codegen/emit/expression.hpp"

namespace alembert {

/// The time in cycles at which each node's coefficient is ready: that of this order, of the order before, and of
/// two orders before.
using Times = std::array<std::vector<double>, 3>;

/// A time: `delay` cycles after the coefficient of a node, `before` orders ago, is ready.
struct Moment {
    int node = 0, before = 0;
    double delay = 0;
};

struct SumTerm {
    CodeExpression weight = {};  ///< a factor that terms have in common; empty for 1
    CodeExpression factor = {};  ///< a product that is ready early; empty for 1
    CodeExpression late = {};
    Moment ready = {};  ///< when `late` is ready
    bool is_inner = false;
    bool negative = false;
};

/// outer · (inner · Σ inner terms + Σ other terms); both factors are products that are ready early; empty for 1.
struct SumParts {
    CodeExpression outer = {}, inner = {};
    std::vector<SumTerm> terms = {};
};

class ScheduledSum {
public:
    explicit ScheduledSum(const SumParts& sum);

    double ready(const Times& times) const;
    CodeExpression value(const Times& times) const;

private:
    /// All terms with the same factor of the same late value.
    struct Group {
        CodeExpression factor, late;
        Moment ready;
        bool is_inner;
        std::vector<Piece> weights;
    };
    std::vector<int> in_order_of(const Times& times) const;
    static std::vector<Piece> together(const std::vector<const Group*>& groups);
    static Piece weight_of(const Group& group);

    CodeExpression outer_, inner_;
    std::vector<Group> groups_;
};

}  // namespace alembert
