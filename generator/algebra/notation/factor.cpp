// SPDX-License-Identifier: GPL-2.0-or-later
//
// P = a·v + b, linear in v, has the factors of gcd(a, b) and one more. That factors nearly every coefficient of a
// mechanism. Most polynomials that are linear in no variable are soon proved to be irreducible; the others are
// given to GiNaC's factor (square-free, then multivariate Hensel lifting; Geddes, Czapor & Labahn, Algorithms for
// Computer Algebra (1992), chapters 6 and 8).
#include "algebra/notation/factor.hpp"

#include <algorithm>
#include <optional>

#include "algebra/notation/exponent_lattice.hpp"
#include "algebra/notation/irreducible.hpp"

namespace alembert {

namespace {

/// Bounds on what is given to GiNaC, whose time has no bound of its own: terms times variables times the sum of
/// the variables' degrees, which is 36 for (a+b·sin θ)². The tops and four-bar linkages of the scenes need up to
/// 2000; a call then takes milliseconds, and seconds for much larger values. Degrees count in the smallest power
/// that occurs: a^3.1416 beside a is of degree 3927 in a^(1/1250), and the call would never end.
constexpr int most_for_ginac = 2000;
constexpr int highest_degree = 12;
constexpr int most_searches = 400;      // the most searches of one Factorizer; each takes about a millisecond
constexpr int longest_quotient = 1000;  // in terms; (x^1000.1 − 1)/(x^0.1 − 1) has 10001

struct AtomLess {
    bool operator()(const Atom& a, const Atom& b) const { return compare(a, b) < 0; }
};

/// How often an atom occurs, and its highest exponent.
struct Occurrence {
    int terms = 0;
    Rational highest = 0;
    Rational unit = 1;  ///< 1/n; every exponent is a multiple of it
};
using Occurrences = std::map<Atom, Occurrence, AtomLess>;

Occurrences occurrences(const Polynomial& polynomial) {
    Occurrences result;
    for (const Term& term : polynomial.terms()) {
        for (const Factor& factor : term.monomial) {
            Occurrence& found = result[factor.atom];
            found.unit = common_divisor(found.unit, factor.exponent);
            ++found.terms;
            if (factor.exponent > found.highest) found.highest = factor.exponent;
        }
    }
    return result;
}

bool is_small(const Polynomial& polynomial, const Occurrences& atoms) {
    Rational total = 0;
    for (const auto& [atom, occurrence] : atoms) {
        const Rational degree = occurrence.highest / occurrence.unit;
        if (degree > highest_degree) return false;
        total = total + degree;
    }
    return total * Rational(polynomial.size() * atoms.size()) <= most_for_ginac;
}

/// Applies the test in the variable of the lowest degree, whose images are irreducible most often.
bool is_surely_irreducible(const Polynomial& polynomial, const Occurrences& atoms) {
    const auto degree = [](const auto& entry) { return Rational(entry.second.highest / entry.second.unit); };
    const auto lowest = std::min_element(atoms.begin(), atoms.end(),
                                         [&](const auto& a, const auto& b) { return degree(a) < degree(b); });
    return is_surely_irreducible(polynomial, lowest->first, lowest->second.unit);
}

/// dividend/divisor if there is no remainder, by lexicographic division; the leading term of the divisor is its
/// first.
std::optional<Polynomial> exact_quotient(const Polynomial& dividend, const Polynomial& divisor) {
    const Term& lead = divisor.terms()[0];
    Polynomial rest = dividend;
    std::vector<Term> quotient;
    while (!rest.is_zero()) {
        const Term& first = rest.terms()[0];
        Monomial ratio = first.monomial * power(lead.monomial, -1);
        if (std::any_of(ratio.begin(), ratio.end(), [](const Factor& factor) { return factor.exponent < 0; }))
            return std::nullopt;
        if (quotient.size() == longest_quotient) return std::nullopt;
        quotient.push_back({std::move(ratio), first.coefficient / lead.coefficient});
        rest = rest - Polynomial::collect({quotient.back()}) * divisor;
    }
    return Polynomial::collect(std::move(quotient));
}

/// a·x² + b·y² with a, b > 0 has no factors over the rationals.
bool is_sum_of_squares(const Polynomial& polynomial) {
    const auto is_square = [](const Monomial& monomial) {
        return monomial.size() <= 1 && (monomial.empty() || monomial[0].exponent == 2);
    };
    return polynomial.size() == 2 && is_square(polynomial.terms()[0].monomial) &&
           is_square(polynomial.terms()[1].monomial) &&
           polynomial.terms()[0].coefficient * polynomial.terms()[1].coefficient > 0;
}

/// Translates a polynomial to GiNaC's, in as few variables as it can be written in.
class Translation {
public:
    Translation(const Polynomial& polynomial, const Occurrences& atoms)
        : atoms_(atoms), polynomial_(polynomial), lattice_(exponents(polynomial)) {
        for (std::size_t k = 0; k < lattice_.rank(); ++k) stand_in_.emplace_back();
    }

