// SPDX-License-Identifier: MIT
#include "alembert/ode/end_sums.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "alembert/native/registers.hpp"

namespace alembert {

namespace {

struct InFours {
    static constexpr int width = 4;
    using Lane = RegisterOf<width>::Lane;

    [[gnu::always_inline]] static void load(const double* from, Lane& lane) {
        std::memcpy(&lane, from, sizeof lane);
    }
    [[gnu::always_inline]] static void store(const Lane& lane, double* to) { std::memcpy(to, &lane, sizeof lane); }

    [[gnu::always_inline]] static void add(const double* y, const double* rest, const double* change, int size,
                                           double* next, double* next_rest) {
        int i = 0;
        for (; i + width <= size; i += width) {
            Lane at, of_rest, of_change, sum, left;
            load(y + i, at), load(rest + i, of_rest), load(change + i, of_change);
            singly::add(at, of_rest, of_change, sum, left);
            store(sum, next + i), store(left, next_rest + i);
        }
        singly::add(y + i, rest + i, change + i, size - i, next + i, next_rest + i);
    }

    [[gnu::always_inline]] static double largest(double* error, const double* y, const double* next, int count) {
        Lane most{}, zeros{};
        int i = 0;
        for (; i + width <= count; i += width) {
            Lane off, at, to;
            load(error + i, off), load(y + i, at), load(next + i, to);
            const Lane size = at > -at ? at : -at, next_size = to > -to ? to : -to, one = Lane{} + 1;
            const Lane larger = size > next_size ? size : next_size;
            off = (off > -off ? off : -off) / (larger > one ? larger : one);
            store(off, error + i);
            most = off > most ? off : most;
            zeros += (off + to) * 0;
        }
        double result = 0, zero = 0;
        for (int j = 0; j < width; ++j) result = std::max(result, most[j]), zero += zeros[j];
        result = std::max(result, singly::largest(error + i, y + i, next + i, count - i));
        return zero == 0 ? result : HUGE_VAL;
    }

    [[gnu::always_inline]] static bool is_finite(const double* values, int count) {
        Lane zeros{};
        int i = 0;
        for (; i + width <= count; i += width) {
            Lane lane;
            load(values + i, lane);
            zeros += lane * 0;
        }
        double zero = 0;
        for (int j = 0; j < width; ++j) zero += zeros[j];
        return zero == 0 && singly::is_finite(values + i, count - i);
    }
};

ALEMBERT_WIDE_SAME_DIGITS void add_in_fours(const double* y, const double* rest, const double* change, int size,
                                            double* next, double* next_rest) {
    InFours::add(y, rest, change, size, next, next_rest);
}
ALEMBERT_WIDE_SAME_DIGITS double largest_in_fours(double* error, const double* y, const double* next, int count) {
    return InFours::largest(error, y, next, count);
}
ALEMBERT_WIDE_SAME_DIGITS bool is_finite_in_fours(const double* values, int count) {
    return InFours::is_finite(values, count);
}

}  // namespace

EndSums end_sums(int size) {
    constexpr int short_state = 8;
    if (size <= short_state || registers() == Registers::usual) return {};
    return {add_in_fours, largest_in_fours, is_finite_in_fours};
}

}  // namespace alembert
