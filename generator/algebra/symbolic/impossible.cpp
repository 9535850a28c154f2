// SPDX-License-Identifier: GPL-2.0-or-later
#include "algebra/symbolic/impossible.hpp"

#include <cln/rational.h>

#include <algorithm>
#include <map>
#include <optional>

namespace alembert {

using GiNaC::ex;
using Fraction = cln::cl_RA;

namespace {

constexpr std::size_t most_columns = 400;

/// Monomial → coefficient; the constant under 1.
using MonomialTerms = std::map<ex, Fraction, GiNaC::ex_is_less>;

/// Nothing if a coefficient is no fraction.
std::optional<MonomialTerms> monomial_terms(const ex& e) {
    const ex sum = e.expand();
    MonomialTerms result;
    const auto add = [&](const ex& term) {
        ex coefficient = 1, monomial = 1;
        const auto sort = [&](const ex& factor) {
            (GiNaC::is_a<GiNaC::numeric>(factor) ? coefficient : monomial) *= factor;
        };
        if (GiNaC::is_a<GiNaC::mul>(term))
            std::for_each(term.begin(), term.end(), sort);
        else
            sort(term);
        if (!coefficient.info(GiNaC::info_flags::rational)) return false;
        result[monomial] =
            result[monomial] + cln::the<cln::cl_RA>(GiNaC::ex_to<GiNaC::numeric>(coefficient).to_cl_N());
        return true;
    };
    if (!GiNaC::is_a<GiNaC::add>(sum)) return add(sum) ? std::optional(result) : std::nullopt;
    for (const ex& term : sum)
        if (!add(term)) return std::nullopt;
    return result;
}

/// The factors of a monomial whose sign is known, and the others.
struct SplitMonomial {
    ex known = 1;
    bool is_strict = true;  ///< whether `known` cannot be zero
    std::vector<ex> open = {};
};

class Generators {
public:
    explicit Generators(const std::vector<GiNaC::symbol>& above_zero) : above_zero_(above_zero) {}

    /// Adds what is known of the monomial's sign.
    void add(const ex& monomial) {
        const SplitMonomial split = split_of(monomial);
        if (split.open.empty()) return keep(monomial, split.is_strict);
        if (split.open.size() == 1 && is_bounded(split.open[0])) {
            keep(split.known + monomial, false);
            keep(split.known - monomial, false);
        }
        if (split.open.size() == 2) {  // (x ± y)²
            const ex squares = split.known * (pow(split.open[0], 2) + pow(split.open[1], 2));
            keep(squares + 2 * monomial, false);
            keep(squares - 2 * monomial, false);
        }
    }

    void keep(const ex& e, bool is_strict) {
        if (auto terms = monomial_terms(e)) list.push_back({std::move(*terms), is_strict});
    }

    struct Generator {
        MonomialTerms terms;
        bool is_strict;
    };
    std::vector<Generator> list;

private:
    static bool is_named(const ex& e, std::initializer_list<const char*> names) {
        if (!GiNaC::is_a<GiNaC::function>(e)) return false;
        const std::string name = GiNaC::ex_to<GiNaC::function>(e).get_name();
        return std::any_of(names.begin(), names.end(), [&](const char* known) { return name == known; });
    }
    static bool is_bounded(const ex& e) { return is_named(e, {"sin", "cos", "tanh"}); }

    static bool is_never_negative(const ex& e) {
        if (is_named(e, {"abs", "absolute"})) return true;
        return is_named(e, {"maximum"}) && std::any_of(e.begin(), e.end(), [](const ex& one) {
                   return one.info(GiNaC::info_flags::nonnegative);
               });
    }

    bool is_positive(const ex& e) const {
        if (e.is_equal(GiNaC::Pi) || is_named(e, {"exp", "cosh"})) return true;
        return std::any_of(above_zero_.begin(), above_zero_.end(), [&](const auto& s) { return e.is_equal(s); });
    }

    SplitMonomial split_of(const ex& monomial) const {
        SplitMonomial result;
        const auto sort = [&](const ex& factor) {
            const bool is_power = GiNaC::is_a<GiNaC::power>(factor);
            const ex base = is_power ? factor.op(0) : factor;
            if (GiNaC::is_a<GiNaC::numeric>(factor)) return;
            if (is_positive(base)) {
                result.known *= factor;
            } else if ((is_power && !factor.op(1).info(GiNaC::info_flags::odd)) || is_never_negative(base)) {
                result.known *= factor;  // an even power, or a root
                result.is_strict = false;
            } else {
                result.open.push_back(factor);
            }
        };
        if (GiNaC::is_a<GiNaC::mul>(monomial))
            std::for_each(monomial.begin(), monomial.end(), sort);
        else
            sort(monomial);
        return result;
    }

