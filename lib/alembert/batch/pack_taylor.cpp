// SPDX-License-Identifier: MIT
#include "alembert/batch/pack_taylor.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "alembert/batch/pack_pieces.hpp"
#include "alembert/native/registers.hpp"
#include "alembert/ode/taylor.hpp"

namespace alembert {

namespace {

/// a = the larger of a and |b|
template <class Wide>
[[gnu::always_inline]] inline void raise(Wide& a, const Wide& b) {
    const Wide size = b < 0 ? -b : b;
    a = a > size ? a : size;
}

/// Four polynomials in h⁴ side by side, so that few operations wait for each other.
template <class Wide>
struct Sums {
    Wide of[4] = {};
    [[gnu::always_inline]] void add(int r, const Wide& h4, const Wide& term) { of[r] = of[r] * h4 + term; }
    [[gnu::always_inline]] void total(const Wide& h, const Wide& h2, Wide& sum) const {
        sum = h * ((of[0] + h2 * of[2]) + h * (of[1] + h2 * of[3]));
    }
};

}  // namespace

/// The arithmetic on vectors of so many lanes.
template <int width>
struct PackTaylor::Work {
    using Pieces = PackPieces<width>;
    using Wide = typename Pieces::Reals;
    using Bits = typename Pieces::Bits;
    static constexpr int pieces = Pieces::pieces;
    static Wide* wide(std::vector<Lanes>& list) { return Pieces::in(list.data()); }
    static Wide* wide(Lanes& one) { return Pieces::in(&one); }

    [[gnu::always_inline]] static void attempt(PackTaylor& s, int piece) {
        const Wide h = wide(s.end)[piece] - wide(s.time)[piece], h2 = h * h, h4 = h2 * h2, none{};
        const Wide *const rows = wide(s.coefficients_), *const y = wide(s.y_), *const rest = wide(s.rest_);
        Wide *const ends = wide(s.next_), *const ends_rest = wide(s.next_rest_), *const slopes = wide(s.slopes_);
        const int n = s.dimension_, order = s.order_;
        Wide power = none + 1, square = h, largest{}, zero{};
        for (int k = order; k > 0; k /= 2, square *= square)
            if (k % 2 == 1) power *= square;
        for (int b = piece; b < n * pieces; b += pieces) {
            Sums<Wide> sums, slope;
            const auto add = [&](int r, int k) __attribute__((always_inline)) {
                const Wide term = rows[k * n * pieces + b];
                sums.add(r, h4, term);
                slope.add(r, h4, term * static_cast<double>(k));
            };
            int k = (order - 1) / 4 * 4;
            for (int r = 0; r < 4; ++r)
                if (k + r < order) add(r, k + r + 1);
            while ((k -= 4) >= 0) add(0, k + 1), add(1, k + 2), add(2, k + 3), add(3, k + 4);
            slope.total(h, h2, slopes[b]);
            Wide sum, scale = none + 1;
            sums.total(h, h2, sum);
            const Wide change = (h == 0 ? none : sum) + rest[b], start = y[b], next = start + change,
                       taken = next - start;
            ends[b] = next;
            ends_rest[b] = (start - (next - taken)) + (change - taken);
            if (b >= s.controlled_ * pieces) continue;
            raise(scale, start);
            raise(scale, next);
            const Wide error = h == 0 ? none : rows[order * n * pieces + b] * power / scale;
            raise(largest, error);
            zero += (error + next) * 0;
        }
        wide(s.error_norm)[piece] = zero == 0 ? largest : none + HUGE_VAL;
    }

