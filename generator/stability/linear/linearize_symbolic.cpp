// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/linear/linearize_symbolic.hpp"

#include <algorithm>

#include "algebra/notation/readable.hpp"
#include "algebra/symbolic/fourier.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

constexpr int most_coordinates = 4;
constexpr std::size_t most_terms = 12;
constexpr double largest_tree = 2000;

/// Does `e` contain a derivative that GiNaC does not know: of abs, sign, min or max?
bool has_unknown_derivative(const ex& e) {
    if (GiNaC::is_a<GiNaC::fderivative>(e)) return true;
    for (const ex& part : e)
        if (has_unknown_derivative(part)) return true;
    return false;
}

std::optional<SymbolicMatrices> matrices(const Mechanism& m, const Equations& e, const std::vector<ex>& q0,
                                         const std::vector<ex>& u0) {
    const int n = m.size();
    if (!m.constraints.empty() || !e.speeds_are_rates() || n > most_coordinates) return {};
    GiNaC::exmap there;
    for (int i = 0; i < n; ++i) {
        there[m.q[i]] = m.z->expand(q0[i]);
        there[m.qdot[i]] = m.z->expand(u0[i]);
    }
    const auto readable_there = [&](const ex& derivative) -> std::optional<ex> {
        const ex value = derivative.subs(there);
        if (has_unknown_derivative(value)) return {};
        const auto f = fourier(value, *m.symbols, 400);
        if (!f || f->size() > most_terms) return {};
        return expression(readable(*f));
    };
    const unsigned size = static_cast<unsigned>(n);
    SymbolicMatrices result{
        .M = {size, size}, .C = {size, size}, .G = {size, size}, .K = {size, size}, .N = {size, size}};
    std::vector<ex> f;
    for (int i = 0; i < n; ++i) {
        if (m.z->tree_size(e.forcing(i)) > largest_tree) return {};
        f.push_back(m.z->expand(e.forcing(i)));
    }
    const ex half = GiNaC::numeric(1, 2);
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            if (m.z->tree_size(e.M(i, j)) > largest_tree) return {};
            const auto part = [&](const std::vector<GiNaC::symbol>& by, int sign) {
                return half * (-f[i].diff(by[j]) - sign * f[j].diff(by[i]));
            };
            for (const auto& [matrix, value] :
                 {std::pair(&result.M, m.z->expand(e.M(i, j))), std::pair(&result.C, ex(part(m.qdot, 1))),
                  std::pair(&result.G, ex(part(m.qdot, -1))), std::pair(&result.K, ex(part(m.q, 1))),
                  std::pair(&result.N, ex(part(m.q, -1)))}) {
                const std::optional<ex> element = readable_there(value);
                if (!element) return {};
                (*matrix)(i, j) = *element;
            }
        }
    result.stays = std::all_of(f.begin(), f.end(), [&](const ex& force) {
        const auto value = fourier(force.subs(there), *m.symbols, 400);
        return value && is_zero(*value);
    });
    return result;
}

}  // namespace

std::optional<SymbolicMatrices> symbolic_matrices(const Mechanism& m, const Equations& e,
                                                  const std::vector<ex>& q0, const std::vector<ex>& u0) {
    try {
        return matrices(m, e, q0, u0);
    } catch (const GiNaC::pole_error&) {  // 0·∞, as of sqrt(x^2)^3 at 0
        return {};
    }
}

}  // namespace alembert
