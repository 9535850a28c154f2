// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The functions of the expression language: the number and kind of their arguments and the kind of their value.

#include <string_view>

namespace alembert {

struct Function {
    enum class Takes { scalars, vectors, points, frames };
    std::string_view name;
    int least, most;  ///< number of arguments
    Takes takes;
    bool gives_vector;
    std::string_view usage;  ///< the call as hints show it
    int order = 0;           ///< of functions of the geometry: how often the coordinates are differentiated
};

/// Null if there is no such function.
const Function* find_function(std::string_view name);

/// The names of functions of numbers are reserved. Those of geometric functions (omega, ex, pos …) mean functions
/// only before a parenthesis; otherwise they may name a parameter, a coordinate or a definition.
bool is_reserved_function(std::string_view name);

}  // namespace alembert
