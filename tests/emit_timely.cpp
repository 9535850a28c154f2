// SPDX-License-Identifier: MIT
// Sums whose late terms come last.
#include <doctest/doctest.h>

#include "emit/timely.hpp"

using namespace alembert;

TEST_CASE("timely: what is ready last is added last") {
    const Timely sum({.terms = {{.late = "x", .ready = {.node = 0}}, {.weight = "w", .late = "y", .ready = {.node = 1}, .negative = true}, {.late = "z", .ready = {.node = 2, .delay = 1}}}});
    Times times;
    times[0] = {20, 0, 4};
    CHECK(sum.text(times) == "z - w * y + x");  // does not begin with what is subtracted
    CHECK(sum.ready(times) == 24);  // the others are in the sum when x comes
    times[0] = {0, 20, 4};
    CHECK(sum.text(times) == "x + z - w * y");
    times[0] = {3, 3, 3};
    CHECK(sum.ready(times) == 4 + 4 + 4 + 3);  // three additions, one after the other
}

TEST_CASE("timely: factors stay outside, equal weights and equal values are taken together") {
    const Timely sum({.outer = "a",
                      .inner = "per_k",
                      .terms = {{.late = "g", .ready = {0, 2, 15}, .is_inner = true},
                                {.weight = "2", .factor = "p", .late = "u", .ready = {0, 1}, .is_inner = true},
                                {.weight = "2", .factor = "q", .late = "v", .ready = {1, 1}, .is_inner = true},
                                {.weight = "k", .factor = "p", .late = "u", .ready = {0, 1}, .is_inner = true, .negative = true},
                                {.factor = "c", .late = "y", .ready = {1, 0}}}});
    const Times times{{{0, 30}, {0, 2}, {0, 0}}};
    CHECK(sum.text(times) == "a * (per_k * ((2 - k) * p * u + 2 * q * v + g) + c * y)");
    CHECK(sum.ready(times) == 30 + 4 + 4);
    const Timely alone({.outer = "a", .inner = "per_k", .terms = {{.late = "g", .is_inner = true}, {.late = "h", .is_inner = true, .negative = true}}});
    CHECK(alone.text(times) == "(a * per_k) * (g - h)");
}
