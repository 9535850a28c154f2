// SPDX-License-Identifier: MIT
#include "alembert/ode/series_sum.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "alembert/native/registers.hpp"

namespace alembert {

namespace {

/// Eight components: one register, or several of a processor that has none so wide.
using Eight = double __attribute__((vector_size(64)));

/// Four polynomials in h⁴ side by side, so that few operations wait for each other.
struct Sums {
    Eight of[4] = {};
    [[gnu::always_inline]] void add(int r, double h4, const Eight& term) { of[r] = of[r] * h4 + term; }
    /// `count` components of h (of₁ + h of₂ + h² of₃ + h³ of₄).
    [[gnu::always_inline]] void put(double* to, int count, double h) const {
        const double h2 = h * h;
        const Eight total = h * ((of[0] + h2 * of[2]) + h * (of[1] + h2 * of[3]));
        if (count >= 8) {
            std::memcpy(to, &total, sizeof total);
            return;
        }
        double all[8];
        std::memcpy(all, &total, sizeof all);
        for (int i = 0; i < count; ++i) to[i] = all[i];
    }
};

template <bool with_slopes>
[[gnu::always_inline]] inline void sum(const double* rows, int order, int size, double h, double* change,
                                       double* slopes) {
    const double h4 = (h * h) * (h * h);
    for (int first = 0; first < size; first += 8) {
        Sums sums, slope;
        const auto add = [&](int r, int k) __attribute__((always_inline)) {
            Eight term;
            std::memcpy(&term, rows + static_cast<std::ptrdiff_t>(k) * size + first, sizeof term);
            sums.add(r, h4, term);
            if constexpr (with_slopes) slope.add(r, h4, term * static_cast<double>(k));
        };
        int k = (order - 1) / 4 * 4;
        for (int r = 0; r < 4; ++r)
            if (k + r < order) add(r, k + r + 1);
        while ((k -= 4) >= 0) add(0, k + 1), add(1, k + 2), add(2, k + 3), add(3, k + 4);
        sums.put(change + first, size - first, h);
        if constexpr (with_slopes) slope.put(slopes + first, size - first, h);
    }
}

#if defined(__x86_64__)
#define ALEMBERT_FOR_EACH(NAME, TARGET)                                                                   \
    TARGET void NAME(const double* rows, int order, int size, double h, double* change, double* slopes) { \
        if (slopes != nullptr)                                                                            \
            sum<true>(rows, order, size, h, change, slopes);                                              \
        else                                                                                              \
            sum<false>(rows, order, size, h, change, slopes);                                             \
    }
ALEMBERT_FOR_EACH(sum_widest, ALEMBERT_WIDEST)
ALEMBERT_FOR_EACH(sum_wide, ALEMBERT_WIDE)
ALEMBERT_FOR_EACH(sum_usual, )
#undef ALEMBERT_FOR_EACH

using Sum = void (*)(const double*, int, int, double, double*, double*);
Sum chosen() {
    switch (registers()) {
        case Registers::widest:
            return sum_widest;
        case Registers::wide:
            return sum_wide;
        default:
            return sum_usual;
    }
}
#endif

}  // namespace

void sum_series(const double* rows, int order, int size, double h, double* change, double* slopes) {
#if defined(__x86_64__)
    static const Sum best = chosen();
    best(rows, order, size, h, change, slopes);
#else
    if (slopes != nullptr)
        sum<true>(rows, order, size, h, change, slopes);
    else
        sum<false>(rows, order, size, h, change, slopes);
#endif
}

}  // namespace alembert