    /// Terms times variables times the sum of their degrees.
    bool is_small() const {
        long total = 0;
        for (std::size_t k = 0; k < lattice_.rank(); ++k) {
            long degree = 0;
            for (const auto& row : lattice_.reduced()) degree = std::max(degree, row[k]);
            if (degree > highest_degree) return false;
            total += degree;
        }
        return total * static_cast<long>(lattice_.reduced().size() * lattice_.rank()) <= most_for_ginac;
    }

    GiNaC::ex whole() const {
        const std::vector<ExponentLattice::Exponents> rows = lattice_.reduced();
        GiNaC::exvector terms;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            GiNaC::exvector factors{expression(polynomial_.terms()[i].coefficient)};
            for (std::size_t k = 0; k < rows[i].size(); ++k)
                factors.push_back(GiNaC::pow(stand_in_[k], static_cast<int>(rows[i][k])));
            terms.push_back(GiNaC::mul(factors));
        }
        return GiNaC::add(terms);
    }

    /// A factor of the whole.
    Polynomial from(const GiNaC::ex& factor) const {
        const GiNaC::ex sum = factor.expand();
        std::vector<ExponentLattice::Exponents> rows;
        std::vector<Rational> coefficients;
        for (std::size_t i = 0; i < (GiNaC::is_a<GiNaC::add>(sum) ? sum.nops() : 1); ++i) {
            GiNaC::ex term = GiNaC::is_a<GiNaC::add>(sum) ? sum.op(i) : sum;
            ExponentLattice::Exponents& row = rows.emplace_back();
            for (const GiNaC::symbol& symbol : stand_in_) {
                row.push_back(term.degree(symbol));
                term = term.coeff(symbol, term.degree(symbol));
            }
            coefficients.push_back(cln::the<cln::cl_RA>(GiNaC::ex_to<GiNaC::numeric>(term).to_cl_N()));
        }
        std::vector<Term> terms;
        const std::vector<ExponentLattice::Exponents> whole = lattice_.restored(rows);
        for (std::size_t i = 0; i < whole.size(); ++i) {
            Polynomial monomial = Rational(1);
            std::size_t k = 0;
            for (const auto& [atom, occurrence] : atoms_) {
                const Rational exponent = occurrence.unit * Rational(whole[i][k++]);
                if (exponent != 0) monomial = monomial * Polynomial(atom, exponent);
            }
            terms.push_back({monomial.terms()[0].monomial, coefficients[i]});
        }
        return Polynomial::collect(std::move(terms));
    }

private:
    std::vector<ExponentLattice::Exponents> exponents(const Polynomial& polynomial) const {
        std::vector<ExponentLattice::Exponents> result;
        for (const Term& term : polynomial.terms()) {
            ExponentLattice::Exponents& row = result.emplace_back();
            for (const auto& [atom, occurrence] : atoms_) {
                const auto here =
                    std::find_if(term.monomial.begin(), term.monomial.end(),
                                 [&of = atom](const Factor& factor) { return compare(factor.atom, of) == 0; });
                row.push_back(here == term.monomial.end()
                                  ? 0
                                  : cln::cl_I_to_long(cln::numerator(here->exponent / occurrence.unit)));
            }
        }
        return result;
    }

