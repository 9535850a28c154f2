// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Points at which square roots exist. A random value is a square modulo the prime for half of the points, and
/// twenty values are all squares for one point in a million. Therefore variables are drawn one after the other,
/// each until the roots exist for which it is the last missing variable. A body among n others then takes 2ⁿ draws
/// instead of 2^(n²/2).
///
///     const QuadraticResiduePoints usable({{&program, roots}}, {});
///     if (const auto point = usable.at({.seed = 7})) evaluate_mod(program, *point, roots);
///
/// Every drawn value is uniformly distributed among those that the conditions allow; ModularValues::conditions
/// counts the conditions.

#include <set>
#include <span>
#include <vector>

#include "program/modular.hpp"

namespace alembert {

/// The largest k such that a half to the k-th divides a coefficient in an angle that the roots need: 3 for
/// sin(0.375 t). Multiples of π do not count.
int halvings(const Program& program, std::span<const int> roots);

class QuadraticResiduePoints {
public:
    struct Part {
        const Program* program;
        std::vector<int> roots;
    };
    using Key = std::pair<Variable::Kind, int>;
    /// `solved` are variables that get their values later; whether roots with them exist is left to chance. The
    /// programs must outlive this object.
    QuadraticResiduePoints(const std::vector<Part>& parts, const std::set<Key>& solved);

    /// The point with new values for some variables. Nothing if these were not found in some thousand draws, or if
    /// some root has no free variable.
    std::optional<ModularPoint> at(ModularPoint point) const;

private:
    struct Draw {
        Key key;
        std::vector<Part> decides;  ///< the nodes with square roots for which the variable is the last missing one
    };
    std::vector<Draw> draws_;
};

}  // namespace alembert
