// SPDX-License-Identifier: MIT
#include "alembert/native/series_code.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <utility>

#include "alembert/native/cpu_features.hpp"

namespace alembert {

namespace {

int rounded_up(int count) {
    return (count + 7) / 8 * 8;
}

/// `width`: the numbers in a register.
template <int width>
struct Expansion {
    using Wide [[gnu::vector_size(width * sizeof(double))]] = double;
    static_assert(sizeof(Wide) == width * sizeof(double));
    const SeriesCode& code;
    int order;
    double *out, *fixed, *given[2], *rows;

    /// sums = Σ a_j b_(k−j) over edge ≤ j ≤ k − edge in each lane; four sums side by side, so that few additions
    /// wait for each other.
    template <int k, int edge>
    [[gnu::always_inline]] void convolve(double* sums) const {
        const int lanes = code.places.lanes;
        const std::ptrdiff_t step = 2 * static_cast<std::ptrdiff_t>(lanes);
        for (int lane = 0; lane < lanes; lane += width) {
            const double* const at = rows + lane;
            Wide part[4] = {};
#pragma GCC unroll 32
            for (int j = edge; j <= k - edge; ++j) {
                Wide left, right;
                std::memcpy(&left, at + j * step, sizeof left);
                std::memcpy(&right, at + lanes + (k - j) * step, sizeof right);
                part[j % 4] += left * right;
            }
            const Wide total = (part[0] + part[1]) + (part[2] + part[3]);
            std::memcpy(sums + lane, &total, sizeof total);
        }
    }

    /// False at the last order, which needs the rates of the one before alone.
    template <int k>
    [[gnu::always_inline]] bool one() const {
        constexpr double inverse = 1.0 / k;
        const GivenPlaces& at = code.places;
        double *const here = given[k % 2], *const after = given[(k + 1) % 2];
        if (k == order) {
            for (int i = 0; i < at.width; ++i) out[k * at.width + i] = inverse * here[at.rates() + i];
            return false;
        }
        if (at.factors > 0)
            convolve<k, 2>(here);
        else
            convolve<k, 1>(here);
        here[at.inverse()] = inverse;
        here[at.is_one()] = k == 1 ? 1 : 0;
        code.next(k, fixed, here, after, rows + static_cast<std::ptrdiff_t>(k) * 2 * at.lanes, out + k * at.width);
        if constexpr (k <= 2)
            for (double* const any : given)
                for (int i = 0; i < at.factors; ++i)
                    any[at.ones() + i] = k == 1 ? 0.5 * after[at.before() + i] : 2 * any[at.ones() + i];
        return true;
    }

    /// In straight-line code: in a loop, each order would have other lengths, which no processor foresees.
    template <int... before>
    [[gnu::always_inline]] void all(std::integer_sequence<int, before...>) const {
        (void)(one<before + 1>() && ...);
    }
    [[gnu::always_inline]] void all() const {
        all(std::make_integer_sequence<int, most_order>());
    }
};

ALEMBERT_WIDE void run_orders(const Expansion<4>& one) {
    one.all();
}
ALEMBERT_WIDEST void run_orders(const Expansion<8>& one) {
    one.all();
}

}  // namespace

int workspace_of(const SeriesCode& code) {
    return rounded_up(code.fixed) + 2 * rounded_up(code.places.size()) + (most_order + 1) * 2 * code.places.lanes;
}

void SeriesCode::expand(double t, const double* state, const double* par, int order, double* out,
                        double* work) const {
    const GivenPlaces& at = places;
    double *const even = work + rounded_up(fixed), *const odd = even + rounded_up(at.size()),
                  *const rows = odd + rounded_up(at.size());
    for (double* const given : {even, odd}) std::fill(given + at.before(), given + at.size(), 0);
    first(t, state, par, work, odd);
    fix(work);
    std::copy_n(state, at.width, out);
    if (order == 0) return;
    static const bool has_widest = registers() == Registers::widest;
    const auto run = [&]<int width>() {
        run_orders(Expansion<width>{
            .code = *this, .order = order, .out = out, .fixed = work, .given = {even, odd}, .rows = rows});
    };
    has_widest ? run.template operator()<8>() : run.template operator()<4>();
}

}  // namespace alembert
