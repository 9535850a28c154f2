// SPDX-License-Identifier: MIT
#pragma once

/// Sums of the stages of an explicit method, in registers, with weights that the compiler knows.
///
///     struct Row { static constexpr int stages = 7; static constexpr double weight(int j); };
///     StageSums<4>::weighted_sum<Without<Row, 6>>(k, stride, sum);     // Σ_j weight_j k_j, zeros cost nothing
///     StageSums<4>::add_fresh<Row, 6>(k, stride, h, sum);              // sum += h weight_6 k_6
///
/// `k` is the first stage, `stride` the distance from one to the next, counted in registers. Each number has its
/// own sum in the order of the weights, so that registers of any width give the same digits.

#include <array>
#include <cstddef>
#include <utility>

#include "alembert/native/registers.hpp"

namespace alembert {

/// Calls function<0>, function<1>, … function<count − 1>, one after the other.
template <int count, class Function>
void repeat(Function function) {
    const auto all = [&]<int... i>(std::integer_sequence<int, i...>) {
        (function.template operator()<i>(), ...);
    };
    all(std::make_integer_sequence<int, count>());
}

/// A row without one of its weights.
template <class Row, int left_out>
struct Without {
    static constexpr int stages = Row::stages;
    static constexpr double weight(int j) { return j == left_out ? 0 : Row::weight(j); }
};

/// How many weights of a row are not zero.
template <class Row>
constexpr int terms_of() {
    int count = 0;
    for (int j = 0; j < Row::stages; ++j) count += Row::weight(j) != 0 ? 1 : 0;
    return count;
}

/// Which ones.
template <class Row, std::size_t count>
constexpr std::array<int, count> places_of() {
    std::array<int, count> places{};
    std::size_t next = 0;
    for (int j = 0; j < Row::stages; ++j)
        if (Row::weight(j) != 0) places[next++] = j;
    return places;
}

/// The arithmetic on registers of so many numbers. No function returns one: how that is done depends on the
/// processor.
template <int width>
struct StageSums {
    using Lane = typename RegisterOf<width>::Lane;

    template <class Row>
    [[gnu::always_inline]] static void weighted_sum(const Lane* k, auto stride, Lane& sum) {
        constexpr int count = terms_of<Row>();
        if constexpr (count == 0)
            sum = Lane{};
        else
            sum_of_terms<Row>(k, stride, sum, std::make_integer_sequence<int, count - 1>());
    }

    /// Stage `fresh` has just been written, and everything else waits for it. Therefore it enters last and is
    /// loaded number by number: a load of several numbers would wait until all of them have reached the cache.
    template <class Row, int fresh>
    [[gnu::always_inline]] static void add_fresh(const Lane* k, auto stride, double h, Lane& sum) {
        constexpr double weight = Row::weight(fresh);
        if constexpr (weight != 0) {
            Lane last;
            load_singly(reinterpret_cast<const double*>(k + fresh * stride), last);
            sum += (h * weight) * last;
        }
    }

private:
    /// The terms in one expression, because a function for each would take long to compile.
    template <class Row, int... n>
    [[gnu::always_inline]] static void sum_of_terms(const Lane* k, auto stride, Lane& sum,
                                                    std::integer_sequence<int, n...>) {
        constexpr std::array<int, sizeof...(n) + 1> at = places_of<Row, sizeof...(n) + 1>();
        constexpr std::array<double, sizeof...(n) + 1> weight{Row::weight(at[0]), Row::weight(at[n + 1])...};
        sum = weight[0] * k[at[0] * stride];
        (..., (sum += weight[n + 1] * k[at[n + 1] * stride]));
    }

    [[gnu::always_inline]] static void load_singly(const double* from, Lane& lane) {
        if constexpr (width == 2)
            lane = Lane{loaded(from), loaded(from + 1)};
        else
            lane = Lane{loaded(from), loaded(from + 1), loaded(from + 2), loaded(from + 3)};
    }
    [[gnu::always_inline]] static double loaded(const double* from) {
        double one = *from;
#if defined(__x86_64__)
        __asm__("" : "+x"(one));
#endif
        return one;
    }
};

}  // namespace alembert
