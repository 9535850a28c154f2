// SPDX-License-Identifier: MIT
#pragma once

/// Right-hand sides as one would write them by hand for speed, for verner_peer.cpp: the numbers of the scenes of
/// these names in scenes/benchmark/, in the same order of coordinates.

#include <array>
#include <cmath>
#include <cstddef>

namespace verner_peer {

struct DoublePendulum {
    static constexpr int size = 4;
    static constexpr double end = 10;
    std::array<double, 4> start() const { return {2.0, 2.5, 0, 0}; }
    [[gnu::always_inline]] void operator()(double, const double* y, double* rate) const {
        constexpr double g = 9.81;
        double s1, c1, s2, c2;
        sincos(y[0], &s1, &c1);
        sincos(y[1], &s2, &c2);
        const double s = s1 * c2 - c1 * s2, c = c1 * c2 + s1 * s2, w1 = y[2] * y[2], w2 = y[3] * y[3];
        const double f1 = -s * w2 - 2 * g * s1, f2 = s * w1 - g * s2, d = 1 / (2 - c * c);
        rate[0] = y[2];
        rate[1] = y[3];
        rate[2] = (f1 - c * f2) * d;
        rate[3] = (2 * f2 - c * f1) * d;
    }
};

struct Kepler {
    static constexpr int size = 4;
    static constexpr double end = 62.8;
    std::array<double, 4> start() const { return {1 - 0.99, 0, 0, std::sqrt((1 + 0.99) / (1 - 0.99))}; }
    [[gnu::always_inline]] void operator()(double, const double* y, double* rate) const {
        const double square = y[0] * y[0] + y[1] * y[1], pull = -1 / (square * std::sqrt(square));
        rate[0] = y[2];
        rate[1] = y[3];
        rate[2] = pull * y[0];
        rate[3] = pull * y[1];
    }
};

/// Bodies that attract each other; `at(k, i)` is the place of coordinate k of body i among the coordinates. Roots
/// and quotients of four pairs are one instruction each where the processor has registers of four numbers.
template <int bodies, int dimensions, class At>
[[gnu::always_inline]] inline void attract(const double* y, double* rate, const std::array<double, bodies>& mass,
                                           At at) {
    using Four [[gnu::vector_size(32)]] = double;
    constexpr int pairs = bodies * (bodies - 1) / 2, n = bodies * dimensions;
    double apart[dimensions][pairs], square[(pairs + 3) / 4 * 4], pull[(pairs + 3) / 4 * 4];
    for (double& one : square) one = 1;
    int p = 0;
#pragma GCC unroll 8
    for (int i = 0; i < bodies; ++i)
#pragma GCC unroll 8
        for (int j = i + 1; j < bodies; ++j, ++p) {
            double sum = 0;
#pragma GCC unroll 3
            for (int k = 0; k < dimensions; ++k) {
                apart[k][p] = y[at(k, j)] - y[at(k, i)];
                sum += apart[k][p] * apart[k][p];
            }
            square[p] = sum;
        }
#pragma GCC unroll 8
    for (int q = 0; q < pairs; q += 4) {
        const Four of = {square[q], square[q + 1], square[q + 2], square[q + 3]};
#ifdef __AVX__
        const Four root = __builtin_ia32_sqrtpd256(of);
#else
        const Four root = {std::sqrt(of[0]), std::sqrt(of[1]), std::sqrt(of[2]), std::sqrt(of[3])};
#endif
        const Four all = 1 / (of * root);
#pragma GCC unroll 4
        for (int k = 0; k < 4; ++k) pull[q + k] = all[k];
    }
#pragma GCC unroll 32
    for (int i = 0; i < n; ++i) rate[i] = y[n + i];
    double force[n] = {};
    p = 0;
#pragma GCC unroll 8
    for (int i = 0; i < bodies; ++i)
#pragma GCC unroll 8
        for (int j = i + 1; j < bodies; ++j, ++p)
#pragma GCC unroll 3
            for (int k = 0; k < dimensions; ++k) {
                const double of_unit = pull[p] * apart[k][p];
                force[at(k, i)] += mass[static_cast<std::size_t>(j)] * of_unit;
                force[at(k, j)] -= mass[static_cast<std::size_t>(i)] * of_unit;
            }
#pragma GCC unroll 32
    for (int i = 0; i < n; ++i) rate[n + i] = force[i];
}

struct OuterSolarSystem {
    static constexpr int size = 36;
    static constexpr double end = 200000;
    std::array<double, 36> start() const {
        return {0,          0,           0,           -3.5023653,  -3.8169847,  -1.5507963,
                9.0755314,  -3.0458353,  -1.6483708,  8.310142,    -16.2901086, -7.2521278,
                11.4707666, -25.7294829, -10.8169456, -15.5387357, -25.2225594, -3.1902382,
                0,          0,           0,           0.00565429,  -0.00412490, -0.00190589,
                0.00168318, 0.00483525,  0.00192462,  0.00354178,  0.00137102,  0.00055029,
                0.00288930, 0.00114527,  0.00039677,  0.00276725,  -0.00170702, -0.00136504};
    }
    [[gnu::always_inline]] void operator()(double, const double* y, double* rate) const {
        constexpr double g = 2.95912208286e-4;
        constexpr std::array<double, 6> mass{g * 1.00000597682,      g * 0.000954786104043,  g * 0.000285583733151,
                                             g * 0.0000437273164546, g * 0.0000517759138449, g / 1.3e8};
        attract<6, 3>(y, rate, mass, [](int k, int i) { return 3 * i + k; });
    }
};

struct Pleiades {
    static constexpr int size = 28;
    static constexpr double end = 3;
    std::array<double, 28> start() const {
        return {3, 3, -1, -3, 2, -2, 2, 3, -3, 2, 0, 0, -4, 4, 0, 0, 0, 0, 0, 1.75, -1.5, 0, 0, 0, -1.25, 1, 0, 0};
    }
    [[gnu::always_inline]] void operator()(double, const double* y, double* rate) const {
        attract<7, 2>(y, rate, {1, 2, 3, 4, 5, 6, 7}, [](int k, int i) { return 7 * k + i; });
    }
};

}  // namespace verner_peer

#include "verner_andrews.hpp"
