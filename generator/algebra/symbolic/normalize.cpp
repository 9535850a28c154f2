// SPDX-License-Identifier: GPL-2.0-or-later
//
// Converts GiNaC's tree to the normal form; each shared subexpression is converted once.
#include <algorithm>
#include <stdexcept>
#include <unordered_map>

#include <cln/real.h>

#include "algebra/symbolic/fourier.hpp"

#include "base/language/say.hpp"

namespace alembert {

namespace {

using Kind = AtomNode::Kind;

class Normalizer {
public:
    Normalizer(const Symbols& symbols, Budget& budget) : symbols_(symbols), budget_(budget) {}

    Fourier operator()(const GiNaC::ex& e) {
        if (budget_.spent) return {};
        if (GiNaC::is_a<GiNaC::numeric>(e)) return number(GiNaC::ex_to<GiNaC::numeric>(e));
        const auto found = memo_.find(e);
        if (found != memo_.end()) return found->second;
        Fourier result = compound(e);
        return memo_.emplace(e, std::move(result)).first->second;
    }

private:
    static Rational number(const GiNaC::numeric& n) {
        if (!n.is_real()) throw std::invalid_argument(say("the expression holds a complex number"));
        const auto real = cln::the<cln::cl_R>(n.to_cl_N());
        return n.is_rational() ? cln::the<cln::cl_RA>(real) : cln::rational(real);
    }

    Fourier compound(const GiNaC::ex& e) {
        if (GiNaC::is_a<GiNaC::symbol>(e)) {
            const auto& symbol = GiNaC::ex_to<GiNaC::symbol>(e);
            return Fourier(symbol_atom(symbol, symbols_.info(symbol)));
        }
        if (GiNaC::is_a<GiNaC::constant>(e)) return constant(e);
        if (GiNaC::is_a<GiNaC::add>(e)) return sum(e);
        if (GiNaC::is_a<GiNaC::mul>(e)) return product(e);
        if (GiNaC::is_a<GiNaC::power>(e)) return power_of((*this)(e.op(0)), e.op(1));
        if (GiNaC::is_a<GiNaC::function>(e)) return function(e);
        throw std::invalid_argument(say("the expression holds something that is no scalar"));
    }

    static Fourier constant(const GiNaC::ex& e) {
        if (!e.is_equal(GiNaC::Pi))
            throw std::invalid_argument(say("the expression holds a constant other than pi"));
        return Fourier(pi_atom());
    }

    Fourier sum(const GiNaC::ex& e) {
        std::vector<Term> terms;
        for (std::size_t i = 0; i < e.nops(); ++i) {
            const Fourier part = (*this)(e.op(i));
            terms.insert(terms.end(), part.terms().begin(), part.terms().end());
            if (terms.size() > budget_.work) budget_.spent = true;
            if (budget_.spent) return {};
        }
        return Fourier::collect(std::move(terms));
    }

    Fourier product(const GiNaC::ex& e) {
        std::vector<Fourier> factors;
        for (std::size_t i = 0; i < e.nops(); ++i) factors.push_back((*this)(e.op(i)));
        // GiNaC's order is random. Without a fixed order the budget would be exceeded in some runs and not in
        // others.
        std::sort(factors.begin(), factors.end(),
                  [](const Fourier& a, const Fourier& b) { return compare(a.polynomial(), b.polynomial()) < 0; });
        Fourier result = Rational(1);
        for (const Fourier& factor : factors) result = multiply(result, factor, budget_);
        return result;
    }

    Fourier power_of(const Fourier& base, const GiNaC::ex& exponent) {
        if (budget_.spent) return {};
        const Fourier e = (*this)(exponent);
        if (budget_.spent) return {};
        if (e.polynomial().is_constant())
            return power(base, e.size() == 0 ? Rational(0) : e.terms()[0].coefficient, budget_);
        // a^(n/2 − 1) = (a^n)^½ · a^−1
        std::vector<Term> symbolic;
        Rational whole = 0;
        for (const Term& term : e.terms())
            if (term.monomial.empty())
                whole = term.coefficient;
            else
                symbolic.push_back(term);
        const Polynomial rest = Polynomial::collect(std::move(symbolic));
        const Rational scale = rest.terms()[0].coefficient < 0 ? Rational(-content(rest)) : content(rest);
        const Atom atom = compound_atom(Kind::function, {base.polynomial(), (1 / scale) * rest}, "pow");
        return multiply(Fourier::collect({{{{atom, scale}}, 1}}), power(base, whole, budget_), budget_);
    }

    static Fourier exponential(const Polynomial& arg) {
        Monomial result;
        for (const Term& term : arg.terms()) {
            const Polynomial unit = Polynomial::collect({{term.monomial, 1}});
            result = result * Monomial{{compound_atom(Kind::function, {unit}, "exp"), term.coefficient}};
        }
        return Fourier::collect({{result, 1}});
    }

    Fourier function(const GiNaC::ex& e) {
        std::string name = GiNaC::ex_to<GiNaC::function>(e).get_name();
        if (name == "absolute") name = "abs";
        std::vector<Polynomial> args;
        for (std::size_t i = 0; i < e.nops(); ++i) args.push_back((*this)(e.op(i)).polynomial());
        if (budget_.spent) return {};
        const Fourier first = Fourier::collect(args.at(0).terms());
        if (name == "sin") return sine(first);
        if (name == "cos") return cosine(first);
        if (name == "exp") return exponential(args[0]);
        // GiNaC treats symbols as complex; ours are real.
        if (name == "conjugate" || name == "real_part") return first;
        if (name == "imag_part") return {};
        const bool negative = !args[0].is_zero() && args[0].terms()[0].coefficient < 0;
        for (const char* odd : {"tan", "asin", "atan", "sinh", "tanh", "asinh", "atanh", "signum", "sign"})
            if (name == odd && args.size() == 1 && negative)
                return Rational(-1) * Fourier(compound_atom(Kind::function, {-args[0]}, name));
        for (const char* even : {"cosh", "abs"})
            if (name == even && negative) args[0] = -args[0];
        return Fourier(compound_atom(Kind::function, std::move(args), name));
    }

    const Symbols& symbols_;
    Budget& budget_;
    std::unordered_map<GiNaC::ex, Fourier> memo_;
};

}  // namespace

std::optional<Fourier> fourier(const GiNaC::ex& expression, const Symbols& symbols, std::size_t budget) {
    Budget limit{.terms = budget, .work = 50 * budget};
    Fourier result = Normalizer(symbols, limit)(expression);
    if (limit.spent || result.size() > budget) return std::nullopt;
    return result;
}

}  // namespace alembert