    const Occurrences& atoms_;
    const Polynomial& polynomial_;
    ExponentLattice lattice_;
    std::vector<GiNaC::symbol> stand_in_;
};

Polynomial with_positive_lead(const Polynomial& polynomial) {
    const Rational c = content(polynomial);
    return (1 / (polynomial.terms()[0].coefficient < 0 ? Rational(-c) : c)) * polynomial;
}

/// The factors of a primitive polynomial with positive leading coefficient and without a monomial factor.
Factorization factors_by_ginac(const Polynomial& polynomial, const Occurrences& atoms) {
    Factorization result;
    const Translation translation(polynomial, atoms);
    if (!translation.is_small()) {
        result.sums.emplace_back(polynomial, 1);
        return result;
    }
    const GiNaC::ex factored = GiNaC::factor(translation.whole());
    const auto add = [&](const GiNaC::ex& e) {
        const bool is_power = GiNaC::is_a<GiNaC::power>(e);
        const Polynomial base = translation.from(is_power ? e.op(0) : e);
        if (base.is_constant()) return;
        const int exponent = is_power ? GiNaC::ex_to<GiNaC::numeric>(e.op(1)).to_int() : 1;
        result.sums.emplace_back(with_positive_lead(base), exponent);
    };
    if (GiNaC::is_a<GiNaC::mul>(factored))
        for (std::size_t i = 0; i < factored.nops(); ++i) add(factored.op(i));
    else
        add(factored);
    return result;
}

}  // namespace

Factorization Factorizer::operator()(const Polynomial& polynomial) {
    Factorization result;
    result.monomial = common_monomial(polynomial);
    result.unit = content(polynomial);
    Polynomial primitive = divide(polynomial, result.monomial, result.unit);
    if (primitive.terms()[0].coefficient < 0) {
        primitive = -primitive;
        result.unit = -result.unit;
    }
    if (primitive.size() == 1) return result;
    auto found = memo_.find(primitive);
    if (found == memo_.end()) found = memo_.emplace(primitive, irreducible_factors(primitive)).first;
    result.unit = result.unit * found->second.unit;
    result.sums = found->second.sums;
    return result;
}

Factorization Factorizer::irreducible_factors(const Polynomial& polynomial) {
    Factorization result;
    if (polynomial.size() > 60 || is_sum_of_squares(polynomial)) {
        result.sums.emplace_back(polynomial, 1);
        return result;
    }
    const Occurrences atoms = occurrences(polynomial);
    const AtomNode* linear = nullptr;
    int fewest = 0;
    for (const auto& [atom, occurrence] : atoms) {
        if (occurrence.highest != occurrence.unit || (linear && occurrence.terms >= fewest)) continue;
        linear = atom.get();
        fewest = occurrence.terms;
    }
    const bool is_searched = !linear && is_small(polynomial, atoms);
    if (linear)
        split_linear(polynomial, *linear, result);
    else if (is_searched && !is_surely_irreducible(polynomial, atoms) && ++searches_ <= most_searches)
        result = factors_by_ginac(polynomial, atoms);
    else
        result.sums.emplace_back(polynomial, 1);
    std::sort(result.sums.begin(), result.sums.end(),
              [](const auto& a, const auto& b) { return compare(a.first, b.first) < 0; });
    // The factors are known up to signs; the product of their leading terms determines the sign.
    Polynomial check = Rational(1);
    for (const auto& [sum, exponent] : result.sums) check = check * power(sum, exponent);
    result.unit = polynomial.terms()[0].coefficient / check.terms()[0].coefficient;
    return result;
}

void Factorizer::split_linear(const Polynomial& polynomial, const AtomNode& linear, Factorization& result) {
    std::vector<Term> with, without;
    for (const Term& term : polynomial.terms()) {
        const bool has = std::any_of(term.monomial.begin(), term.monomial.end(),
                                     [&](const Factor& factor) { return compare(*factor.atom, linear) == 0; });
        (has ? with : without).push_back(term);
    }
    Polynomial rest = polynomial;
    if (with.size() > 1) {
        const Polynomial b = Polynomial::collect(std::move(without));
        Polynomial left = b;
        for (const auto& [sum, exponent] : (*this)(Polynomial::collect(std::move(with))).sums) {
            int times = 0;
            while (times < exponent) {
                const std::optional<Polynomial> quotient = exact_quotient(left, sum),
                                                remaining = exact_quotient(rest, sum);
                if (!quotient || !remaining) break;
                left = *quotient;
                rest = *remaining;
                ++times;
            }
            if (times > 0) result.sums.emplace_back(sum, times);
        }
    }
    result.sums.emplace_back(with_positive_lead(rest), 1);
}

}  // namespace alembert
