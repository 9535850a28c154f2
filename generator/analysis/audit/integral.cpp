// SPDX-License-Identifier: GPL-2.0-or-later
// μ w is closed if ∂(μ aⱼ)/∂xᵢ = ∂(μ aᵢ)/∂xⱼ for all i, j. Then F = Σ Fᵢ with ∂Fᵢ/∂xᵢ = μ aᵢ − ∂(F₁ + … +
// Fᵢ₋₁)/∂xᵢ.
#include "analysis/audit/integral.hpp"

#include <algorithm>

#include "algebra/symbolic/fourier.hpp"
#include "algebra/symbolic/functions.hpp"
#include "model/energy.hpp"

namespace alembert {

using GiNaC::ex;
using GiNaC::symbol;

namespace {

constexpr double largest_tree = 600;  // larger forms are not tried
constexpr std::size_t most_terms = 400;

class Integration {
public:
    Integration(const Mechanism& m, const std::vector<int>& frozen) : m_(m) {
        for (int k = 0; k <= m.size(); ++k)
            if (std::find(frozen.begin(), frozen.end(), k) == frozen.end())
                free_.push_back(k);
            else
                frozen_.push_back(k < m.size() ? m.q[k] : m.t);
    }

    std::optional<ex> go(const OneForm& form) {
        GiNaC::exmap inputs;
        for (const Mechanism::Input& input : m_.inputs) inputs[input.derivative[0]] = m_.z->expand(input.value);
        std::vector<ex> all, a;
        for (const int k : free_) {
            if (m_.z->tree_size(form[k]) > largest_tree) return std::nullopt;
            const auto entry = simplified(without_inputs(m_.z->expand(form[k]), inputs));
            if (!entry) return std::nullopt;
            all.push_back(*entry);
        }
        for (std::size_t j = 0; j < all.size(); ++j) {
            const symbol x = free_[j] < m_.size() ? m_.q[free_[j]] : m_.t;
            if (std::none_of(all.begin(), all.end(), [&](const ex& e) { return e.has(x); }) && all[j].is_zero())
                continue;
            variables_.push_back(x);
            a.push_back(all[j]);
        }
        for (const ex& factor : factors(a)) {
            // A constant variable may have the value zero.
            if (std::any_of(frozen_.begin(), frozen_.end(), [&](const symbol& s) { return factor.has(s); }))
                continue;
            std::vector<ex> b;
            for (const ex& entry : a) {
                const auto scaled = simplified(entry * factor);
                if (!scaled) break;
                b.push_back(*scaled);
            }
            if (b.size() < a.size() || !closed(b)) continue;
            if (const auto F = potential(b)) return F;
        }
        return std::nullopt;
    }

private:
    std::optional<ex> simplified(const ex& e) const {
        const auto f = fourier(e, *m_.symbols, most_terms);
        if (!f) return std::nullopt;
        return expression(*f);
    }

    /// Inputs and their derivatives as functions of t.
    ex without_inputs(ex e, const GiNaC::exmap& inputs) const {
        GiNaC::exmap all;
        for (const Mechanism::Input& input : m_.inputs) {
            ex value = input.derivative[0];
            for (std::size_t round = 0; round < m_.inputs.size(); ++round)
                value = value.subs(inputs, GiNaC::subs_options::no_pattern);
            for (const symbol& derivative : input.derivative) {
                all[derivative] = value;
                value = value.diff(m_.t);
            }
        }
        return e.subs(all, GiNaC::subs_options::no_pattern);
    }

    bool closed(const std::vector<ex>& a) const {
        for (std::size_t i = 0; i < a.size(); ++i)
            for (std::size_t j = 0; j < i; ++j)
                if (!is_identically_zero(a[i].diff(variables_[j]) - a[j].diff(variables_[i]), m_)) return false;
        return true;
    }

    std::vector<ex> factors(const std::vector<ex>& a) const {
        std::vector<ex> result{1};
        if (a.size() < 2 || a.size() > 6) return result;
        const auto is_variable = [&](const ex& e) {
            return std::any_of(variables_.begin(), variables_.end(), [&](const symbol& s) { return e.has(s); });
        };
        std::vector<ex> entries;
        ex euler = 0;
        for (std::size_t i = 0; i < a.size(); ++i) {
            if (is_variable(a[i])) entries.push_back(a[i]);
            euler += variables_[i] * a[i];
        }
        for (const ex& entry : entries) result.push_back(1 / entry);
        for (std::size_t i = 0; i < entries.size(); ++i)
            for (std::size_t j = i; j < entries.size(); ++j) result.push_back(1 / (entries[i] * entries[j]));
        for (const symbol& x : variables_)
            for (const ex& factor : {ex(x), pow(x, -1), pow(x, -2), ex(cos(x)), ex(sin(x)), pow(cos(x), -1),
                                     pow(sin(x), -1), pow(cos(x), -2), pow(sin(x), -2), ex(exp(x)), ex(exp(-x))})
                result.push_back(factor);
        if (!is_identically_zero(euler, m_)) result.push_back(1 / euler);
        for (std::size_t i = 0; i < variables_.size(); ++i)
            for (std::size_t j = 0; j < i; ++j)
                result.push_back(1 / (variables_[i] * variables_[i] + variables_[j] * variables_[j]));
        return result;
    }

