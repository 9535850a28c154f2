// SPDX-License-Identifier: GPL-2.0-or-later
#include "algebra/symbolic/polynomial.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <tuple>
#include <utility>

#include <cln/integer.h>

#include "algebra/symbolic/functions.hpp"
#include "base/language/say.hpp"

namespace alembert {

namespace {

bool steady(const Polynomial& polynomial) {
    for (const Term& term : polynomial.terms())
        for (const Factor& factor : term.monomial)
            if (!factor.atom->steady) return false;
    return true;
}

bool is_primitive(const Polynomial& polynomial) {
    const Monomial common = common_monomial(polynomial);
    const bool has_common = std::any_of(common.begin(), common.end(),
                                        [](const Factor& factor) { return !factor.atom->is_circular(); });
    return !polynomial.is_zero() && !has_common && content(polynomial) == 1 &&
           polynomial.terms()[0].coefficient > 0;
}

int sign(int value) {
    return value < 0 ? -1 : value > 0 ? 1 : 0;
}

int compare_symbols(const SymbolInfo& a, const SymbolInfo& b) {
    const auto key = [](const SymbolInfo& info) {
        return std::pair(info.kind == SymbolInfo::Kind::coordinate ? 0 : 1, info.rank);
    };
    return key(a) < key(b) ? -1 : key(a) > key(b) ? 1 : 0;
}

/// For atoms that compare as equal: do their symbols belong to the same scene?
int compare_owners(const AtomNode& a, const AtomNode& b) {
    if (&a == &b) return 0;
    if (a.kind == AtomNode::Kind::symbol) return a.symbol.compare(b.symbol);
    for (std::size_t i = 0; i < a.args.size(); ++i)
        for (std::size_t k = 0; k < a.args[i].size(); ++k) {
            const Monomial &m = a.args[i].terms()[k].monomial, &n = b.args[i].terms()[k].monomial;
            for (std::size_t j = 0; j < m.size(); ++j)
                if (const int order = compare_owners(*m[j].atom, *n[j].atom); order != 0) return order;
        }
    return 0;
}

}  // namespace

Polynomial::Polynomial(const Rational& constant) {
    if (!cln::zerop(constant)) terms_.push_back({{}, constant});
}

Polynomial::Polynomial(Atom atom, const Rational& exponent) {
    terms_.push_back({cln::zerop(exponent) ? Monomial{} : Monomial{{std::move(atom), exponent}}, 1});
}

Polynomial Polynomial::collect(std::vector<Term> terms) {
    std::sort(terms.begin(), terms.end(),
              [](const Term& a, const Term& b) { return compare(a.monomial, b.monomial) < 0; });
    Polynomial result;
    for (Term& term : terms) {
        if (!result.terms_.empty() && compare(result.terms_.back().monomial, term.monomial) == 0) {
            result.terms_.back().coefficient = result.terms_.back().coefficient + term.coefficient;
        } else {
            if (!result.terms_.empty() && cln::zerop(result.terms_.back().coefficient)) result.terms_.pop_back();
            result.terms_.push_back(std::move(term));
        }
    }
    if (!result.terms_.empty() && cln::zerop(result.terms_.back().coefficient)) result.terms_.pop_back();
    return result;
}

bool Polynomial::is_one() const {
    return terms_.size() == 1 && terms_[0].monomial.empty() && terms_[0].coefficient == 1;
}

Atom symbol_atom(const GiNaC::symbol& symbol, const SymbolInfo& info) {
    auto node = std::make_shared<AtomNode>();
    node->info = info;
    node->symbol = symbol;
    node->steady = info.kind == SymbolInfo::Kind::parameter || info.kind == SymbolInfo::Kind::function;
    return node;
}

Atom pi_atom() {
    static const Atom pi = [] {
        auto node = std::make_shared<AtomNode>();
        node->kind = AtomNode::Kind::pi;
        return node;
    }();
    return pi;
}

Atom compound_atom(AtomNode::Kind kind, std::vector<Polynomial> args, std::string name) {
    auto node = std::make_shared<AtomNode>();
    node->kind = kind;
    node->name = std::move(name);
    node->args = std::move(args);
    node->steady = std::all_of(node->args.begin(), node->args.end(), steady);
    if (kind == AtomNode::Kind::base) node->primitive = is_primitive(node->args.at(0));
    // Equal atoms are mostly stored as one object, which makes comparisons short.
    constexpr std::size_t most = 4096;
    static auto& known = *new std::set<Atom, decltype([](const Atom& a, const Atom& b) {
                                           const int order = compare(a, b);
                                           return order != 0 ? order < 0 : compare_owners(*a, *b) < 0;
                                       })>;
    if (known.size() >= most) known.clear();
    return *known.insert(std::move(node)).first;
}

int compare(const AtomNode& a, const AtomNode& b) {
    if (&a == &b) return 0;
    if (a.kind != b.kind) return a.kind < b.kind ? -1 : 1;
    if (a.kind == AtomNode::Kind::symbol) return compare_symbols(a.info, b.info);
    if (const int order = sign(a.name.compare(b.name)); order != 0) return order;
    if (a.args.size() != b.args.size()) return a.args.size() < b.args.size() ? -1 : 1;
    for (std::size_t i = 0; i < a.args.size(); ++i)
        if (const int order = compare(a.args[i], b.args[i]); order != 0) return order;
    return 0;
}

int compare(const Atom& a, const Atom& b) {
    return compare(*a, *b);
}

int compare(const Monomial& a, const Monomial& b) {
    const std::size_t common = std::min(a.size(), b.size());
    for (std::size_t i = 0; i < common; ++i) {
        if (a[i].atom != b[i].atom)
            if (const int order = compare(*a[i].atom, *b[i].atom); order != 0) return order;
        if (a[i].exponent.pointer == b[i].exponent.pointer)
            continue;  // CLN stores small whole numbers in the pointer itself
        if (const int order = sign(static_cast<int>(cln::compare(b[i].exponent, a[i].exponent))); order != 0)
            return order;
    }
    return a.size() == b.size() ? 0 : a.size() > b.size() ? -1 : 1;
}

int compare(const Polynomial& a, const Polynomial& b) {
    if (a.size() != b.size()) return a.size() < b.size() ? -1 : 1;
    for (std::size_t i = 0; i < a.size(); ++i)
        if (const int order = compare(a.terms()[i].monomial, b.terms()[i].monomial); order != 0) return order;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const auto order = cln::compare(a.terms()[i].coefficient, b.terms()[i].coefficient);
        if (order != 0) return order < 0 ? -1 : 1;
    }
    return 0;
}