    /// Whether the rates at the ends are finite and those of the polynomials, as Taylor::foresees_end.
    [[gnu::always_inline]] static void look(PackTaylor& s, int piece) {
        constexpr double rounded = 1e-8;
        const Wide h = wide(s.end)[piece] - wide(s.time)[piece], none{}, one = none + 1;
        const Wide *const rate = wide(s.coefficients_) + s.dimension_ * pieces,
                          *const end_rate = wide(s.next_coefficients_) + s.dimension_ * pieces,
                          *const y = wide(s.y_), *const next = wide(s.next_), *const slopes = wide(s.slopes_);
        Wide zero{};
        Bits missed{};
        for (int b = piece; b < s.controlled_ * pieces; b += pieces) {
            Wide miss{}, scale = one, fastest{};
            raise(miss, slopes[b] - h * end_rate[b]);
            raise(scale, y[b]);
            raise(scale, next[b]);
            raise(fastest, rate[b]);
            raise(fastest, end_rate[b]);
            missed |= (miss > s.most_missed_ * scale) & (miss > rounded * h * fastest);
            zero += (end_rate[b] + next[b]) * 0;
        }
        Wide size = one;
        raise(size, wide(s.time)[piece]);
        missed &= h >= shortest_tried * size;
        Wide& error_norm = wide(s.error_norm)[piece];
        error_norm = (zero == 0) & ~missed ? error_norm : none + HUGE_VAL;
        for (int lane = 0; lane < width; ++lane)
            s.unforeseen_ |= missed[lane] != 0 ? 1U << (piece * width + lane) : 0U;
    }

