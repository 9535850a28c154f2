// SPDX-License-Identifier: MIT
// Functions by points in the runtime: intervals that are held, side functions and their bounds, on random tables
// with and without a period.
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

Table::Points drawn(std::mt19937& random, bool is_periodic, int least = 3) {
    std::uniform_real_distribution<double> step(0.1, 1), value(-1, 1);
    Table::Points points{.axes = {{.at = {value(random)}}}, .values = {value(random)}};
    const int count = least + static_cast<int>(random() % 6);
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

double at(const Table& f, int order, double x, double number = Table::free) {
    return f.value<double>({order, 0}, {&x, nullptr}, {number, Table::free});
}

/// The number of the interval of x, through all periods: how many knots are at or before it.
long interval_of(const TableAxis& axis, double x) {
    const double turns = axis.period > 0 ? std::floor((x - axis.at.front()) / axis.period) : 0;
    long number = static_cast<long>(turns) * static_cast<long>(axis.kinks.size());
    for (const int kink : axis.kinks)
        number += axis.at[static_cast<std::size_t>(kink)] + turns * axis.period <= x ? 1 : 0;
    return number;
}

/// As it is held.
double held_number(const Table& f, int order, long number) {
    const long around = f.cycle(0, {order, 0});
    return static_cast<double>((number % around + around) % around);
}

}  // namespace

TEST_CASE("tabulated: a value held in its interval is the value, and goes on across the next knots") {
    std::mt19937 random(seed);
    for (int trial = 0; trial < 300; ++trial) {
        // Those of many points have their intervals told apart as even and odd alone.
        const Table f(drawn(random, trial % 2 == 0, trial % 3 == 0 ? 80 : 3));
        const TableAxis& axis = f.axes()[0];
        INFO("seed ", seed, ", trial ", trial);
        const double width = axis.at.back() - axis.at.front();
        std::uniform_real_distribution<double> place(axis.at.front() - width, axis.at.back() + width);
        if (axis.kinks.empty()) continue;
        CHECK(f.tells_knots(0, {0, 0}) == (axis.kinks.size() <= Table::most_told));
        const int side_order = Table::side_order(0);
        for (int order = 0; order < 2; ++order) {
            for (int k = 0; k < 20; ++k) {
                const double x = place(random), w = at(f, side_order, x);
                const long number = interval_of(axis, x);
                if (std::abs(w) < 1e-6) continue;
                CHECK((w > 0) == (number % 2 == 0));
                CHECK(at(f, order, x, held_number(f, order, number)) == at(f, order, x));
                const double quick = f.value_of_one(order, x, held_number(f, order, number));
                CHECK(std::abs(quick - at(f, order, x)) <= 1e-13 * (1 + std::abs(quick)) * 24 / 1e-2);
                // The slope of the side function by differences.
                const double h = 1e-7, slope = (at(f, side_order, x + h) - at(f, side_order, x - h)) / (2 * h);
                CHECK(std::abs(slope - at(f, side_order + 1, x)) < 1e-5);
            }
            for (const int kink : axis.kinks) {
                const double x = axis.at[static_cast<std::size_t>(kink)], h = 1e-5;
                const double before = held_number(f, order, interval_of(axis, x - h)),
                             after = held_number(f, order, interval_of(axis, x + h));
                CHECK(before != after);
                CHECK(std::abs(at(f, side_order, x)) < 1e-12);
                // Just beyond a knot the other interval's value is near, and the held one is smooth.
                const double there = at(f, order, x + h, before), here = at(f, order, x - h),
                             far = at(f, order, x - 3 * h);
                // A step of 2 h, and second derivatives of at most 24/0.1², or third ones of 24/0.1³.
                CHECK(std::abs(there - (2 * here - far)) < 4 * h * h * (order == 0 ? 2400 : 24000));
                // Between two numbers that follow each other there is the mixture of both.
                if (after != before + 1) continue;
                const double mixed = 0.75 * there + 0.25 * at(f, order, x + h, after);
                CHECK(std::abs(at(f, order, x + h, before + 0.25) - mixed) < 1e-12 * (1 + std::abs(mixed)));
                CHECK(std::abs(f.value_of_one(order, x + h, before + 0.25) - mixed) <
                      1e-12 * (1 + std::abs(mixed)));
            }
        }
    }
}

