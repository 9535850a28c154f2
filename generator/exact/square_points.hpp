// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Points at which square roots exist. A random value is a square modulo the prime for half of the points, twenty
/// of them are squares for one point in a million. Variables are therefore drawn one after the other, each until
/// the roots that it is the last to decide exist: a body among n others takes 2ⁿ draws and not 2^(n²/2).
///
///     const SquarePoints usable({{&program, roots}}, {});
///     if (const auto point = usable.at({.seed = 7})) evaluate_mod(program, *point, roots);
///
/// Every drawn value is uniform among those that the conditions leave; ModularValues::conditions counts these.

#include <set>
#include <span>
#include <vector>

#include "program/modular.hpp"

namespace alembert {

/// The largest k such that a half to the k-th divides a coefficient in an angle that the roots need: 3 for
/// sin(0.375 t). Multiples of π are left aside.
int halvings(const Program& program, std::span<const int> roots);

class SquarePoints {
public:
    struct Part {
        const Program* program;
        std::vector<int> roots;
    };
    using Key = std::pair<Variable::Kind, int>;
    /// `solved`: variables that get their values later; roots that hold them are left to luck. The programs must
    /// outlive this.
    SquarePoints(const std::vector<Part>& parts, const std::set<Key>& solved);

    /// The point with values of its own for some variables; nothing where they were not found in some thousand
    /// draws, or some root has no variable that is free.
    std::optional<ModularPoint> at(ModularPoint point) const;

private:
    struct Draw {
        Key key;
        std::vector<Part> decides;  ///< nodes that are square roots
    };
    std::vector<Draw> draws_;
};

}  // namespace alembert
