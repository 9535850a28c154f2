// SPDX-License-Identifier: MIT
#pragma once

/// Results of machine code in memory, compared with the interpreter of the same program.
///
///     const Expected expected(program, state);
///     Arrays out;  …                                   // "rate" and its values
///     CHECK(differences(right_hand_side(program, words), out, expected) == 0);

#include <map>
#include <string>
#include <vector>

#include "codegen/emit/solver_functions.hpp"
#include "program/interpret.hpp"

namespace alembert::test {

/// The arrays of a function by their names.
using Arrays = std::map<std::string, std::vector<double>>;

/// The values of all nodes and what rounding may do to them.
struct Expected {
    Expected(const Program& program, const State<double>& state);
    std::vector<double> value, error;
};

/// The number of results that differ by more than rounding explains.
int differences(const FunctionTask& task, const Arrays& arrays, const Expected& expected);

/// How many values of an array the function writes, at least one.
std::size_t room(const FunctionTask& task, const std::string& array);

}  // namespace alembert::test
