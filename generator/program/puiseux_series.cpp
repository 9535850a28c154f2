// SPDX-License-Identifier: GPL-2.0-or-later
// Series in ε with leading term c ε^v:  (c ε^v (1 + r))^a = c^a ε^(va) Σ binomial(a, k) r^k,   f(c + δ) = Σ
// f^(k)(c)/k! δ^k. Taylor coefficients of tanh and atan come from y' = 1 − y² and y' (1 + x²) = 1.
#include "program/puiseux_series.hpp"
#include "alembert/base/tolerances.hpp"

#include <cmath>

namespace alembert {

namespace {

using Real = PuiseuxSeries::Real;

constexpr double known_to = 6;                 // the power of ε up to which a series is kept
constexpr std::size_t coefficients_kept = 14;  // Taylor coefficients
constexpr Real rounding = std::numeric_limits<Real>::epsilon();

/// The Taylor coefficients of sin(c + s); those of cos follow from a quarter turn more.
std::vector<Real> of_sine(Real sine, Real cosine) {
    std::vector<Real> result;
    Real factorial = 1;
    for (std::size_t k = 0; k < coefficients_kept; ++k) {
        if (k > 0) factorial *= static_cast<Real>(k);
        const Real cycle[] = {sine, cosine, -sine, -cosine};
        result.push_back(cycle[k % 4] / factorial);
    }
    return result;
}

/// The Taylor coefficients of e^(c + s)·a + e^−(c + s)·b from its value and its derivative, which alternate.
std::vector<Real> of_hyperbolic(Real value, Real derivative) {
    std::vector<Real> result;
    Real factorial = 1;
    for (std::size_t k = 0; k < coefficients_kept; ++k) {
        if (k > 0) factorial *= static_cast<Real>(k);
        result.push_back((k % 2 == 0 ? value : derivative) / factorial);
    }
    return result;
}

}  // namespace

PuiseuxSeries PuiseuxSeries::undefined() {
    PuiseuxSeries result;
    result.defined_ = false;
    return result;
}

double PuiseuxSeries::place() const {
    constexpr Real known_to = 2e-13L;  // how far from a knot a start still counts as at it
    const Real x = at(0).value;
    for (const Term& term : terms_)
        if (term.exponent > 0 && std::abs(term.value) > term.error)
            return static_cast<double>(x + (term.value > 0 ? 1 : -1) * known_to * std::max(Real(1), std::abs(x)));
    return static_cast<double>(x);
}

PuiseuxSeries PuiseuxSeries::path(Real x, Real error, const std::vector<Real>& steps) {
    PuiseuxSeries result(x, error);
    for (std::size_t k = 0; k < steps.size(); ++k)
        if (steps[k] != 0)
            result.terms_.push_back({static_cast<double>(k + 1), steps[k], rounding * std::abs(steps[k])});
    return result;
}

PuiseuxSeries::Term PuiseuxSeries::at(double exponent) const {
    for (const Term& term : terms_)
        if (std::abs(term.exponent - exponent) < tolerance::same_exponent) return term;
    return {exponent, 0, 0};
}

const PuiseuxSeries::Term* PuiseuxSeries::leading() const {
    for (const Term& term : terms_)
        if (term.value != 0) return &term;
    return nullptr;
}

int PuiseuxSeries::side() const {
    const Term* first = leading();
    return !defined_ || first == nullptr ? 0 : first->value < 0 ? -1 : 1;
}

double PuiseuxSeries::valuation() const {
    const Term* first = leading();
    return first == nullptr ? order_ : first->exponent;
}

bool PuiseuxSeries::is_number() const {
    return order_ == exact && (terms_.empty() || (terms_.size() == 1 && terms_[0].exponent == 0));
}

/// Sorts terms, adds those with equal exponents, drops those beyond the known order, and sets to zero coefficients
/// that are within their error.
void PuiseuxSeries::tidy() {
    std::sort(terms_.begin(), terms_.end(), [](const Term& a, const Term& b) { return a.exponent < b.exponent; });
    std::vector<Term> kept;
    for (const Term& term : terms_) {
        if (term.exponent > known_to && (term.value != 0 || term.error != 0)) order_ = std::min(order_, known_to);
        if (!kept.empty() && term.exponent - kept.back().exponent < tolerance::same_exponent) {
            kept.back().value += term.value;
            kept.back().error += term.error + rounding * std::abs(kept.back().value);
        } else {
            kept.push_back(term);
        }
    }
    terms_.clear();
    for (Term& term : kept) {
        if (!std::isfinite(term.value) || !std::isfinite(term.error)) {
            *this = undefined();
            return;
        }
        if (std::abs(term.value) <= term.error) term.value = 0;
        if (term.exponent < order_ - tolerance::same_exponent && (term.value != 0 || term.error != 0))
            terms_.push_back(term);
    }
}

PuiseuxSeries& PuiseuxSeries::operator+=(const PuiseuxSeries& b) {
    if (!defined_ || !b.defined_) return *this = undefined();
    terms_.insert(terms_.end(), b.terms_.begin(), b.terms_.end());
    order_ = std::min(order_, b.order_);
    tidy();
    return *this;
}

PuiseuxSeries& PuiseuxSeries::operator*=(const PuiseuxSeries& b) {
    if (!defined_ || !b.defined_) return *this = undefined();
    PuiseuxSeries result;
    const bool is_zero = valuation() == exact || b.valuation() == exact;
    if (!is_zero) result.order_ = std::min(valuation() + b.order_, b.valuation() + order_);
    for (const Term& x : terms_)
        for (const Term& y : b.terms_) {
            const Real value = x.value * y.value;
            const Real error = std::abs(x.value) * y.error + std::abs(y.value) * x.error + x.error * y.error;
            result.terms_.push_back({x.exponent + y.exponent, value, error + rounding * std::abs(value)});
        }
    result.tidy();
    return *this = std::move(result);
}

PuiseuxSeries operator-(const PuiseuxSeries& a, const PuiseuxSeries& b) {
    return a + PuiseuxSeries(-1) * b;
}

PuiseuxSeries PuiseuxSeries::shifted(double exponent) const {
    PuiseuxSeries result = *this;
    for (Term& term : result.terms_) term.exponent += exponent;
    result.order_ += exponent;
    return result;
}

PuiseuxSeries PuiseuxSeries::to_the(Real a) const {
    if (!defined_) return undefined();
    const Term* first = leading();
    if (first == nullptr) {
        if (a < 0) return undefined();
        PuiseuxSeries result(a == 0 ? 1 : 0);
        if (a > 0 && order_ != exact) result.order_ = order_ * static_cast<double>(a);
        return result;
    }
    const bool is_whole = a == std::floor(a);
    if (first->value < 0 && !is_whole) return undefined();
    const double exponent = first->exponent;
    const Real c = first->value;
    PuiseuxSeries unit = *this;  // 1 + r; terms before the leading one are zero within their error
    std::erase_if(unit.terms_, [&](const Term& term) { return term.exponent < exponent; });
    for (Term& term : unit.terms_) {
        term.value /= c;
        term.error = term.error / std::abs(c) + rounding * std::abs(term.value);
    }
    unit = unit.shifted(-exponent);
    std::vector<Real> binomial{1};
    for (std::size_t k = 1; k < coefficients_kept; ++k)
        binomial.push_back(binomial.back() * (a - static_cast<Real>(k - 1)) / static_cast<Real>(k));
    PuiseuxSeries result = unit.through(binomial) * PuiseuxSeries(std::pow(c, a));
    result = result.shifted(exponent * static_cast<double>(a));
    result.tidy();
    return result;
}

PuiseuxSeries operator/(const PuiseuxSeries& a, const PuiseuxSeries& b) {
    return a * b.to_the(-1);
}

PuiseuxSeries PuiseuxSeries::through(const std::vector<Real>& taylor) const {
    if (!defined_ || valuation() < -tolerance::same_exponent) return undefined();
    PuiseuxSeries rest = *this;
    const Real error = at(0).error;
    std::erase_if(rest.terms_, [](const Term& term) { return term.exponent < tolerance::same_exponent; });
    // f(c ± e): the error of the constant coefficient is multiplied by the slope.
    PuiseuxSeries result(taylor.back());
    for (std::size_t k = taylor.size() - 1; k-- > 0;) {
        const Real next = taylor[k + 1] * static_cast<Real>(k + 1);
        result =
            result * rest + PuiseuxSeries(taylor[k], std::abs(next) * error + 4 * rounding * std::abs(taylor[k]));
    }
    if (rest.leading() != nullptr || rest.order_ != exact)
        result.order_ = std::min(result.order_, rest.valuation() * static_cast<double>(taylor.size()));
    result.tidy();
    return result;
}

PuiseuxSeries sin(const PuiseuxSeries& a) {
    const Real c = a.at(0).value;
    return a.through(of_sine(std::sin(c), std::cos(c)));
}
PuiseuxSeries cos(const PuiseuxSeries& a) {
    const Real c = a.at(0).value;
    return a.through(of_sine(std::cos(c), -std::sin(c)));
}
PuiseuxSeries tan(const PuiseuxSeries& a) {
    return sin(a) / cos(a);
}
PuiseuxSeries sinh(const PuiseuxSeries& a) {
    const Real c = a.at(0).value;
    return a.through(of_hyperbolic(std::sinh(c), std::cosh(c)));
}
PuiseuxSeries cosh(const PuiseuxSeries& a) {
    const Real c = a.at(0).value;
    return a.through(of_hyperbolic(std::cosh(c), std::sinh(c)));
}
PuiseuxSeries exp(const PuiseuxSeries& a) {
    const Real c = a.at(0).value;
    return a.through(of_hyperbolic(std::exp(c), std::exp(c)));
}

PuiseuxSeries tanh(const PuiseuxSeries& a) {
    std::vector<Real> taylor{std::tanh(a.at(0).value)};
    while (taylor.size() < coefficients_kept) {
        const std::size_t k = taylor.size() - 1;
        Real square = 0;
        for (std::size_t i = 0; i <= k; ++i) square += taylor[i] * taylor[k - i];
        taylor.push_back(((k == 0 ? 1 : 0) - square) / static_cast<Real>(k + 1));
    }
    return a.through(taylor);
}

PuiseuxSeries atan(const PuiseuxSeries& a) {
    const Real c = a.at(0).value;
    std::vector<Real> taylor{std::atan(c)}, slope;
    while (taylor.size() < coefficients_kept) {
        const std::size_t k = slope.size();
        const Real before = k > 0 ? slope[k - 1] : 0, two_before = k > 1 ? slope[k - 2] : 0;
        slope.push_back(((k == 0 ? 1 : 0) - 2 * c * before - two_before) / (1 + c * c));
        taylor.push_back(slope.back() / static_cast<Real>(k + 1));
    }
    return a.through(taylor);
}

PuiseuxSeries asin(const PuiseuxSeries& a) {
    return atan2(a, sqrt((1 - a) * (1 + a)));
}
PuiseuxSeries acos(const PuiseuxSeries& a) {
    return atan2(sqrt((1 - a) * (1 + a)), a);
}

PuiseuxSeries log(const PuiseuxSeries& a) {
    const Real c = a.at(0).value;
    if (!a.defined_ || c <= 0) return PuiseuxSeries::undefined();
    std::vector<Real> taylor{std::log(c)};
    Real power = -1;
    for (std::size_t k = 1; k < coefficients_kept; ++k) {
        power /= -c;
        taylor.push_back(power / static_cast<Real>(k));
    }
    return a.through(taylor);
}

PuiseuxSeries sqrt(const PuiseuxSeries& a) {
    return a.to_the(0.5L);
}

PuiseuxSeries abs(const PuiseuxSeries& a) {
    return a.side() < 0 ? PuiseuxSeries(-1) * a : a;
}

PuiseuxSeries pow(const PuiseuxSeries& a, const PuiseuxSeries& b) {
    return b.is_number() ? a.to_the(b.at(0).value) : exp(b * log(a));
}

PuiseuxSeries atan2(const PuiseuxSeries& y, const PuiseuxSeries& x) {
    if (!y.defined_ || !x.defined_) return PuiseuxSeries::undefined();
    const Real pi = std::acos(Real(-1));
    const PuiseuxSeries::Term *first_y = y.leading(), *first_x = x.leading();
    if (first_y == nullptr && first_x == nullptr) return PuiseuxSeries(0);
    if (first_y == nullptr) return x.side() < 0 ? PuiseuxSeries(pi) : PuiseuxSeries(0);
    const bool steep = first_x == nullptr || first_y->exponent < first_x->exponent - tolerance::same_exponent ||
                       (first_y->exponent < first_x->exponent + tolerance::same_exponent &&
                        std::abs(first_y->value) > std::abs(first_x->value));
    if (steep) return PuiseuxSeries(y.side() * pi / 2, rounding) - atan(x / y);
    return x.side() > 0 ? atan(y / x) : PuiseuxSeries(y.side() * pi, rounding) + atan(y / x);
}

}  // namespace alembert