// Machine code asks for the numbers one after the other; the orders of a Jacobian are those of derivatives, with
// the numbers of the function.
TEST_CASE("tabulated: code that holds intervals of two arguments has the values that they have") {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> value(-1, 1);
    for (const std::size_t first : {2U, 3U, 7U})
        for (const std::size_t second : {2U, 4U, 9U})
            for (const bool is_periodic : {false, true})
                for (const Table::Orders& orders :
                     {Table::Orders{0, 0}, Table::Orders{1, 0}, Table::Orders{0, 1}}) {
                    CAPTURE(first);
                    CAPTURE(second);
                    CAPTURE(is_periodic);
                    Table::Points points{.axes = {{}, {}}, .values = {}, .outside = Table::Outside::hold};
                    for (std::size_t i = 0; i < first; ++i) points.axes[0].at.push_back(static_cast<double>(i));
                    for (std::size_t i = 0; i < second; ++i) points.axes[1].at.push_back(static_cast<double>(i));
                    for (std::size_t i = 0; i < first * second; ++i) points.values.push_back(value(random));
                    if (is_periodic) {
                        points.axes[0].period = static_cast<double>(first) - 1;
                        std::copy_n(points.values.begin(), second,
                                    points.values.end() - static_cast<long>(second));
                    }
                    const Table f(points);
                    const double bits = bits_for_code(f.call(orders, true));
                    const double x = 0.3 + static_cast<double>(first) / 2,
                                 y = 0.6 + static_cast<double>(second) / 2;
                    const auto least = [&](std::size_t axis) { return f.cycle(axis, orders); };
                    for (long m = -1; m < least(0); ++m)
                        for (long n = -1; n < least(1); ++n) {
                            const auto i = static_cast<double>(m), j = static_cast<double>(n);  // −1 is none
                            const double code = held_for_code(held_for_code(bits, i), j);
                            CHECK(value_of_two_for_code(code, x, y) == f.value<double>(orders, {&x, &y}, {i, j}));
                        }
                    const double no_number = bits_for_code(f.call(orders, false));
                    CHECK(value_of_two_for_code(no_number, x, y) == f.value<double>(orders, {&x, &y}));
                }
}

// y is 0, then x − 2, then 5 (x − 4) …, each piece told from those two knots away.
TEST_CASE("tabulated: an interval that is held is the same one however far x is") {
    const Table f(
        {.axes = {{.at = {0, 2, 2.01, 2.02, 9}}}, .values = {0, 0, 5, 0, 7}, .interpolation = {}, .outside = {}});
    REQUIRE(f.axes()[0].kinks.size() == 3);
    for (const double x : {0.5, 2.005, 2.015, 8.0}) {
        CHECK(at(f, 0, x, 0) == 0);
        CHECK(std::abs(at(f, 0, x, 1) - 500 * (x - 2)) < 1e-9);
        CHECK(std::abs(at(f, 0, x, 2) - (5 - 500 * (x - 2.01))) < 1e-9);
        CHECK(std::abs(at(f, 0, x, 3) - 7 * (x - 2.02) / 6.98) < 1e-12);
        for (const double number : {0.0, 1.0, 2.0, 3.0})
            CHECK(std::abs(f.value_of_one(0, x, number) - at(f, 0, x, number)) < 1e-9);
    }
    // With a period, of those less than a period away.
    const Table g(
        {.axes = {{.at = {0, 0.5, 1}, .period = 1}}, .values = {0, 1, 0}, .interpolation = {}, .outside = {}});
    REQUIRE(g.axes()[0].kinks.size() == 2);
    REQUIRE(g.cycle(0, {0, 0}) == 4);
    CHECK(std::abs(at(g, 0, 5.75, held_number(g, 0, interval_of(g.axes()[0], 5.25))) - 1.5) < 1e-12);
    CHECK(std::abs(at(g, 0, 4.75, held_number(g, 0, interval_of(g.axes()[0], 5.25))) + 0.5) < 1e-12);
}

TEST_CASE("tabulated: bounds of a side function hold its values and derivatives") {
    std::mt19937 random(seed + 1);
    for (int trial = 0; trial < 300; ++trial) {
        const Table f(drawn(random, trial % 2 == 0));
        if (f.axes()[0].kinks.empty()) continue;
        INFO("seed ", seed + 1, ", trial ", trial);
        const TableAxis& axis = f.axes()[0];
        const double width = axis.at.back() - axis.at.front();
        std::uniform_real_distribution<double> place(axis.at.front() - width, axis.at.back() + width);
        const double a = place(random), b = a + (trial % 3 == 0 ? 0.05 : 0.7) * width;
        const int order = Table::side_order(0);
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
