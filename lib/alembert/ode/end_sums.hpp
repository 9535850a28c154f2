// SPDX-License-Identifier: MIT
#pragma once

/// What a step does with the states at its two ends, in registers of four numbers where the processor has them.
/// All digits are those of one number after the other.
///
///     const EndSums sums = end_sums(size);
///     sums.add(y, rest, change, size, next, next_rest);        // next + next_rest = y + (rest + change)
///     sums.largest(error, y, next, count);                     // of |error| / max(1, |y|, |next|), written to it
///     sums.is_finite(values, count);

#include <algorithm>
#include <cmath>

namespace alembert {

/// One number after the other, as it is done for short states.
namespace singly {

template <class Number>
[[gnu::always_inline]] inline void add(const Number& y, const Number& rest, const Number& change, Number& next,
                                       Number& next_rest) {
    const Number added = change + rest, sum = y + added, taken = sum - y;
    next_rest = (y - (sum - taken)) + (added - taken);
    next = sum;
}

inline void add(const double* y, const double* rest, const double* change, int size, double* next,
                double* next_rest) {
    for (int i = 0; i < size; ++i) add(y[i], rest[i], change[i], next[i], next_rest[i]);
}

inline double largest(double* error, const double* y, const double* next, int count) {
    double result = 0, zero = 0;
    for (int i = 0; i < count; ++i) {
        error[i] = std::abs(error[i]) / std::max({1.0, std::abs(y[i]), std::abs(next[i])});
        result = std::max(result, error[i]);
        zero += (error[i] + next[i]) * 0;
    }
    return zero == 0 ? result : HUGE_VAL;
}

inline bool is_finite(const double* values, int count) {
    double zero = 0;
    for (int i = 0; i < count; ++i) zero += values[i] * 0;
    return zero == 0;
}

}  // namespace singly

struct EndSums {
    /// By Knuth's exact sum of two doubles.
    void (*add)(const double* y, const double* rest, const double* change, int size, double* next,
                double* next_rest) = singly::add;
    /// Infinite if an error or a value of `next` is not finite.
    double (*largest)(double* error, const double* y, const double* next, int count) = singly::largest;
    bool (*is_finite)(const double* values, int count) = singly::is_finite;
};

/// For states of so many components.
EndSums end_sums(int size);

}  // namespace alembert