    /// Takes over the ends that are accepted, and measures the last terms of their series.
    [[gnu::always_inline]] static void advance(PackTaylor& s, unsigned accepted, int piece) {
        Bits take;
        for (int lane = 0; lane < width; ++lane)
            take[lane] = -static_cast<long long>(accepted >> (piece * width + lane) & 1U);
        Wide *const y = wide(s.y_), *const rest = wide(s.rest_), *const rows = wide(s.next_coefficients_);
        const Wide *const next = wide(s.next_), *const next_rest = wide(s.next_rest_),
                          *const before = wide(s.coefficients_);
        const int n = s.dimension_;
        for (int b = piece; b < n * pieces; b += pieces) {
            y[b] = take ? next[b] : y[b];
            rest[b] = take ? next_rest[b] : rest[b];
        }
        Wide& time = wide(s.time)[piece];
        time = take ? wide(s.end)[piece] : time;
        constexpr unsigned all = (1U << lanes) - 1;
        if (accepted != all)
            for (int i = piece; i < (s.order_ + 1) * n * pieces; i += pieces) rows[i] = take ? rows[i] : before[i];
        for (int k = std::max(0, s.order_ - 7); k <= s.order_; ++k) {
            const Wide none{}, one = none + 1;
            Wide largest{}, zero{};
            for (int b = piece; b < s.controlled_ * pieces; b += pieces) {
                Wide scale = one;
                raise(scale, y[b]);
                raise(largest, rows[k * n * pieces + b] / scale);
                zero += rows[k * n * pieces + b] * 0;
            }
            wide(s.sizes_[k + 7 - s.order_])[piece] = zero == 0 ? largest : none + HUGE_VAL;
        }
    }
};

/// Compiled for the registers that there may be (without AVX2 there are no packs of series).
struct PackTaylor::Compiled {
    ALEMBERT_WIDE static void attempt_256(PackTaylor& s) {
        for (int piece = 0; piece < Work<4>::pieces; ++piece) Work<4>::attempt(s, piece);
    }
    ALEMBERT_WIDE static void look_256(PackTaylor& s) {
        for (int piece = 0; piece < Work<4>::pieces; ++piece) Work<4>::look(s, piece);
    }
    ALEMBERT_WIDE static void advance_256(PackTaylor& s, unsigned accepted) {
        for (int piece = 0; piece < Work<4>::pieces; ++piece) Work<4>::advance(s, accepted, piece);
    }
    ALEMBERT_WIDEST static void attempt_512(PackTaylor& s) { Work<8>::attempt(s, 0); }
    ALEMBERT_WIDEST static void look_512(PackTaylor& s) { Work<8>::look(s, 0); }
    ALEMBERT_WIDEST static void advance_512(PackTaylor& s, unsigned accepted) { Work<8>::advance(s, accepted, 0); }
};

PackTaylor::PackTaylor(const Module& module, const PackSeries& series, int dimension, int extra, double tolerance)
    : pack_(*module.pack()),
      series_(series),
      dimension_(dimension),
      controlled_(dimension - extra),
      order_(taylor_order(tolerance, series.order_cost, series.product_cost)),
      parameters_(series.parameters),
      has_widest_(registers() == Registers::widest),
      most_missed_(terms_left_out * tolerance),
      lengths_(order_, std::log(taylor_share * tolerance)),
      y_(place(dimension)),
      rest_(y_.size()),
      next_(y_.size()),
      next_rest_(y_.size()),
      slopes_(y_.size()),
      par_(place(module.table().parameters + module.table().constants)),
      series_par_(place(series.parameters + series.constants)),
      coefficients_(place((order_ + 1) * dimension)),
      next_coefficients_(coefficients_.size()),
      work_(series.workspace()) {}

void PackTaylor::put(int lane, double t, const double* state, const double*, const std::vector<double>& par) {
    time[lane] = end[lane] = t;
    for (int i = 0; i < dimension_; ++i) {
        y_[place(i)][lane] = state[i];
        rest_[place(i)][lane] = 0;
    }
    for (std::size_t i = 0; i < par.size(); ++i) par_[i][lane] = par[i];
    std::vector<double> own(par.begin(), par.begin() + parameters_);
    own.resize(series_par_.size());
    series_.prepare(own.data());
    for (std::size_t i = 0; i < own.size(); ++i) series_par_[i][lane] = own[i];
    new_ |= 1U << lane;
}

void PackTaylor::attempt() {
    (has_widest_ ? Compiled::attempt_512 : Compiled::attempt_256)(*this);
}

void PackTaylor::finish() {
    series_.expand(end, next_.data(), series_par_.data(), order_, next_coefficients_.data(), work_.data());
    unforeseen_ = 0;
    (has_widest_ ? Compiled::look_512 : Compiled::look_256)(*this);
}

void PackTaylor::advance(unsigned accepted) {
    (has_widest_ ? Compiled::advance_512 : Compiled::advance_256)(*this, accepted);
    std::swap(coefficients_, next_coefficients_);
    new_ &= ~accepted;
}

/// The largest of size(k) ratio^k, first ≤ k < end.
double PackTaylor::most_of(int first, int end, double ratio, int lane) const {
    double most = 0, power = whole_power(ratio, first);
    for (int k = first; k < end; ++k, power *= ratio) most = std::max(most, size(k, lane) * power);
    return most;
}

double PackTaylor::next_length(int lane) const {
    return lengths_([&](int k) { return size(k, lane); },
                    [&](int first, int end, double ratio) { return most_of(first, end, ratio, lane); });
}

bool PackTaylor::decays(int lane, double length) const {
    return lengths_.decays(length,
                           [&](int first, int end, double ratio) { return most_of(first, end, ratio, lane); });
}

double PackTaylor::shorter_length(double h, double ratio) const {
    return h * shorter_taylor_step(order_, ratio);
}

/// The series of that step stand where those of the next ends will.
void PackTaylor::within(int lane, double h, std::vector<double>& state) const {
    for (int b = 0; b < dimension_; ++b) {
        double value = 0;
        for (int k = order_; k >= 0; --k) value = value * h + next_coefficients_[place(k * dimension_ + b)][lane];
        state[place(b)] = value;
    }
}

void PackTaylor::energies(Lanes (&energy)[5]) const {
    pack_.energy(reals(&time), reals(y_.data()), reals(series_now() + dimension_), reals(par_.data()),
                 reals(energy), reals(&energy[4]));
}

}  // namespace alembert
