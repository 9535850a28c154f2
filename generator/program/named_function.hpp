// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A function of the state that is emitted beside the right-hand side, with a name and only its own operations.
///
///     FunctionProgram gravity{.name = "gravity", .about = "…", .rows = 7, .program = program};
///     const NamedFunction in_solver = absorbed(solver, gravity);

#include <string>
#include <vector>

#include "program/program.hpp"

namespace alembert {

/// The values of a matrix, row by row; a vector has one column.
struct NamedFunction {
    std::string name, about;  ///< `about` is a sentence for the comment in the emitted file
    int rows = 0, columns = 1;
    std::vector<int> nodes = {};  ///< in the program to which it belongs
    Operations operations = {};
};

/// A function in a program of its own, whose roots of Group::function are its values.
struct FunctionProgram {
    std::string name, about;
    int rows = 0, columns = 1;
    Program program = {};
};

/// Adds the nodes and roots of `function` to a program of the same mechanism.
NamedFunction absorbed(Program& program, const FunctionProgram& function);

/// The program of `values` alone, as roots of Group::function, with as few operations as the rewritings of
/// share.hpp, flatten.hpp and constants.hpp reach.
Program with_values_only(Program program, const std::vector<int>& values);

}  // namespace alembert
