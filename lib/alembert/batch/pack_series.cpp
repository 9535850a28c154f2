// SPDX-License-Identifier: MIT
#include "alembert/batch/pack_series.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "alembert/batch/pack_pieces.hpp"
#include "alembert/native/registers.hpp"

namespace alembert {

namespace {

/// A number of workspace that is filled in all lanes.
Lanes in_all(double value) {
    Lanes pack;
    for (int lane = 0; lane < lanes; ++lane) pack[lane] = value;
    return pack;
}

template <int width>
struct Expansion {
    using Pieces = PackPieces<width>;
    using Wide = typename Pieces::Reals;
    static constexpr int pieces = Pieces::pieces;
    const PackSeries& packs;
    int order;
    Lanes *out, *fixed, *given[2], *rows;

    /// For an odd k: Σ a_j b_(k−j) over 0 < j < k, and of the next order the terms whose factors are known, 1 < j
    /// < k. The two share their factors, so that one is loaded for each term instead of two. The terms of a square
    /// are taken once. Sums side by side, so that few additions wait for each other.
    template <int k>
    [[gnu::always_inline]] static void convolve(const Wide* a, const Wide* b, Wide& sum, Wide& ahead) {
        Wide now[3] = {}, next[3] = {};
        if (a == b) {
#pragma GCC unroll 16
            for (int j = 1; 2 * j <= k; ++j) {
                if (2 * j < k) now[j % 3] += a[j * pieces] * a[(k - j) * pieces];
                if (j > 1 && 2 * j < k + 1) next[j % 3] += a[j * pieces] * a[(k + 1 - j) * pieces];
            }
            sum = now[0] + (now[1] + now[2]);
            sum += sum;
            ahead = next[0] + (next[1] + next[2]);
            ahead += ahead;
            if constexpr (k > 1) ahead += a[(k / 2 + 1) * pieces] * a[(k / 2 + 1) * pieces];
            return;
        }
#pragma GCC unroll 32
        for (int j = 1; j < k; ++j) {
            now[j % 3] += a[j * pieces] * b[(k - j) * pieces];
            if (j > 1) next[j % 3] += a[j * pieces] * b[(k + 1 - j) * pieces];
        }
        sum = now[0] + (now[1] + now[2]);
        ahead = next[0] + (next[1] + next[2]);
    }

    /// The sums of order k in `here`. With every odd order come those of the next one in `after`, but for the
    /// terms with the first factors.
    template <int k>
    [[gnu::always_inline]] void sums(Lanes* here, Lanes* after) const {
        Wide *const now = Pieces::in(here), *const next = Pieces::in(after);
        for (std::size_t l = 0; l < packs.products.size(); ++l) {
            const auto [left, right] = packs.products[l];
            for (int piece = 0; piece < pieces; ++piece) {
                const Wide *const a = Pieces::in(rows + PackSeries::place_of_factor(left)) + piece,
                                  *const b = Pieces::in(rows + PackSeries::place_of_factor(right)) + piece;
                const std::size_t at = l * pieces + static_cast<std::size_t>(piece);
                if constexpr (k % 2 == 1)
                    convolve<k>(a, b, now[at], next[at]);
                else if constexpr (k == 2)
                    now[at] = a[pieces] * b[pieces];
                else
                    now[at] += a[pieces] * b[(k - 1) * pieces] + a[(k - 1) * pieces] * b[pieces];
            }
        }
    }

    /// False at the last order, which needs the rates of the one before alone.
    template <int k>
    [[gnu::always_inline]] bool one() const {
        const GivenPlaces& at = packs.places;
        Lanes *const here = given[k % 2], *const after = given[(k + 1) % 2];
        if (k == order) {
            constexpr double inverse = 1.0 / k;
            Wide* const last = Pieces::in(out + k * at.width);
            const Wide* const rates = Pieces::in(here + at.rates());
            for (int i = 0; i < at.width * pieces; ++i) last[i] = inverse * rates[i];
            return false;
        }
        sums<k>(here, after);
        here[at.inverse()] = in_all(1.0 / k);
        here[at.is_one()] = in_all(k == 1 ? 1 : 0);
        const Lanes number = in_all(k);
        packs.next(reals(&number), reals(fixed), reals(here), reals(after), reals(rows + k),
                   reals(out + k * at.width));
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

ALEMBERT_WIDE void run(const Expansion<4>& one) {
    one.all();
}
ALEMBERT_WIDEST void run(const Expansion<8>& one) {
    one.all();
}

std::size_t count(int number) {
    return static_cast<std::size_t>(number);
}

}  // namespace

std::size_t PackSeries::workspace() const {
    return count(fixed) + 2 * count(places.size()) + count(place_of_factor(factors));
}

void PackSeries::expand(const Lanes& t, const Lanes* state, const Lanes* par, int order, Lanes* out,
                        Lanes* work) const {
    const GivenPlaces& at = places;
    Lanes *const even = work + fixed, *const odd = even + at.size(), *const rows = odd + at.size();
    first(reals(&t), reals(state), reals(par), reals(work), reals(odd));
    fix(reals(work));
    std::copy_n(state, at.width, out);
    if (order == 0) return;
    const auto go = [&]<int width>() {
        run(Expansion<width>{
            .packs = *this, .order = order, .out = out, .fixed = work, .given = {even, odd}, .rows = rows});
    };
    static const bool has_widest = registers() == Registers::widest;
    has_widest ? go.template operator()<8>() : go.template operator()<4>();
}

}  // namespace alembert