Polynomial operator+(const Polynomial& a, const Polynomial& b) {
    std::vector<Term> terms = a.terms();
    terms.insert(terms.end(), b.terms().begin(), b.terms().end());
    return Polynomial::collect(std::move(terms));
}

Polynomial operator-(const Polynomial& a) {
    return Rational(-1) * a;
}

Polynomial operator-(const Polynomial& a, const Polynomial& b) {
    return a + (-b);
}

Polynomial operator*(const Rational& a, const Polynomial& b) {
    if (cln::zerop(a)) return {};
    std::vector<Term> terms = b.terms();
    for (Term& term : terms) term.coefficient = a * term.coefficient;
    return Polynomial::collect(std::move(terms));
}

Polynomial operator*(const Polynomial& a, const Polynomial& b) {
    std::vector<Term> terms;
    terms.reserve(a.size() * b.size());
    for (const Term& x : a.terms())
        for (const Term& y : b.terms()) terms.push_back({x.monomial * y.monomial, x.coefficient * y.coefficient});
    return Polynomial::collect(std::move(terms));
}

Polynomial power(const Polynomial& base, int exponent) {
    Polynomial result = Rational(1);
    for (int i = 0; i < exponent; ++i) result = result * base;
    return result;
}

Monomial operator*(const Monomial& a, const Monomial& b) {
    Monomial result;
    result.reserve(a.size() + b.size());
    auto x = a.begin();
    auto y = b.begin();
    while (x != a.end() || y != b.end()) {
        const int order = x == a.end() ? 1 : y == b.end() ? -1 : compare(x->atom, y->atom);
        if (order < 0) {
            result.push_back(*x++);
        } else if (order > 0) {
            result.push_back(*y++);
        } else {
            const Rational exponent = x->exponent + y->exponent;
            if (!cln::zerop(exponent)) result.push_back({x->atom, exponent});
            ++x;
            ++y;
        }
    }
    return result;
}

Monomial power(const Monomial& base, const Rational& exponent) {
    if (cln::zerop(exponent)) return {};
    Monomial result = base;
    for (Factor& factor : result) factor.exponent = factor.exponent * exponent;
    return result;
}

