// SPDX-License-Identifier: GPL-2.0-or-later
#include "algebra/symbolic/exact_solve.hpp"

#include <cmath>

namespace alembert {

using GiNaC::ex;

namespace {

// A bound for one entry; finding the common divisors of larger ones takes seconds.
constexpr int most_nodes = 3000;

int nodes(const ex& e, int limit = most_nodes + 1) {
    int count = 1;
    for (std::size_t i = 0; i < e.nops() && count < limit; ++i) count += nodes(e.op(i), limit - count);
    return count;
}

/// sin²ᵏ⁺ʳ as (1 − cos²)ᵏ sinʳ, in an expanded polynomial.
struct NoSquaresOfSines : GiNaC::map_function {
    ex operator()(const ex& e) override {
        if (GiNaC::is_a<GiNaC::power>(e) && GiNaC::is_the_function<GiNaC::sin_SERIAL>(e.op(0)) &&
            e.op(1).info(GiNaC::info_flags::posint)) {
            const int exponent = GiNaC::ex_to<GiNaC::numeric>(e.op(1)).to_int();
            return pow(1 - pow(cos(e.op(0).op(0)), 2), exponent / 2) * pow(e.op(0), exponent % 2);
        }
        return e.map(*this);
    }
};

/// (sin a, cos a), a being a sum of whole multiples.
std::pair<ex, ex> wave(const ex& angle) {
    if (GiNaC::is_a<GiNaC::add>(angle)) {
        ex s = 0, c = 1;
        for (std::size_t i = 0; i < angle.nops(); ++i) {
            const auto [s1, c1] = wave(angle.op(i));
            const ex former = s;
            s = s * c1 + c * s1;
            c = c * c1 - former * s1;
        }
        return {s, c};
    }
    const ex coefficient = GiNaC::is_a<GiNaC::mul>(angle) ? angle.op(angle.nops() - 1) : ex(1);
    const bool whole = coefficient.info(GiNaC::info_flags::integer) && abs(coefficient) <= 20;
    if (!whole || coefficient.is_equal(1)) return {sin(angle), cos(angle)};
    const ex single = angle / coefficient;
    const int times = GiNaC::ex_to<GiNaC::numeric>(coefficient).to_int(), sign = times < 0 ? -1 : 1;
    ex s = 0, c = 1;
    for (int k = 0; k < sign * times; ++k) {
        const ex former = s;
        s = s * cos(single) + c * sin(single);
        c = c * cos(single) - former * sin(single);
    }
    return {sign * s, c};
}

struct SingleAngles : GiNaC::map_function {
    ex operator()(const ex& e) override {
        const bool is_sine = GiNaC::is_the_function<GiNaC::sin_SERIAL>(e),
                   is_tangent = GiNaC::is_the_function<GiNaC::tan_SERIAL>(e);
        if (!is_sine && !is_tangent && !GiNaC::is_the_function<GiNaC::cos_SERIAL>(e)) return e.map(*this);
        const auto [s, c] = wave(e.op(0).expand());
        return is_sine ? s : is_tangent ? s / c : c;
    }
};

}  // namespace

ex in_single_angles(const ex& e) {
    SingleAngles rewrite;
    return rewrite(e);
}

ex lowest_terms(const ex& e) {
    if (nodes(e) > most_nodes) return e;
    const ex plain = e.normal();
    if (nodes(plain) > most_nodes) return plain;
    NoSquaresOfSines rewrite;
    const ex parts = plain.numer_denom();
    const ex above = rewrite(parts.op(0).expand()).expand(), below = rewrite(parts.op(1).expand()).expand();
    if (below.is_zero()) return plain;
    return (above / below).normal();
}

std::optional<GiNaC::exvector> solve_exactly(ExactRows K, GiNaC::exvector b,
                                             const std::function<double(const ex&)>& number) {
    const std::size_t n = b.size();
    double scale = 0;
    for (GiNaC::exvector& row : K)
        for (ex& entry : row) {
            entry = lowest_terms(entry);
            scale = std::max(scale, std::abs(number(entry)));
        }
    std::vector<std::size_t> column_of(n), row_order;
    std::vector<char> used(n, 0), taken(n, 0);
    for (std::size_t step = 0; step < n; ++step) {
        std::size_t row = n, column = n;
        int least = 0;
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < n && used[i] == 0; ++j) {
                if (taken[j] != 0 || K[i][j].is_zero() || !(std::abs(number(K[i][j])) > 1e-12 * scale)) continue;
                int others = 0;  // a pivot with few other entries in its row and column creates few new ones
                for (std::size_t k = 0; k < n; ++k)
                    others += (used[k] == 0 && !K[k][j].is_zero()) + (taken[k] == 0 && !K[i][k].is_zero());
                const int price = nodes(K[i][j]) * others;
                if (row < n && price >= least) continue;
                row = i;
                column = j;
                least = price;
            }
        if (row == n) return std::nullopt;
        used[row] = taken[column] = 1;
        column_of[row] = column;
        row_order.push_back(row);
        for (std::size_t i = 0; i < n; ++i) {
            if (used[i] != 0 || K[i][column].is_zero()) continue;
            const ex factor = lowest_terms(K[i][column] / K[row][column]);
            for (std::size_t j = 0; j < n; ++j) {
                if (taken[j] != 0) continue;
                K[i][j] = lowest_terms(K[i][j] - factor * K[row][j]);
                if (nodes(K[i][j]) > most_nodes) return std::nullopt;
            }
            b[i] = lowest_terms(b[i] - factor * b[row]);
            if (nodes(b[i]) > most_nodes) return std::nullopt;
            K[i][column] = 0;
        }
    }
    GiNaC::exvector x(n);
    for (std::size_t step = n; step-- > 0;) {
        const std::size_t row = row_order[step];
        GiNaC::exvector rest{b[row]};
        for (std::size_t later = step + 1; later < n; ++later)
            rest.push_back(-K[row][column_of[row_order[later]]] * x[column_of[row_order[later]]]);
        ex& value = x[column_of[row]] = lowest_terms(GiNaC::add(std::move(rest)) / K[row][column_of[row]]);
        if (nodes(value) > most_nodes) return std::nullopt;
    }
    return x;
}

}  // namespace alembert
