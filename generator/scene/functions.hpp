// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The functions of the expression language: the number and kind of their arguments and the kind of their value.

#include <string_view>
#include <vector>

#include "scene/expression.hpp"

namespace alembert {

struct Function {
    /// `derivative`: a scalar, then by what it is differentiated and how often (derivative_steps).
    enum class Takes { scalars, vectors, points, frames, derivative };
    std::string_view name;
    int least, most;  ///< number of arguments
    Takes takes;
    bool gives_vector;
    std::string_view usage;  ///< the call as hints show it
    int order = 0;           ///< of functions of the geometry: how often the coordinates are differentiated
};

/// Null if there is no such function.
const Function* find_function(std::string_view name);

/// A step of diff(e, x, 2, y): twice by x, once by y. A number in place of the variable is the position of an
/// argument of a function of [functions].
struct DerivativeStep {
    TreePtr by;
    int times;
};
/// The steps of a call of diff, whose numbers are whole and positive (the parser has checked it).
std::vector<DerivativeStep> derivative_steps(const Tree& call);

/// The names of functions of numbers are reserved. Those of geometric functions (omega, ex, pos …) mean functions
/// only before a parenthesis; otherwise they may name a parameter, a coordinate or a definition.
bool is_reserved_function(std::string_view name);

}  // namespace alembert
