// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Functions by points in emitted code: their numbers, and a function for each derivative that the program calls.
///
///     table_functions(program, CodeLanguage::c);     // "static const double table0_f_at[] = {0, 1, 3}; …"
///     table_call(program, node);                     // "table0_f_1": the first derivative of f

#include <functional>
#include <string>

#include "codegen/emit/statement.hpp"
#include "program/program.hpp"

namespace alembert {

/// Empty if no root of the program needs one. Throws ModelError for a function that the scene leaves open.
std::string table_functions(const Program& program, CodeLanguage language);

/// How a language writes the parts of a polynomial.
struct TableWords {
    std::function<std::string(int)> coefficient;  ///< of the piece: "c[3]"
    std::function<std::string(int)> number;       ///< "6"
};

/// The value of a call from u1, u2 and the coefficients; beyond the ends along the line, by the slopes there, with
/// x for the argument and y for what is held back.
std::string table_value(const TabulatedFunction& table, const Program::TableCall& call, const TableWords& words);

/// What the names of a table's numbers and functions begin with: "table0_f".
std::string table_base(const Program& program, const Node& node);

/// The name of the function to call with the node's arguments, and with the numbers of intervals behind them where
/// they are held. The position of the table makes it differ from all others; names of scenes that begin so get
/// another letter (Names).
std::string table_call(const Program& program, const Node& node);

}  // namespace alembert
