// SPDX-License-Identifier: GPL-2.0-or-later
#include "run/samples.hpp"

#include <array>
#include <numeric>
#include <random>

#include "alembert/error.hpp"
#include "language/say.hpp"

namespace alembert {

namespace {

constexpr int bits = 32;  // of a coordinate of Sobol's points

/// A primitive polynomial x^s + a₁ x^(s−1) + … + 1, the digits of a in one number, and the first direction
/// numbers.
struct Direction {
    unsigned degree, a;
    std::array<unsigned, 7> m;
};

/// Of the dimensions from the second on.
constexpr std::array<Direction, 20> directions{{{1, 0, {1}},
                                                {2, 1, {1, 3}},
                                                {3, 1, {1, 3, 1}},
                                                {3, 2, {1, 1, 1}},
                                                {4, 1, {1, 1, 3, 3}},
                                                {4, 4, {1, 3, 5, 13}},
                                                {5, 2, {1, 1, 5, 5, 17}},
                                                {5, 4, {1, 1, 5, 5, 5}},
                                                {5, 7, {1, 1, 7, 11, 19}},
                                                {5, 11, {1, 1, 5, 1, 1}},
                                                {5, 13, {1, 1, 1, 3, 11}},
                                                {5, 14, {1, 3, 5, 5, 31}},
                                                {6, 1, {1, 3, 3, 9, 7, 49}},
                                                {6, 13, {1, 1, 1, 15, 21, 21}},
                                                {6, 16, {1, 3, 1, 13, 27, 49}},
                                                {6, 19, {1, 1, 1, 15, 7, 5}},
                                                {6, 22, {1, 3, 1, 15, 13, 25}},
                                                {6, 25, {1, 1, 5, 5, 19, 61}},
                                                {7, 1, {1, 3, 7, 11, 23, 15, 103}},
                                                {7, 4, {1, 3, 7, 13, 13, 15, 69}}}};

double fraction(std::mt19937_64& random) {
    return static_cast<double>(random() >> 11U) * 0x1p-53;
}

using DirectionNumbers = std::array<std::uint32_t, bits>;

DirectionNumbers numbers_of(std::size_t dimension) {
    DirectionNumbers v{};
    if (dimension == 0) {
        for (unsigned k = 0; k < bits; ++k) v[k] = 1U << (bits - 1 - k);
        return v;
    }
    const Direction& d = directions[dimension - 1];
    for (unsigned k = 0; k < bits; ++k) {
        if (k < d.degree) {
            v[k] = d.m[k] << (bits - 1 - k);
            continue;
        }
        v[k] = v[k - d.degree] ^ (v[k - d.degree] >> d.degree);
        for (unsigned i = 1; i < d.degree; ++i)
            if (((d.a >> (d.degree - 1 - i)) & 1U) != 0) v[k] ^= v[k - i];
    }
    return v;
}

/// The fractions of the points, in the order of Grid::listed.
std::vector<double> sobol(std::size_t count, std::size_t dimensions, std::uint64_t seed) {
    if (dimensions > directions.size() + 1)
        throw ModelError(
            say("--sampling sobol spreads points over at most {} ranges, and there are {}; take latin",
                directions.size() + 1, dimensions));
    std::mt19937_64 random(seed);
    std::vector<double> result(count * dimensions);
    for (std::size_t d = 0; d < dimensions; ++d) {
        const DirectionNumbers v = numbers_of(d);
        std::uint32_t x = seed == 0 ? 0 : static_cast<std::uint32_t>(random() >> 32U);
        for (std::size_t k = 0; k < count; ++k) {
            result[k * dimensions + d] = x * 0x1p-32;
            x ^= v[static_cast<std::size_t>(__builtin_ctzll(k + 1))];  // in the order of Gray's code
        }
    }
    return result;
}

std::vector<double> latin(std::size_t count, std::size_t dimensions, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::vector<double> result(count * dimensions);
    for (std::size_t d = 0; d < dimensions; ++d) {
        std::vector<std::size_t> part(count);
        std::iota(part.begin(), part.end(), 0);
        for (std::size_t k = count; k > 1; --k)
            std::swap(part[k - 1], part[static_cast<std::size_t>(fraction(random) * static_cast<double>(k))]);
        for (std::size_t k = 0; k < count; ++k)
            result[k * dimensions + d] =
                (static_cast<double>(part[k]) + fraction(random)) / static_cast<double>(count);
    }
    return result;
}

std::vector<double> uniform(std::size_t count, std::size_t dimensions, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::vector<double> result(count * dimensions);
    for (double& x : result) x = fraction(random);
    return result;
}

}  // namespace

Grid sampled(std::vector<Axis> axes, std::size_t count, Sampling sampling, std::uint64_t seed) {
    Grid grid{.axes = std::move(axes)};
    const std::size_t n = grid.axes.size();
    grid.listed = sampling == Sampling::sobol   ? sobol(count, n, seed)
                  : sampling == Sampling::latin ? latin(count, n, seed)
                                                : uniform(count, n, seed);
    for (std::size_t i = 0; i < grid.listed.size(); ++i) {
        const Axis& axis = grid.axes[i % n];
        grid.listed[i] = axis.from + (axis.to - axis.from) * grid.listed[i];
    }
    for (Axis& axis : grid.axes) axis.count = count;
    return grid;
}

}  // namespace alembert
