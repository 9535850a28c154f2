// SPDX-License-Identifier: MIT
#include "alembert/native/series_code.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <utility>

#include "alembert/native/registers.hpp"

namespace alembert {

namespace {

int rounded_up(int count) {
    return (count + 7) / 8 * 8;
}

/// `width`: the numbers in a register; `known_lanes`: of the code, if the compiler is to know them, so that rows
/// lie at distances which are part of the instructions; else 0.
template <int width, int known_lanes>
struct Expansion {
    using Wide [[gnu::vector_size(width * sizeof(double))]] = double;
    static_assert(sizeof(Wide) == width * sizeof(double));
    const SeriesCode& code;
    int order;
    double *out, *fixed, *given[2], *rows, *ahead;

    [[gnu::always_inline]] int lanes_of_code() const { return known_lanes > 0 ? known_lanes : code.places.lanes; }

    [[gnu::always_inline]] const double* left(int j) const {
        return rows + static_cast<std::ptrdiff_t>(j) * step();
    }
    [[gnu::always_inline]] const double* right(int j) const { return left(j) + lanes_of_code(); }
    [[gnu::always_inline]] std::ptrdiff_t step() const { return 2 * static_cast<std::ptrdiff_t>(lanes_of_code()); }
    [[gnu::always_inline]] static void load(const double* from, Wide& values) {
        std::memcpy(&values, from, sizeof values);
    }
    [[gnu::always_inline]] void add(int j, int other, int lane, Wide& sum) const {
        Wide a, b;
        load(left(j) + lane, a), load(right(other) + lane, b);
        sum += a * b;
    }
    [[gnu::always_inline]] static void store(const Wide (&part)[4], double* to) {
        const Wide total = (part[0] + part[1]) + (part[2] + part[3]);
        std::memcpy(to, &total, sizeof total);
    }

    /// sums = Σ a_j b_(k−j) over edge ≤ j ≤ k − edge in each lane; four sums side by side, so that few additions
    /// wait for each other. The first and the last term come last, since their rows have been written a moment
    /// ago.
    template <int k, int edge>
    [[gnu::always_inline]] void convolve(double* sums) const {
        for (int lane = 0; lane < lanes_of_code(); lane += width) {
            Wide part[4] = {};
#pragma GCC unroll 32
            for (int j = edge + 1; j < k - edge; ++j) add(j, k - j, lane, part[j % 4]);
            if constexpr (edge <= k - edge) add(edge, k - edge, lane, part[edge % 4]);
            if constexpr (edge < k - edge) add(k - edge, edge, lane, part[(k - edge) % 4]);
            store(part, sums + lane);
        }
    }

    /// The same, and in `ahead` all terms of order k + 1 whose rows are there: each b_j is loaded once for both.
    template <int k, int edge>
    [[gnu::always_inline]] void convolve_two(double* sums) const {
        for (int lane = 0; lane < lanes_of_code(); lane += width) {
            Wide now[4] = {}, then[4] = {}, before{};
#pragma GCC unroll 32
            for (int j = edge + 1; j < k - edge; ++j) {
                Wide a, b;
                load(left(j) + lane, a), load(right(k - j) + lane, b);
                now[j % 4] += a * b;
                if (j > edge + 1) then[j % 4] += a * before;
                before = b;
            }
            add(edge, k - edge, lane, now[edge % 4]);
            add(k - edge, edge, lane, now[(k - edge) % 4]);
            add(edge + 1, k - edge, lane, then[edge % 4]);
            add(k - edge, edge + 1, lane, then[(k - edge) % 4]);
            store(now, sums + lane);
            store(then, ahead + lane);
        }
    }

    /// What was still missing of order k.
    template <int k, int edge>
    [[gnu::always_inline]] void complete(double* sums) const {
        for (int lane = 0; lane < lanes_of_code(); lane += width) {
            Wide sum, other{};
            load(ahead + lane, sum);
            add(edge, k - edge, lane, sum);
            add(k - edge, edge, lane, other);
            sum += other;
            std::memcpy(sums + lane, &sum, sizeof sum);
        }
    }

    template <int k, int edge>
    [[gnu::always_inline]] void sum_products(double* sums) const {
        constexpr int first_pair = 2 * edge + 4;
        if constexpr (k >= first_pair && k % 2 == 1)
            complete<k, edge>(sums);
        else if (k >= first_pair && k + 1 < order)
            convolve_two<std::max(k, first_pair), edge>(sums);
        else
            convolve<k, edge>(sums);
    }

    /// False at the last order, which needs the rates of the one before alone.
    template <int k>
    [[gnu::always_inline]] bool one() const {
        constexpr double inverse = 1.0 / k;
        const GivenPlaces& at = code.places;
        double *const here = given[k % 2], *const after = given[(k + 1) % 2];
        if (k == order) {
            double *const last = out + (k - 1) * at.width, *const now = last + at.width;
            for (int i = 0; i < at.positions; ++i) now[i] = inverse * last[at.positions + i];
            for (int i = at.positions; i < at.width; ++i) now[i] = inverse * here[at.rates() + i];
            return false;
        }
        if (at.factors > 0)
            sum_products<k, 2>(here);
        else
            sum_products<k, 1>(here);
        here[at.inverse()] = inverse;
        here[at.is_one()] = k == 1 ? 1 : 0;
        double* const row = rows + static_cast<std::ptrdiff_t>(k) * 2 * lanes_of_code();
        code.next(k, fixed, here, after, row - 2 * lanes_of_code(), out + (k - 1) * at.width);
        if constexpr (k <= 2)
            for (double* const any : given)
                for (int i = 0; i < at.factors; ++i)
                    any[at.ones() + i] = k == 1 ? 0.5 * row[code.place_of_factor[static_cast<std::size_t>(i)]]
                                                : 2 * any[at.ones() + i];
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

template <int lanes>
ALEMBERT_WIDE void run_wide(const Expansion<4, lanes>& one) {
    one.all();
}
template <int lanes>
ALEMBERT_WIDEST void run_widest(const Expansion<8, lanes>& one) {
    one.all();
}

}  // namespace

int workspace_of(const SeriesCode& code) {
    return rounded_up(code.fixed) + 2 * rounded_up(code.places.size()) + code.places.lanes +
           (most_order + 1) * 2 * code.places.lanes;
}

void SeriesCode::expand(double t, const double* state, const double* par, int order, double* out,
                        double* work) const {
    const GivenPlaces& at = places;
    double *const even = work + rounded_up(fixed), *const odd = even + rounded_up(at.size()),
                  *const ahead = odd + rounded_up(at.size()), *const rows = ahead + at.lanes;
    for (double* const given : {even, odd}) std::fill(given + at.ones(), given + at.size(), 0);
    first(t, state, par, work, odd);
    fix(work);
    std::copy_n(state, at.width, out);
    if (order == 0) return;
    static const bool has_widest = registers() == Registers::widest;
    const auto run = [&]<int lanes>() {
        const auto with = [&]<int width>() {
            return Expansion<width, lanes>{.code = *this,
                                           .order = order,
                                           .out = out,
                                           .fixed = work,
                                           .given = {even, odd},
                                           .rows = rows,
                                           .ahead = ahead};
        };
        if (has_widest)
            run_widest(with.template operator()<8>());
        else
            run_wide(with.template operator()<4>());
    };
    switch (at.lanes) {
        case 8:
            return run.template operator()<8>();
        case 16:
            return run.template operator()<16>();
        default:
            return run.template operator()<0>();
    }
}

}  // namespace alembert
