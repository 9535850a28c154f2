// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Points, from a scene or a file, become a tabulated function.
///
///     const PointRows rows = rows_in_text(text_of_file("drag.csv", most_point_bytes), 1);
///     const MadeTable made = table_of(rows, {.arguments = {"v"}});
///     if (!made.table) throw ModelError(made.mistake);   // "line 5: v is 2 and was 3 in the line before; …"

#include <memory>
#include <string>
#include <vector>

#include "alembert/base/tabulated_function.hpp"

namespace alembert {

constexpr std::size_t most_point_bytes = 32UL * 1024 * 1024, most_table_points = 500'000;

/// The fields of a line between commas or semicolons, or between blanks where there are none of these and
/// `at_blanks` is set; without blanks and quotes around them, a mark of byte order and what follows a #. None of a
/// line in which nothing else stands.
std::vector<std::string> fields_in_line(std::string line, bool at_blanks);

struct PointRow {
    std::vector<double> numbers;  ///< the arguments and the value
    int line = 0;                 ///< in the file, or the number of the point
};

struct PointRows {
    std::vector<PointRow> rows;
    std::string mistake = {};  ///< if it is not empty, there are no rows
    bool are_lines = false;    ///< of a file
};

/// Numbers with commas, semicolons or blanks between, a point in each line: the arguments, then the value. Or, of
/// two arguments, a map: the second argument's values in the first line, behind a field that is no number, and in
/// each further line the first argument and the values. Empty lines and what follows a # are left out, and so is a
/// first line of names.
PointRows rows_in_text(const std::string& text, std::size_t arguments);

struct TableWishes {
    std::vector<std::string> arguments;  ///< their names, for messages
    TabulatedFunction::Interpolation interpolation = TabulatedFunction::Interpolation::linear;
    TabulatedFunction::Outside outside = TabulatedFunction::Outside::error;
    std::vector<double> periods = {};  ///< of each argument, 0 for none
    std::vector<double> sizes = {};  ///< of the units of the arguments and of the value; 1 where they are missing
};

struct MadeTable {
    std::shared_ptr<const TabulatedFunction> table;  ///< null if there is a mistake
    std::string mistake = {};
    std::size_t row = 0;  ///< which of the rows has it
};

/// Of one argument the points ascend; of two they are all of a grid, in any order.
MadeTable table_of(PointRows rows, const TableWishes& wishes);

}  // namespace alembert
