// SPDX-License-Identifier: MIT
#pragma once

/// Slips of students, made on right equations as text.
///
///     for (const StudentSlip& slip : slips_of(scene, {"m*l*theta'' + m*g*sin(theta) = 0"}, 1, 0, random, 3))
///         slip.kind, slip.equation           // "swapped_trig", "m*l*theta'' + m*g*cos(theta) = 0"
///
/// Kinds as in commands.md. Whether a slip is really wrong is not tested here. Changes that could also be another
/// kind are left out: the sign inside sin(a−b) is also that of its term; a dropped summand of m1+m2 is also a
/// factor; a doubled term is a factor 2; and a whole left side is never dropped.

#include <random>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace alembert::test {

struct StudentSlip {
    std::string kind, equation;
};

/// Slips made on equation `k` of `right`, whose first `rows` are the equations of motion; these provide forces for
/// the wrong row. At most `each` of a kind.
std::vector<StudentSlip> slips_of(const Scene& scene, const std::vector<std::string>& right, std::size_t rows,
                                  std::size_t k, std::mt19937& random, std::size_t each);

}  // namespace alembert::test
