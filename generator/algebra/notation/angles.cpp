// SPDX-License-Identifier: GPL-2.0-or-later
//
//     cos(nβ) + i·sin(nβ) = (cos β + i·sin β)ⁿ,   cos(α+β) = cos α cos β − sin α sin β,   sin² = 1 − cos²
#include "algebra/notation/angles.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <cln/integer.h>

namespace alembert {

namespace {

using Kind = AtomNode::Kind;
using Cost = std::function<int(const Polynomial&)>;

/// The search tries about 4ⁿ forms of n angles, each once for each of its terms. With more angles than this it
/// would take seconds.
constexpr std::size_t most_angles = 3;
constexpr std::size_t most_terms = 64;

/// An angle of which others are whole multiples or sums, with its sine and cosine as variables.
struct Angle {
    explicit Angle(const Polynomial& angle)
        : arg(angle), sine(compound_atom(Kind::sine, {angle})), cosine(compound_atom(Kind::cosine, {angle})) {}
    Polynomial arg;
    Atom sine, cosine;
};

struct Wave {
    Polynomial cosine, sine;
};

Wave add(const Wave& a, const Wave& b) {
    return {a.cosine * b.cosine - a.sine * b.sine, a.sine * b.cosine + a.cosine * b.sine};
}

Wave multiple(const Angle& angle, int n) {
    const Wave one{Polynomial(angle.cosine), Rational(n < 0 ? -1 : 1) * Polynomial(angle.sine)};
    Wave result{Rational(1), {}};
    for (int i = 0; i < std::abs(n); ++i) result = add(result, one);
    return result;
}

using Args = std::map<Polynomial, std::vector<int>, PolynomialLess>;  ///< an argument in terms of the angles

std::vector<Polynomial> arguments(const Polynomial& normal_form) {
    std::vector<Polynomial> result;
    for (const Term& term : normal_form.terms())
        for (const Factor& factor : term.monomial)
            if (factor.atom->is_circular()) result.push_back(factor.atom->args[0]);
    std::sort(result.begin(), result.end(), PolynomialLess());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
}

/// Replaces the sines and cosines of `args` by polynomials in those of `angles`.
Polynomial expand(const Polynomial& normal_form, const Args& args, const std::vector<Angle>& angles) {
    std::map<Polynomial, Wave, PolynomialLess> waves;
    for (const auto& [arg, multiples] : args) {
        Wave wave{Rational(1), {}};
        for (std::size_t i = 0; i < angles.size(); ++i)
            if (multiples[i] != 0) wave = add(wave, multiple(angles[i], multiples[i]));
        waves.emplace(arg, std::move(wave));
    }
    std::vector<Term> terms;
    for (const Term& term : normal_form.terms()) {
        Polynomial wave = Rational(1);
        Monomial rest;
        for (const Factor& factor : term.monomial) {
            const auto found = factor.atom->is_circular() ? waves.find(factor.atom->args[0]) : waves.end();
            if (found == waves.end())
                rest.push_back(factor);
            else
                wave = factor.atom->kind == Kind::sine ? found->second.sine : found->second.cosine;
        }
        for (const Term& part : wave.terms())
            terms.push_back({rest * part.monomial, term.coefficient * part.coefficient});
    }
    return Polynomial::collect(std::move(terms));
}

int exponent_of(const Monomial& monomial, const Atom& atom) {
    for (const Factor& factor : monomial)
        if (compare(factor.atom, atom) == 0) return to_int(factor.exponent);
    return 0;
}

/// Applies from² = 1 − to² as often as possible.
Polynomial eliminate_square(const Polynomial& polynomial, const Atom& from, const Atom& to) {
    const Polynomial square = Rational(1) - Polynomial(to, 2);
    std::vector<Term> terms;
    for (const Term& term : polynomial.terms()) {
        const int squares = exponent_of(term.monomial, from) / 2;
        if (squares <= 0) {
            terms.push_back(term);
            continue;
        }
        const Monomial rest = term.monomial * Monomial{{from, Rational(-2 * squares)}};
        const Polynomial expanded = power(square, squares);
        for (const Term& part : expanded.terms())
            terms.push_back({rest * part.monomial, term.coefficient * part.coefficient});
    }
    return Polynomial::collect(std::move(terms));
}

/// Inserts 1 = sin² + cos² into the terms without the angle if the others have degree two in it: A·sin² + C·cos².
Polynomial homogeneous(const Polynomial& polynomial, const Angle& angle) {
    std::vector<Term> terms;
    for (const Term& term : polynomial.terms()) {
        const int degree = exponent_of(term.monomial, angle.sine) + exponent_of(term.monomial, angle.cosine);
        if (degree > 2) return polynomial;
        if (degree == 0) {
            terms.push_back({term.monomial * Monomial{{angle.sine, 2}}, term.coefficient});
            terms.push_back({term.monomial * Monomial{{angle.cosine, 2}}, term.coefficient});
        } else {
            terms.push_back(term);
        }
    }
    return Polynomial::collect(std::move(terms));
}

/// The best form so far. A later candidate has to be strictly better.
struct Choice {
    Polynomial value;
    int cost;

