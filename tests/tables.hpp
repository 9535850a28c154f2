// SPDX-License-Identifier: MIT
#pragma once

/// Tables that the program has written as CSV.
///
///     column(file, "theta").back();      // at the end of the motion

#include <doctest/doctest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace alembert::test {

/// The rows of numbers below the names.
inline std::vector<std::vector<double>> table_of(const std::string& file) {
    std::ifstream in(file);
    std::vector<std::vector<double>> rows;
    std::string line;
    std::getline(in, line);
    while (std::getline(in, line)) {
        std::vector<double> row;
        std::istringstream cells(line);
        for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::stod(cell));
        rows.push_back(row);
    }
    return rows;
}

/// The numbers below this name.
inline std::vector<double> column(const std::string& file, const std::string& name) {
    std::ifstream stream(file);
    std::string line, cell;
    std::getline(stream, line);
    std::istringstream names(line);
    int k = 0;
    while (std::getline(names, cell, ',') && cell != name) ++k;
    CAPTURE(name);
    REQUIRE(cell == name);
    std::vector<double> result;
    while (std::getline(stream, line)) {
        std::istringstream cells(line);
        for (int i = 0; i <= k; ++i) std::getline(cells, cell, ',');
        result.push_back(std::stod(cell));
    }
    return result;
}

}  // namespace alembert::test
