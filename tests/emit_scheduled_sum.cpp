// SPDX-License-Identifier: MIT
// Sums whose late terms come last.
#include <doctest/doctest.h>

#include "codegen/emit/scheduled_sum.hpp"

namespace emit_scheduled_sum {

using namespace alembert;

TEST_CASE("scheduled sum: the term that is ready last is added last") {
    const ScheduledSum sum({.terms = {{.late = "x", .ready = {.node = 0}},
                                      {.weight = "w", .late = "y", .ready = {.node = 1}, .negative = true},
                                      {.late = "z", .ready = {.node = 2, .delay = 1}}}});
    Times times;
    times[0] = {20, 0, 4};
    CHECK(sum.value(times).text == "z - w * y + x");  // does not begin with what is subtracted
    CHECK(sum.ready(times) == 24);                    // the others are in the sum when x comes
    times[0] = {0, 20, 4};
    CHECK(sum.value(times).text == "x + z - w * y");
    times[0] = {3, 3, 3};
    CHECK(sum.ready(times) == 4 + 4 + 4 + 3);  // three additions, one after the other
}

TEST_CASE("scheduled sum: factors stay outside, equal weights and equal values are taken together") {
    const ScheduledSum sum(
        {.outer = "a",
         .inner = "per_k",
         .terms = {
             {.late = "g", .ready = {0, 2, 15}, .is_inner = true},
             {.weight = "2", .factor = "p", .late = "u", .ready = {0, 1}, .is_inner = true},
             {.weight = "2", .factor = "q", .late = "v", .ready = {1, 1}, .is_inner = true},
             {.weight = "k", .factor = "p", .late = "u", .ready = {0, 1}, .is_inner = true, .negative = true},
             {.factor = "c", .late = "y", .ready = {1, 0}}}});
    const Times times{{{0, 30}, {0, 2}, {0, 0}}};
    CHECK(sum.value(times).text == "a * (per_k * ((2 - k) * p * u + 2 * q * v + g) + c * y)");
    CHECK(sum.ready(times) == 30 + 4 + 4);
    const ScheduledSum alone(
        {.outer = "a",
         .inner = "per_k",
         .terms = {{.late = "g", .is_inner = true}, {.late = "h", .is_inner = true, .negative = true}}});
    CHECK(alone.value(times).text == "(a * per_k) * (g - h)");
}

TEST_CASE("scheduled sum: several terms that are subtracted stay in a bracket") {
    const ScheduledSum sum({.terms = {{.late = "x", .ready = {.node = 0}},
                                      {.late = "y", .ready = {.node = 0}, .negative = true},
                                      {.late = "z", .ready = {.node = 0}, .negative = true}}});
    const Times times{{{0}, {0}, {0}}};
    CHECK(sum.value(times).text == "x - (y + z)");
    CHECK(sum.value(times).operations == 2);
}

}  // namespace emit_scheduled_sum