    std::optional<ex> potential(const std::vector<ex>& a) const {
        ex F = 0;
        for (std::size_t i = 0; i < a.size(); ++i) {
            const auto rest = simplified(a[i] - F.diff(variables_[i]));
            if (!rest) return std::nullopt;
            const auto part = antiderivative(*rest, variables_[i]);
            if (!part) return std::nullopt;
            F += *part;
        }
        for (std::size_t i = 0; i < a.size(); ++i)
            if (vanishes(F.diff(variables_[i]) - a[i], m_) != true) return std::nullopt;
        return F;
    }

    /// ∫ e dx of a sum of terms.
    static std::optional<ex> antiderivative(const ex& e, const symbol& x) {
        const ex sum = e.expand();
        ex result = 0;
        for (std::size_t k = 0; k < (GiNaC::is_a<GiNaC::add>(sum) ? sum.nops() : 1); ++k) {
            const auto part = term(GiNaC::is_a<GiNaC::add>(sum) ? sum.op(k) : sum, x);
            if (!part) return std::nullopt;
            result += *part;
        }
        return result;
    }

    static std::optional<ex> term(const ex& e, const symbol& x) {
        ex constant = 1;
        std::vector<ex> moving;
        const bool product = GiNaC::is_a<GiNaC::mul>(e);
        for (std::size_t k = 0; k < (product ? e.nops() : 1); ++k) {
            const ex factor = product ? e.op(k) : e;
            if (factor.has(x))
                moving.push_back(factor);
            else
                constant *= factor;
        }
        if (moving.empty()) return e * x;
        const ex rest = GiNaC::mul(GiNaC::exvector(moving.begin(), moving.end()));
        // One factor is tried as the outer function of B, and the others as a multiple of ∂B/∂x.
        for (const ex& outer : moving) {
            const bool power = GiNaC::is_a<GiNaC::power>(outer) && !outer.op(1).has(x);
            const bool function = GiNaC::is_a<GiNaC::function>(outer) && outer.nops() == 1;
            const ex B = power || function ? outer.op(0) : outer;
            if (B.diff(x).is_zero()) continue;
            const ex share = (rest / outer / B.diff(x)).normal();
            if (share.has(x)) continue;
            const ex exponent = power ? outer.op(1) : ex(1);
            if (!function)
                return constant * share *
                       (exponent.is_equal(-1) ? ex(log(B)) : pow(B, exponent + 1) / (exponent + 1));
            const std::string name = function_name(outer);
            if (name == "sin") return -constant * share * cos(B);
            if (name == "cos") return constant * share * sin(B);
            if (name == "exp") return constant * share * outer;
            if (name == "sinh") return constant * share * cosh(B);
            if (name == "cosh") return constant * share * sinh(B);
            if (name == "tan") return -constant * share * log(cos(B));
            if (name == "log") return constant * share * (B * log(B) - B);
        }
        return by_parts(constant, moving, x);
    }

    /// ∫ xⁿ S(x) dx = xⁿ ∫S − n ∫ xⁿ⁻¹ ∫S, where n is a small whole number and S a function of an expression
    /// linear in x.
    static std::optional<ex> by_parts(const ex& constant, const std::vector<ex>& moving, const symbol& x) {
        if (moving.size() != 2) return std::nullopt;
        for (const bool swap : {false, true}) {
            const ex &P = moving[swap ? 1 : 0], &S = moving[swap ? 0 : 1];
            if (!P.is_polynomial(x) || P.degree(x) > 8 || !GiNaC::is_a<GiNaC::function>(S)) continue;
            const auto inner = term(S, x);
            if (!inner) continue;
            const auto rest = antiderivative((P.diff(x) * *inner).expand(), x);
            if (rest) return constant * (P * *inner - *rest);
        }
        return std::nullopt;
    }

    const Mechanism& m_;
    std::vector<int> free_;
    std::vector<symbol> frozen_;
    std::vector<symbol>
        variables_;  ///< variables whose coefficients are not zero, or that occur in other coefficients
};

}  // namespace

std::optional<ex> integral_of(const OneForm& form, const Mechanism& mechanism, const std::vector<int>& frozen) {
    try {
        return Integration(mechanism, frozen).go(form);
    } catch (const std::domain_error&) {  // a candidate that divides by zero, or a pole that GiNaC reports
        return std::nullopt;
    }
}

}  // namespace alembert