    void offer(Polynomial candidate, const Cost& measure) {
        if (candidate == value) return;
        const int offered = measure(candidate);
        if (offered >= cost) return;
        value = std::move(candidate);
        cost = offered;
    }
};

enum class Forms { level, all };

/// The best form of an expanded polynomial, angle after angle: once the form of the first angle's squares is
/// chosen, the coefficient of each of its products is a polynomial in the other angles, which has a best form of
/// its own. (A·sin²φ + B·cos²φ)·sin²θ + C·cos²θ
Polynomial reduce(const Polynomial& expanded, const Angle* angle, const Angle* end, Forms forms,
                  const Cost& cost) {
    if (angle == end) return expanded;
    const auto is_own = [&](const AtomNode& atom) {
        return compare(atom, *angle->sine) == 0 || compare(atom, *angle->cosine) == 0;
    };
    const auto settle = [&](const Polynomial& form) {
        if (angle + 1 == end) return form;
        Polynomial result;
        for (const Polynomial& group : partition(form, is_own)) {
            const Monomial own = part(group.terms()[0].monomial, is_own);
            const Polynomial rest = reduce(divide(group, own), angle + 1, end, forms, cost);
            result = result + Polynomial::collect({{own, 1}}) * rest;
        }
        return result;
    };
    const Polynomial raw = settle(expanded);
    Choice best{raw, cost(raw)};
    best.offer(settle(homogeneous(expanded, *angle)), cost);
    if (forms == Forms::level) return best.value;
    best.offer(settle(eliminate_square(expanded, angle->sine, angle->cosine)), cost);
    best.offer(settle(eliminate_square(expanded, angle->cosine, angle->sine)), cost);
    return best.value;
}

Polynomial reduce(const Polynomial& expanded, const std::vector<Angle>& angles, Forms forms, const Cost& cost) {
    const auto along = [&](const std::vector<Angle>& order) {
        const auto best_of = [&](const Polynomial& polynomial) {
            return reduce(polynomial, order.data(), order.data() + order.size(), forms, cost);
        };
        const Polynomial whole = best_of(expanded);
        Choice best{whole, cost(whole)};
        // A·sin²φ + B·cos²φ − C: the terms of each parameter may have a form of their own
        Polynomial each;
        for (const Polynomial& group : partition(expanded, [](const AtomNode& atom) { return atom.steady; }))
            each = each + best_of(group);
        best.offer(each, cost);
        return best;
    };
    Choice best = along(angles);
    if (angles.size() > 1) {
        Choice backward = along({angles.rbegin(), angles.rend()});
        if (backward.cost < best.cost) best = std::move(backward);
    }
    return best.value;
}

struct Basis {
    std::vector<Angle> angles;
    Args args;
    bool expands = false;  ///< whether some argument is not itself one of the angles
};

/// One angle for all arguments that are proportional to each other: 2θ and 3θ are multiples of θ.
Basis multiples(const std::vector<Polynomial>& args) {
    std::map<Polynomial, Rational, PolynomialLess> directions;
    for (const Polynomial& arg : args) {
        const Rational scale = content(arg);
        const Polynomial direction = (1 / scale) * arg;
        const auto [entry, is_new] = directions.emplace(direction, 1);
        entry->second = Rational(cln::lcm(cln::numerator(entry->second), cln::denominator(scale)));
    }
    Basis basis;
    std::vector<Polynomial> names;
    for (const auto& [direction, denominator] : directions) {
        names.push_back(direction);
        basis.angles.emplace_back((1 / denominator) * direction);
    }
    for (const Polynomial& arg : args) {
        const Rational scale = content(arg);
        const auto index =
            static_cast<std::size_t>(std::find(names.begin(), names.end(), (1 / scale) * arg) - names.begin());
        const Rational n = scale * directions.at(names[index]);
        if (n > 6) continue;
        std::vector<int> row(names.size(), 0);
        row[index] = to_int(n);
        basis.expands = basis.expands || row[index] != 1;
        basis.args.emplace(arg, std::move(row));
    }
    return basis;
}

/// The arguments as whole combinations of the given angles; none if one of them is no such combination.
std::optional<Basis> combinations(const std::vector<Polynomial>& args, const std::vector<Polynomial>& angles) {
    Basis basis;
    for (const Polynomial& angle : angles) basis.angles.emplace_back(angle);
    for (const Polynomial& arg : args) {
        std::vector<int> row;
        Polynomial rest = arg;
        for (const Polynomial& angle : angles) {
            const Term& lead = angle.terms()[0];
            Rational n = 0;
            for (const Term& term : rest.terms())
                if (compare(term.monomial, lead.monomial) == 0) n = term.coefficient / lead.coefficient;
            if (!is_integer(n) || cln::abs(n) > 4) return std::nullopt;
            rest = rest - n * angle;
            row.push_back(to_int(n));
        }
        if (!rest.is_zero()) return std::nullopt;
        basis.expands = basis.expands || std::count(row.begin(), row.end(), 0) + 1 != std::ssize(row);
        basis.args.emplace(arg, std::move(row));
    }
    return basis;
}

/// One angle for each symbol (or product of symbols) in the arguments.
std::optional<Basis> singles(const std::vector<Polynomial>& args) {
    std::map<Polynomial, cln::cl_I, PolynomialLess> parts;
    for (const Polynomial& arg : args)
        for (const Term& term : arg.terms()) {
            for (const Factor& factor : term.monomial)
                if (factor.atom->kind == Kind::pi) return std::nullopt;
            const auto [entry, is_new] = parts.emplace(Polynomial::collect({{term.monomial, 1}}), 1);
            entry->second = cln::lcm(entry->second, cln::denominator(term.coefficient));
        }
    if (parts.size() > 4) return std::nullopt;
    std::vector<Polynomial> angles;
    for (const auto& [part, denominator] : parts) angles.push_back((1 / Rational(denominator)) * part);
    return combinations(args, angles);
}

/// Half sums and half differences: ½·sin(φ+θ1−θ2) + ½·sin(φ−θ1+θ2) = sin φ · cos(θ1−θ2).
std::vector<Basis> pairs(const std::vector<Polynomial>& args) {
    std::vector<Basis> result;
    if (args.size() > 4) return result;
    for (std::size_t i = 0; i < args.size(); ++i) {
        for (std::size_t j = i + 1; j < args.size(); ++j) {
            Polynomial a = (Rational(1) / 2) * (args[i] + args[j]);
            Polynomial b = (Rational(1) / 2) * (args[i] - args[j]);
            if (a.is_zero() || b.is_zero()) continue;
            if (b.terms()[0].coefficient < 0) b = -b;
            if (!is_integer(content(a)) || !is_integer(content(b))) continue;
            // The equations are solved by their leading terms, which therefore must differ.
            if (compare(a.terms()[0].monomial, b.terms()[0].monomial) == 0) continue;
            if (std::any_of(a.terms().begin(), a.terms().end(),
                            [&](const Term& term) { return compare(term.monomial, b.terms()[0].monomial) == 0; }))
                std::swap(a, b);
            if (auto basis = combinations(args, {a, b})) result.push_back(std::move(*basis));
        }
    }
    return result;
}

/// A product of functions of different angles becomes functions of arguments whose half sum and half difference
/// are whole combinations.
bool may_be_product(const std::vector<Polynomial>& args) {
    for (std::size_t i = 0; i < args.size(); ++i) {
        for (std::size_t j = i + 1; j < args.size(); ++j) {
            if (args[i].size() == 1 && args[j].size() == 1) continue;
            const Rational half = Rational(1) / 2;
            if (is_integer(half * content(args[i] + args[j])) && is_integer(half * content(args[i] - args[j])))
                return true;
        }
    }
    return false;
}

}  // namespace

Polynomial unfold(const Polynomial& normal_form, const Cost& cost) {
    const std::vector<Polynomial> args = arguments(normal_form);
    if (args.empty() || args.size() > 24 || normal_form.size() > 200) return normal_form;
    Choice best{normal_form, 0};
    const Basis own = multiples(args);
    const bool compound = may_be_product(args);
    if (!own.expands && !compound) return normal_form;
    best.cost = cost(normal_form);
    const auto is_small = [](const Polynomial& expanded) { return expanded.size() <= most_terms; };
    if (own.expands && own.angles.size() <= most_angles) {
        const Polynomial expanded = expand(normal_form, own.args, own.angles);
        if (is_small(expanded)) {
            const Polynomial level = reduce(expanded, own.angles, Forms::level, cost);
            const int offered = cost(level);
            if (offered <= best.cost) best = {level, offered};
            best.offer(reduce(expanded, own.angles, Forms::all, cost), cost);
        }
    }
    if (!compound) return best.value;
    std::vector<Basis> bases = pairs(args);
    if (auto basis = singles(args)) bases.push_back(std::move(*basis));
    for (const Basis& basis : bases) {
        if (!basis.expands || basis.angles.size() > most_angles) continue;
        const Polynomial expanded = expand(normal_form, basis.args, basis.angles);
        if (!is_small(expanded)) continue;
        best.offer(reduce(expanded, basis.angles, Forms::level, cost), cost);
        best.offer(reduce(expanded, basis.angles, Forms::all, cost), cost);
    }
    return best.value;
}

}  // namespace alembert
