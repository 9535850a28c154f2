// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/interval/expansion.hpp"

#include <cln/integer.h>

#include <functional>

#include "base/language/say.hpp"

namespace alembert {

Monomials::Monomials(int variables, int degree) : variables_(variables), degree_(degree) {
    Exponents one(static_cast<std::size_t>(variables), 0);
    for (int total = 0; total <= degree; ++total) {
        const std::function<void(int, int)> fill = [&](int from, int left) {
            if (from == variables || left == 0) {
                if (left > 0) return;
                position_[one] = size();
                exponents_.push_back(one);
                total_.push_back(total);
                return;
            }
            for (int e = left; e >= 0; --e) {
                one[from] = e;
                fill(from + 1, left - e);
            }
            one[from] = 0;
        };
        fill(0, total);
    }
    product_.resize(exponents_.size());
    for (int i = 0; i < size(); ++i)
        for (int j = 0; j < size() && total_[i] + total_[j] <= degree; ++j) {
            Exponents sum = exponents_[i];
            for (int v = 0; v < variables; ++v) sum[v] += exponents_[j][v];
            product_[i].push_back(position_.at(sum));
        }
}

Expansion Expansion::variable(const Monomials& monomials, int variable, const RealBall& value) {
    Expansion result(value);
    result.monomials_ = &monomials;
    result.c_.resize(static_cast<std::size_t>(monomials.size()), RealBall(0));
    if (monomials.degree() > 0) {
        Monomials::Exponents exponents(static_cast<std::size_t>(monomials.variables()), 0);
        exponents[variable] = 1;
        result.c_[monomials.index(exponents)] = 1;
    }
    return result;
}

RealBall Expansion::coefficient(const Monomials::Exponents& exponents) const {
    int total = 0;
    for (const int e : exponents) total += e;
    return monomials_ ? c_[monomials_->index(exponents)] : total == 0 ? c_[0] : RealBall(0);
}

Expansion& Expansion::operator+=(const Expansion& b) {
    if (!monomials_) {
        monomials_ = b.monomials_;
        c_.resize(std::max(c_.size(), b.c_.size()), RealBall(0));
    }
    for (std::size_t k = 0; k < b.c_.size(); ++k) c_[k] += b.c_[k];
    return *this;
}

Expansion operator*(const Expansion& a, const Expansion& b) {
    if (!a.monomials_ && b.monomials_) return b * a;
    Expansion result = a;
    if (!b.monomials_) {
        for (RealBall& c : result.c_) c *= b.c_[0];
        return result;
    }
    for (RealBall& c : result.c_) c = 0;
    for (std::size_t i = 0; i < a.c_.size(); ++i) {
        if (a.c_[i].is_zero()) continue;
        for (std::size_t j = 0; j < b.c_.size(); ++j) {
            const int k = a.monomials_->product(static_cast<int>(i), static_cast<int>(j));
            if (k < 0) break;
            if (!b.c_[j].is_zero()) result.c_[k] += a.c_[i] * b.c_[j];
        }
    }
    return result;
}

Expansion Expansion::composed(const Expansion& a, const std::vector<RealBall>& series) {
    if (!a.monomials_) return Expansion(series[0]);
    Expansion h = a;
    h.c_[0] = 0;
    Expansion result(series.back());
    for (std::size_t k = series.size() - 1; k-- > 0;) result = result * h + Expansion(series[k]);
    return result;
}

Expansion derivative(const Expansion& a, int variable) {
    Expansion result = a;
    for (RealBall& c : result.c_) c = 0;
    for (std::size_t k = 0; a.monomials_ && k < a.c_.size(); ++k) {
        Monomials::Exponents exponents = a.monomials_->exponents(static_cast<int>(k));
        const int times = exponents[static_cast<std::size_t>(variable)]--;
        if (times > 0 && !a.c_[k].is_zero())
            result.c_[static_cast<std::size_t>(a.monomials_->index(exponents))] += RealBall(times) * a.c_[k];
    }
    return result;
}

Expansion put_into(const Expansion& a, const std::vector<Expansion>& at) {
    Expansion sum(a.value());
    std::vector<Expansion> product{Expansion(1)};  // of each monomial
    for (std::size_t k = 1; a.monomials_ && k < a.c_.size(); ++k) {
        Monomials::Exponents exponents = a.monomials_->exponents(static_cast<int>(k));
        std::size_t first = 0;
        while (exponents[first] == 0) ++first;
        --exponents[first];
        product.push_back(product[static_cast<std::size_t>(a.monomials_->index(exponents))] * at[first]);
        if (!a.c_[k].is_zero()) sum += Expansion(a.c_[k]) * product.back();
    }
    return sum;
}

Expansion operator/(const Expansion& a, const Expansion& b) {
    if (b.value().may_be_zero()) throw NotAnalytic(say("a division by zero"));
    const RealBall inverse = RealBall(1) / b.value();
    std::vector<RealBall> series{inverse};
    for (int k = 0; k < b.degree(); ++k) series.push_back(-series.back() * inverse);
    return a * Expansion::composed(b, series);
}

bool operator<(const Expansion& a, const Expansion& b) {
    const std::optional<int> sign = (a.value() - b.value()).sign();
    if (!sign || *sign == 0) throw NotAnalytic(say("a comparison of equal values"));
    return *sign < 0;
}

namespace {

/// f, f', f'', f''' and so on cyclically, divided by k!.
std::vector<RealBall> cyclic(const std::vector<RealBall>& derivatives, int degree) {
    std::vector<RealBall> result;
    Rational factorial = 1;
    for (int k = 0; k <= degree; ++k) {
        if (k > 0) factorial = factorial * k;
        result.push_back(derivatives[k % derivatives.size()] * RealBall(1 / factorial));
    }
    return result;
}

/// The series whose derivative has the series `slope`; its value at the point is given.
std::vector<RealBall> integrated(const RealBall& value, const std::vector<RealBall>& slope) {
    std::vector<RealBall> result{value};
    for (std::size_t k = 0; k + 1 < slope.size(); ++k)
        result.push_back(slope[k] * RealBall(Rational(1) / static_cast<int>(k + 1)));
    return result;
}

/// The series of f(x₀ + h) in h.
std::vector<RealBall> in_one(const RealBall& x, int degree, const std::function<Expansion(const Expansion&)>& f) {
    const Monomials line(1, degree);
    const Expansion value = f(Expansion::variable(line, 0, x));
    std::vector<RealBall> result;
    for (int k = 0; k <= degree; ++k) result.push_back(value.coefficient(k));
    return result;
}

}  // namespace

Expansion sin(const Expansion& a) {
    const RealBall s = sin(a.value()), c = cos(a.value());
    return Expansion::composed(a, cyclic({s, c, -s, -c}, a.degree()));
}
Expansion cos(const Expansion& a) {
    const RealBall s = sin(a.value()), c = cos(a.value());
    return Expansion::composed(a, cyclic({c, -s, -c, s}, a.degree()));
}
Expansion exp(const Expansion& a) {
    return Expansion::composed(a, cyclic({exp(a.value())}, a.degree()));
}
Expansion log(const Expansion& a) {
    if (a.value().sign() != 1) throw NotAnalytic(say("log of what is not positive"));
    const auto slope = in_one(a.value(), a.degree(), [](const Expansion& x) { return Expansion(1) / x; });
    return Expansion::composed(a, integrated(log(a.value()), slope));
}
Expansion atan(const Expansion& a) {
    const auto slope =
        in_one(a.value(), a.degree(), [](const Expansion& x) { return Expansion(1) / (x * x + Expansion(1)); });
    return Expansion::composed(a, integrated(atan(a.value()), slope));
}
Expansion asin(const Expansion& a) {
    const RealBall left = RealBall(1) - a.value() * a.value();
    if (a.degree() > 0 && left.sign() != 1) throw NotAnalytic(say("asin or acos at the end of its range"));
    if (a.degree() == 0) return Expansion(asin(a.value()));
    const auto slope = in_one(a.value(), a.degree(),
                              [](const Expansion& x) { return Expansion(1) / sqrt(Expansion(1) - x * x); });
    return Expansion::composed(a, integrated(asin(a.value()), slope));
}
Expansion acos(const Expansion& a) {
    return Expansion(acos(RealBall(0))) - asin(a);
}

Expansion pow(const Expansion& a, const Expansion& b) {
    if (b.monomials_) return exp(b * log(a));
    const RealBall& exponent = b.value();
    const std::optional<Rational> r = exponent.rational();
    if (r && cln::denominator(*r) == 1 && *r >= 0 && *r <= 64) {
        Expansion result(1);
        for (int k = static_cast<int>(cln::cl_I_to_L(cln::numerator(*r))); k > 0; --k) result *= a;
        return result;
    }
    if (!a.monomials_) return Expansion(pow(a.value(), exponent));
    const bool whole = r && cln::denominator(*r) == 1;
    if (whole ? a.value().may_be_zero() : a.value().sign() != 1)
        throw NotAnalytic(say("a power or root of a base that may be zero"));
    std::vector<RealBall> series{pow(a.value(), exponent)};
    for (int k = 0; k < a.degree(); ++k)
        series.push_back(series.back() * (exponent - RealBall(k)) / (a.value() * RealBall(k + 1)));
    return Expansion::composed(a, series);
}

Expansion abs(const Expansion& a) {
    const std::optional<int> sign = a.value().sign();
    if (!a.monomials_ && sign == 0) return a;
    if (!sign || *sign == 0) throw NotAnalytic(say("abs at zero"));
    return Expansion(*sign) * a;
}

Expansion atan2(const Expansion& y, const Expansion& x) {
    const RealBall y0 = y.value(), x0 = x.value();
    const Expansion along = Expansion(x0) * x + Expansion(y0) * y, across = Expansion(x0) * y - Expansion(y0) * x;
    if (along.value().sign() != 1) throw NotAnalytic(say("atan2 at the origin"));
    return Expansion(atan2(y0, x0)) + atan(across / along);
}

}  // namespace alembert
