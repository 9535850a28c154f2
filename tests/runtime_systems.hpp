// SPDX-License-Identifier: MIT
#pragma once

/// Systems that several tests of the integrators share.

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "alembert/ode/rhs.hpp"

namespace alembert::test {

inline const std::vector<double> pendulum_start = {2.0, 0.3};
/// An orbit of eccentricity 1/5 from the pericentre: the same after one turn of 2π, H = −1/2.
inline const std::vector<double> kepler_start = {0.8, 0, 0, std::sqrt(1.5)};

inline Rhs pendulum() {
    return make_rhs(2, [](double, const double* y, double* rate) {
        rate[0] = y[1];
        rate[1] = -std::sin(y[0]);
    });
}

inline double distance(std::span<const double> a, std::span<const double> b) {
    double worst = 0;
    for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, std::abs(a[i] - b[i]));
    return worst;
}

inline Rhs kepler() {
    return make_rhs(4, [](double, const double* y, double* rate) {
        const double r = std::hypot(y[0], y[1]);
        rate[0] = y[2];
        rate[1] = y[3];
        rate[2] = -y[0] / (r * r * r);
        rate[3] = -y[1] / (r * r * r);
    });
}

inline double kepler_energy(std::span<const double> y) {
    return (y[2] * y[2] + y[3] * y[3]) / 2 - 1 / std::hypot(y[0], y[1]);
}

}  // namespace alembert::test
