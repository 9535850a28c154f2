// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The functions of the expression language: how many arguments, of what, giving what.

#include <string_view>

namespace alembert {

struct Function {
    enum class Takes { scalars, vectors, points, frames };
    std::string_view name;
    int least, most;  ///< number of arguments
    Takes takes;
    bool gives_vector;
    std::string_view usage;  ///< as a hint shows it
    int order = 0;           ///< of the geometry: how many times the coordinates are differentiated
};

/// Null where there is no such function.
const Function* find_function(std::string_view name);

/// Functions of numbers keep their names for themselves. Those of the geometry (omega, ex, pos …) are functions
/// only before a parenthesis; elsewhere the name is free for a parameter, a coordinate or a definition.
bool is_reserved_function(std::string_view name);

}  // namespace alembert
