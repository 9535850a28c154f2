// SPDX-License-Identifier: GPL-2.0-or-later
// Δ = Σ aᵢ(q,t) q'ᵢ + b(q,t) = F':  aᵢ = ∂F/∂qᵢ, b = ∂F/∂t. F grows coordinate by coordinate:
// F ← F + ∫ (aᵢ − ∂F/∂qᵢ) dqᵢ, and at last F ← F + ∫ (b − ∂F/∂t) dt.
#include "check/total_derivative.hpp"

#include "algebra/symbolic/fourier.hpp"
#include "model/energy.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

constexpr double longest = 3000;
constexpr std::size_t most_terms = 200;

/// ∫ c(…)·x^n dx, or with a factor sin(k x + b) or cos(k x + b); nothing for anything else.
std::optional<ex> integrated_term(const ex& term, const GiNaC::symbol& x) {
    if (!term.has(x)) return term * x;
    GiNaC::exvector factors =
        GiNaC::is_a<GiNaC::mul>(term) ? GiNaC::exvector(term.begin(), term.end()) : GiNaC::exvector{term};
    ex constant = 1, turn = 0;
    int power = 0;
    for (const ex& factor : factors) {
        const bool is_power = GiNaC::is_a<GiNaC::power>(factor) && factor.op(0).is_equal(x) &&
                              factor.op(1).info(GiNaC::info_flags::nonnegint);
        const bool turns =
            GiNaC::is_the_function<GiNaC::sin_SERIAL>(factor) || GiNaC::is_the_function<GiNaC::cos_SERIAL>(factor);
        if (!factor.has(x))
            constant *= factor;
        else if (factor.is_equal(x))
            ++power;
        else if (is_power)
            power += GiNaC::ex_to<GiNaC::numeric>(factor.op(1)).to_int();
        else if (turns && turn.is_zero())
            turn = factor;
        else
            return std::nullopt;
    }
    if (turn.is_zero()) return constant * GiNaC::pow(x, power + 1) / (power + 1);
    const ex angle = turn.op(0), slope = angle.diff(x);
    if (slope.has(x)) return std::nullopt;
    // By parts: ∫ xⁿ u' dx = xⁿ u − n ∫ xⁿ⁻¹ u dx.
    const bool is_sine = GiNaC::is_the_function<GiNaC::sin_SERIAL>(turn);
    const ex primitive = is_sine ? -cos(angle) / slope : sin(angle) / slope;
    if (power == 0) return constant * primitive;
    const auto rest = integrated_term((GiNaC::pow(x, power - 1) * primitive).expand(), x);
    if (!rest) return std::nullopt;
    return constant * (GiNaC::pow(x, power) * primitive - power * *rest);
}

std::optional<ex> integrated(const ex& e, const GiNaC::symbol& x, const Symbols& symbols) {
    const auto normal = fourier(e, symbols, most_terms);
    if (!normal) return std::nullopt;
    const ex sum = expression(*normal).expand();
    if (sum.is_zero()) return ex(0);
    GiNaC::exvector result;
    const auto add = [&](const ex& term) {
        auto one = integrated_term(term, x);
        if (one) result.push_back(std::move(*one));
        return one.has_value();
    };
    if (!GiNaC::is_a<GiNaC::add>(sum)) return add(sum) ? std::optional(result[0]) : std::nullopt;
    for (const ex& term : sum)
        if (!add(term)) return std::nullopt;
    return GiNaC::add(std::move(result));
}

}  // namespace

std::vector<ex> euler_operator(const ex& delta, const Mechanism& m) {
    const std::vector<ex> rates = m.time_derivative(m.z->pull_back({{delta, 1}}, m.qdot)),
                          slopes = m.z->pull_back({{delta, 1}}, m.q);
    std::vector<ex> result;
    for (int i = 0; i < m.size(); ++i) result.push_back(m.z->name(rates[i] - slopes[i]));
    return result;
}

std::optional<ex> source_of_derivative(const ex& delta, const Mechanism& m) {
    if (m.z->tree_size(delta) > longest) return std::nullopt;
    for (const Mechanism::Input& input : m.inputs)
        if (m.z->depends(delta, {input.derivative.begin(), input.derivative.end()})) return std::nullopt;
    const ex written = m.z->expand(delta);
    ex rest = written, F = 0;
    for (int i = 0; i < m.size(); ++i) {
        const ex slope = written.diff(m.qdot[i]);
        rest -= slope * m.qdot[i];
        const auto more = integrated(slope - F.diff(m.q[i]), m.q[i], *m.symbols);
        if (!more) return std::nullopt;
        F += *more;
    }
    const auto more = integrated(rest - F.diff(m.t), m.t, *m.symbols);
    if (!more) return std::nullopt;
    F = m.z->name(F + *more);
    if (!is_identically_zero(m.z->name(m.time_derivative({F})[0] - delta), m)) return std::nullopt;
    return m.z->expand(F);
}

}  // namespace alembert
