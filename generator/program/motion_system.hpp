// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The linear system K (u', −λ) = b of a program, with K = [M Aᵀ; A 0] and b = (f, γ). Where constraints that
/// follow from others are tied to these (program/tie.hpp), their rows and γ follow, and −κE stands in place of 0.
///
///     const MotionSystem system = motion_system(program);  // with speeds_of(program) speeds u
///     solve_for_sides(program, system.K, {system.b}, system.speeds);

#include <cstddef>
#include <vector>

#include "program/program.hpp"

namespace alembert {

struct MotionSystem {
    std::vector<int> K;  ///< nodes of the lower triangle, row by row
    std::vector<int> b;
    int speeds = 0;  ///< the number of u', which come first; the multipliers follow

    int size() const { return static_cast<int>(b.size()); }
    int entry(int i, int j) const {
        return i < j ? entry(j, i) : K[static_cast<std::size_t>(i * (i + 1) / 2 + j)];
    }
};

/// The number of speeds u in a state: the program's own, or the rates of the coordinates.
std::size_t speeds_of(const Program& program);

/// The program must have its mass matrix (Group::mass); zeros are added to it where K has them.
MotionSystem motion_system(Program& program);

/// Σ_j K_ij z_j over the given z, the first unknowns.
int row_times(Program& program, const MotionSystem& system, int i, const std::vector<int>& z);

}  // namespace alembert
