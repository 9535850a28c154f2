// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// On what the values of a unit depend.
///
///     const Dependence dependence(model);
///     dependence.of(model.program.nodes_of(Group::energy)[0]).contains({Variable::Kind::coordinate, 0});

#include <set>
#include <utility>
#include <vector>

#include "simulate/fmu/unit_model.hpp"

namespace alembert {

class Dependence {
public:
    using Known = std::pair<Variable::Kind, int>;  ///< time, a coordinate, a rate (or speed) or a parameter

    /// The model must outlive it.
    explicit Dependence(const UnitModel& model);

    /// By the graph of the program; accelerations count as what they depend on.
    std::set<Known> of(int node) const;

    /// Whether the equations, energies, outputs or events contain this derivative (order 1 or 2) of an input:
    /// whether their values at the start change with it.
    bool uses_rate(std::size_t input, std::size_t order) const;

private:
    const UnitModel& model_;
    std::vector<std::set<Known>> accelerations_;
};

}  // namespace alembert