Monomial common_monomial(const Polynomial& polynomial) {
    if (polynomial.is_zero()) return {};
    const auto lower = [](const Monomial& a, const Monomial& b) {
        Monomial result;
        auto x = a.begin();
        auto y = b.begin();
        const auto keep_if_negative = [&](const Factor& factor) {
            if (factor.exponent < 0) result.push_back(factor);
        };
        while (x != a.end() || y != b.end()) {
            const int order = x == a.end() ? 1 : y == b.end() ? -1 : compare(x->atom, y->atom);
            if (order < 0) {
                keep_if_negative(*x++);
            } else if (order > 0) {
                keep_if_negative(*y++);
            } else {
                result.push_back(x->exponent < y->exponent ? *x : *y);
                ++x;
                ++y;
            }
        }
        return result;
    };
    Monomial result = polynomial.terms().front().monomial;
    for (const Term& term : polynomial.terms()) result = lower(result, term.monomial);
    return result;
}

Monomial shared_monomial(const Polynomial& polynomial) {
    if (polynomial.is_zero()) return {};
    Monomial result;
    for (Factor shared : polynomial.terms().front().monomial) {
        const bool is_positive = shared.exponent > 0;
        const bool in_all =
            std::all_of(polynomial.terms().begin(), polynomial.terms().end(), [&](const Term& term) {
                for (const Factor& factor : term.monomial) {
                    if (compare(factor.atom, shared.atom) != 0) continue;
                    if (cln::abs(factor.exponent) < cln::abs(shared.exponent)) shared.exponent = factor.exponent;
                    return (factor.exponent > 0) == is_positive;
                }
                return false;
            });
        if (in_all) result.push_back(shared);
    }
    return result;
}

Rational common_divisor(const Rational& a, const Rational& b) {
    return Rational(cln::gcd(cln::numerator(a), cln::numerator(b))) /
           Rational(cln::lcm(cln::denominator(a), cln::denominator(b)));
}

Rational content(const Polynomial& polynomial) {
    if (polynomial.is_zero()) return 1;
    Rational result = 0;
    for (const Term& term : polynomial.terms()) result = common_divisor(result, term.coefficient);
    return result;
}

Polynomial divide(const Polynomial& polynomial, const Monomial& monomial, const Rational& c) {
    const Monomial inverse = power(monomial, -1);
    std::vector<Term> terms = polynomial.terms();
    for (Term& term : terms) {
        term.monomial = term.monomial * inverse;
        term.coefficient = term.coefficient / c;
    }
    return Polynomial::collect(std::move(terms));
}

bool is_integer(const Rational& value) {
    return cln::denominator(value) == 1;
}

int to_int(const Rational& value) {
    if (!is_integer(value) || value > 1000000 || value < -1000000)
        throw std::overflow_error(say("the exponent is no small integer"));
    return cln::cl_I_to_int(cln::numerator(value));
}

GiNaC::ex expression(const Rational& value) {
    return GiNaC::numeric(static_cast<const cln::cl_N&>(value));
}

namespace {

GiNaC::ex expression(const AtomNode& atom) {
    GiNaC::exvector args;
    for (const Polynomial& arg : atom.args) args.push_back(alembert::expression(arg));
    switch (atom.kind) {
        case AtomNode::Kind::symbol:
            return atom.symbol;
        case AtomNode::Kind::pi:
            return GiNaC::Pi;
        case AtomNode::Kind::base:
            return args.at(0);
        case AtomNode::Kind::cosine:
            return GiNaC::cos(args.at(0));
        case AtomNode::Kind::sine:
            return GiNaC::sin(args.at(0));
        case AtomNode::Kind::function:
            break;
    }
    if (atom.name == "pow") return GiNaC::pow(args.at(0), args.at(1));
    if (atom.name == "abs") return absolute(args.at(0));
    const auto count = static_cast<unsigned>(args.size());
    return GiNaC::function(GiNaC::function::find_function(atom.name, count), args);
}

}  // namespace

GiNaC::ex expression(const Polynomial& polynomial) {
    GiNaC::exvector terms;
    for (const Term& term : polynomial.terms()) {
        GiNaC::exvector factors{expression(term.coefficient)};
        for (const Factor& factor : term.monomial)
            factors.push_back(GiNaC::pow(expression(*factor.atom), expression(factor.exponent)));
        terms.push_back(GiNaC::mul(factors));
    }
    return GiNaC::add(terms);
}

}  // namespace alembert
