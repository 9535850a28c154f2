// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Equations that are differentiated in place of a program's accelerations, because that takes fewer operations.
///
///     differentiated(program, {.perturbed = perturbed_tree(program, mechanism, equations, false)});

#include <map>
#include <vector>

#include "program/program.hpp"

namespace alembert {

struct Perturbed {
    Program program;           ///< the program whose accelerations are meant, with further nodes
    std::vector<int> outputs;  ///< nodes whose derivatives, at the held values, are those of the accelerations
    /// The variables that count as constants while the outputs are differentiated, each with the node of its
    /// value.
    std::map<int, int> held;
    std::vector<int> stages;  ///< for each node, when it is eliminated (partials.hpp)
};

}  // namespace alembert