    const std::vector<GiNaC::symbol>& above_zero_;
};

/// Is there x ≥ 0 with A x = b, b ≥ 0? The first phase of the simplex method, with Bland's rule.
bool has_solution(std::vector<std::vector<Fraction>> A, std::vector<Fraction> b) {
    const std::size_t rows = A.size(), columns = A[0].size();
    std::vector<std::size_t> basis(rows);
    for (std::size_t r = 0; r < rows; ++r) basis[r] = columns + r;  // artificial variables
    constexpr int most_steps = 2000;
    for (int step = 0; step < most_steps; ++step) {
        std::optional<std::size_t> entering;
        for (std::size_t c = 0; c < columns && !entering; ++c) {
            Fraction gain = 0;
            for (std::size_t r = 0; r < rows; ++r)
                if (basis[r] >= columns) gain = gain + A[r][c];
            if (cln::plusp(gain)) entering = c;
        }
        if (!entering) break;
        std::optional<std::size_t> leaving;
        for (std::size_t r = 0; r < rows; ++r) {
            if (!cln::plusp(A[r][*entering])) continue;
            if (!leaving) {
                leaving = r;
                continue;
            }
            const Fraction here = b[r] * A[*leaving][*entering], best = b[*leaving] * A[r][*entering];
            if (here < best || (here == best && basis[r] < basis[*leaving])) leaving = r;
        }
        if (!leaving) return false;
        const Fraction pivot = A[*leaving][*entering];
        for (Fraction& x : A[*leaving]) x = x / pivot;
        b[*leaving] = b[*leaving] / pivot;
        for (std::size_t r = 0; r < rows; ++r) {
            const Fraction factor = A[r][*entering];
            if (r == *leaving || cln::zerop(factor)) continue;
            for (std::size_t c = 0; c < columns; ++c) A[r][c] = A[r][c] - factor * A[*leaving][c];
            b[r] = b[r] - factor * b[*leaving];
        }
        basis[*leaving] = *entering;
    }
    for (std::size_t r = 0; r < rows; ++r)
        if (basis[r] >= columns && !cln::zerop(b[r])) return false;
    return true;
}

/// (x + b/2a)² for a x² + b x with numbers a, b.
void add_squares(const ex& given, Generators& generators) {
    const ex e = given.expand();
    const auto terms = monomial_terms(e);
    if (!terms) return;
    for (const auto& term : *terms) {
        const ex& square = term.first;
        if (!GiNaC::is_a<GiNaC::power>(square) || !square.op(1).is_equal(2)) continue;
        const ex x = square.op(0), a = e.coeff(x, 2), b = e.coeff(x, 1);
        if (GiNaC::is_a<GiNaC::symbol>(x) && GiNaC::is_a<GiNaC::numeric>(a) && GiNaC::is_a<GiNaC::numeric>(b))
            generators.keep(GiNaC::pow(x + b / (2 * a), 2).expand(), false);
    }
}

}  // namespace

bool is_impossible(const std::vector<ex>& positive, const std::vector<GiNaC::symbol>& above_zero) {
    Generators generators(above_zero);
    for (const ex& e : positive) generators.keep(e, true);
    if (generators.list.size() < positive.size()) return false;
    for (const ex& e : positive) add_squares(e, generators);
    std::vector<ex> monomials;
    for (const auto& one : generators.list)
        for (const auto& term : one.terms) {
            const ex& monomial = term.first;
            if (!monomial.is_equal(1) && std::none_of(monomials.begin(), monomials.end(),
                                                      [&](const ex& m) { return m.is_equal(monomial); }))
                monomials.push_back(monomial);
        }
    for (const ex& monomial : monomials) generators.add(monomial);
    // A row for each monomial, one for the constant with what it lacks to zero, and one that says that a strict
    // one is used.
    std::map<ex, std::size_t, GiNaC::ex_is_less> rows;
    for (const auto& one : generators.list)
        for (const auto& [monomial, coefficient] : one.terms) rows.try_emplace(monomial, rows.size());
    const std::size_t constant = rows.try_emplace(ex(1), rows.size()).first->second;
    const std::size_t columns = generators.list.size() + 1;
    if (columns > most_columns) return false;
    std::vector<std::vector<Fraction>> A(rows.size() + 1, std::vector<Fraction>(columns, 0));
    std::vector<Fraction> b(rows.size() + 1, 0);
    for (std::size_t c = 0; c < generators.list.size(); ++c) {
        for (const auto& [monomial, coefficient] : generators.list[c].terms) A[rows.at(monomial)][c] = coefficient;
        A.back()[c] = generators.list[c].is_strict ? 1 : 0;
    }
    A[constant].back() = 1;
    b.back() = 1;
    return has_solution(std::move(A), std::move(b));
}

}  // namespace alembert
