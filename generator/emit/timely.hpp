// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Sums in which what is ready last is added last.
///
///     const TimelySum sum{.outer = "per_z", .inner = "per_k",
///                         .terms = {{.factor = "gathered[0]", .is_inner = true},
///                                   {.weight = "number", .factor = "x_one", .late = "z_before", .ready = 20, .is_inner = true},
///                                   {.factor = "x_0", .late = "y", .ready = 24}}};
///     in_time(sum).text         // "(per_z * per_k) * gathered[0] + (per_z * per_k * number * x_one) * z_before + (per_z * x_0) * y"
///
/// The coefficients of a series wait for each other, order after order: a chain of additions and multiplications. Each late value
/// then costs the chain one fused multiplication and addition, whose other factor was ready before; what is early enough is summed
/// first, and multiplied once.

#include <string>
#include <vector>

namespace alembert {

struct TimelyTerm {
    std::string weight = {};  ///< terms that differ in these alone are one term; empty: 1
    std::string factor = {};  ///< a product, ready early; empty: 1
    std::string late = {};    ///< empty: 1
    double ready = 0;         ///< cycles; of `late`, or of `factor` where there is nothing late
    bool is_inner = false;
    bool negative = false;
};

/// outer · (inner · Σ inner terms + Σ other terms); both factors are products that are ready early, empty: 1.
struct TimelySum {
    std::string outer = {}, inner = {};
    std::vector<TimelyTerm> terms = {};
};

struct Timely {
    std::string text;
    double ready;  ///< cycles
};

Timely in_time(TimelySum sum);

}  // namespace alembert
