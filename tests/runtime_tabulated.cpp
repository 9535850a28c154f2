// SPDX-License-Identifier: MIT
// Functions by points in the runtime: sides, side functions and their bounds, on random tables with and without a
// period.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "alembert/base/tabulated_function.hpp"

namespace runtime_tabulated {

using namespace alembert;
using Table = TabulatedFunction;

namespace {

constexpr unsigned seed = 20261130;

Table::Points drawn(std::mt19937& random, bool is_periodic) {
    std::uniform_real_distribution<double> step(0.1, 1), value(-1, 1);
    Table::Points points{.axes = {{.at = {value(random)}}}, .values = {value(random)}};
    const int count = 3 + static_cast<int>(random() % 6);
    for (int k = 0; k < count; ++k) {
        points.axes[0].at.push_back(points.axes[0].at.back() + step(random));
        points.values.push_back(value(random));
    }
    if (is_periodic) {
        points.axes[0].period = points.axes[0].at.back() - points.axes[0].at.front();
        points.values.back() = points.values.front();
    }
    constexpr Table::Interpolation ways[] = {Table::Interpolation::linear, Table::Interpolation::cubic,
                                             Table::Interpolation::pchip};
    points.interpolation = ways[random() % 3];
    points.outside = random() % 2 == 0 ? Table::Outside::hold : Table::Outside::line;
    return points;
}

double at(const Table& f, int order, double x, int side = 0) {
    return f.value<double>({order, 0}, {&x, nullptr}, {side, 0});
}

}  // namespace

TEST_CASE("tabulated: a value with the side of its interval is the value, and goes on across the next knot") {
    std::mt19937 random(seed);
    for (int trial = 0; trial < 200; ++trial) {
        const Table f(drawn(random, trial % 2 == 0));
        const TableAxis& axis = f.axes()[0];
        INFO("seed ", seed, ", trial ", trial);
        const double width = axis.at.back() - axis.at.front();
        std::uniform_real_distribution<double> place(axis.at.front() - width, axis.at.back() + width);
        for (int order = 0; order < 2; ++order) {
            if (!f.has_kinks(0, {order, 0})) continue;
            const int side_order = Table::side_order(0, {order, 0});
            for (int k = 0; k < 20; ++k) {
                const double x = place(random), w = at(f, side_order, x);
                const int side = w > 0 ? 1 : -1;
                if (std::abs(w) < 1e-6) continue;
                CHECK(at(f, order, x, side) == at(f, order, x));
                // The slope of the side function by differences.
                const double h = 1e-7, slope = (at(f, side_order, x + h) - at(f, side_order, x - h)) / (2 * h);
                CHECK(std::abs(slope - at(f, side_order + 1, x)) < 1e-5);
            }
            // Just beyond a knot the other side's value is near, and the held one is smooth.
            for (const int kink : axis.kinks[order > 0 ? 1 : 0]) {
                const double x = axis.at[static_cast<std::size_t>(kink)], h = 1e-5;
                const int before = at(f, side_order, x - h) > 0 ? 1 : -1;
                CHECK(at(f, side_order, x + h) * before < 0);
                CHECK(std::abs(at(f, side_order, x)) < 1e-12);
                const double there = at(f, order, x + h, before), here = at(f, order, x - h),
                             far = at(f, order, x - 3 * h);
                // A step of 2 h, and second derivatives of at most 24/0.1², or third ones of 24/0.1³.
                CHECK(std::abs(there - (2 * here - far)) < 4 * h * h * (order == 0 ? 2400 : 24000));
            }
        }
    }
}

TEST_CASE("tabulated: bounds of a side function hold its values and derivatives") {
    std::mt19937 random(seed + 1);
    for (int trial = 0; trial < 300; ++trial) {
        const Table f(drawn(random, trial % 2 == 0));
        if (!f.has_kinks(0, {0, 0})) continue;
        INFO("seed ", seed + 1, ", trial ", trial);
        const TableAxis& axis = f.axes()[0];
        const double width = axis.at.back() - axis.at.front();
        std::uniform_real_distribution<double> place(axis.at.front() - width, axis.at.back() + width);
        const double a = place(random), b = a + (trial % 3 == 0 ? 0.05 : 0.7) * width;
        const int order = Table::side_order(0, {0, 0});
        const Bounds bounds = f.side_bounds(order, {{a, b}, {1, 1}, {0, 0}});
        for (int k = 0; k <= 50; ++k) {
            const double x = std::min(b, a + (b - a) * k / 50);
            CHECK(bounds.value.has(at(f, order, x)));
            CHECK(bounds.first.has(at(f, order + 1, x)));
            CHECK(bounds.second.has(at(f, order + 2, x)));
        }
    }
}

}  // namespace runtime_tabulated
