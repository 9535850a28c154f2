// SPDX-License-Identifier: MIT
#pragma once

/// Numbers that are compared to within a tolerance.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace alembert::test {

/// To within `tolerance` of the largest value, or of 1.
inline void check_near(const std::vector<double>& one, const std::vector<double>& other,
                       double tolerance = 1e-10) {
    REQUIRE(one.size() == other.size());
    double size = 1;
    for (const double x : other) size = std::max(size, std::abs(x));
    for (std::size_t i = 0; i < one.size(); ++i) {
        CAPTURE(i);
        CHECK(std::abs(one[i] - other[i]) <= tolerance * size);
    }
}

}  // namespace alembert::test
