// SPDX-License-Identifier: MIT
#include "machine_values.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "program/rounding.hpp"

namespace alembert::test {

Expected::Expected(const Program& program, const State<double>& state)
    : value(interpret<double>(program, state)), error(rounding_errors(program, state)) {}

// The sums of a program may be added in any order: each partial sum is at most the sum of all sizes, which are in
// `error` once, so that the number of terms bounds the ratio.
int differences(const FunctionTask& task, const Arrays& arrays, const Expected& expected) {
    constexpr double terms = 16;
    int count = 0;
    for (const FunctionResult& result : task.results)
        for (const std::size_t place : result.places) {
            const auto node = static_cast<std::size_t>(result.node);
            const double found = arrays.at(result.array).at(place), value = expected.value[node];
            const bool agree = std::isfinite(value) ? std::abs(found - value) <= terms * expected.error[node]
                                                    : !std::isfinite(found);
            if (agree) continue;
            MESSAGE(task.name << " " << result.array << "[" << place << "] = " << found << ", expected " << value
                              << " +- " << expected.error[node]);
            ++count;
        }
    return count;
}

std::size_t room(const FunctionTask& task, const std::string& array) {
    std::size_t size = 1;
    for (const FunctionResult& result : task.results)
        for (const std::size_t place : result.places)
            if (result.array == array) size = std::max(size, place + 1);
    return size;
}

}  // namespace alembert::test
