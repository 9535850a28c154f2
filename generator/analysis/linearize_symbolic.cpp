// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/linearize_symbolic.hpp"

#include "report/readable.hpp"
#include "symbolic/fourier.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

constexpr int most_coordinates = 4;
constexpr std::size_t most_terms = 12;
constexpr double largest_tree = 2000;

}  // namespace

std::optional<SymbolicMatrices> symbolic_matrices(const Mechanism& m, const Equations& e, const std::vector<ex>& q0, const std::vector<ex>& u0) {
    const int n = m.size();
    if (!m.constraints.empty() || !e.speeds_are_rates() || n > most_coordinates) return {};
    GiNaC::exmap there;
    for (int i = 0; i < n; ++i) {
        there[m.q[i]] = m.z->expand(q0[i]);
        there[m.qdot[i]] = m.z->expand(u0[i]);
    }
    const auto readable_there = [&](const ex& value) -> std::optional<ex> {
        const auto f = fourier(value.subs(there), *m.symbols, 400);
        if (!f || f->size() > most_terms) return {};
        return expression(readable(*f));
    };
    const unsigned size = static_cast<unsigned>(n);
    SymbolicMatrices result{.M = {size, size}, .C = {size, size}, .G = {size, size}, .K = {size, size}, .N = {size, size}};
    std::vector<ex> f;
    for (int i = 0; i < n; ++i) {
        if (m.z->tree_size(e.forcing(i)) > largest_tree) return {};
        f.push_back(m.z->expand(e.forcing(i)));
    }
    const ex half = GiNaC::numeric(1, 2);
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            if (m.z->tree_size(e.M(i, j)) > largest_tree) return {};
            const auto part = [&](const std::vector<GiNaC::symbol>& by, int sign) { return half * (-f[i].diff(by[j]) - sign * f[j].diff(by[i])); };
            for (const auto& [matrix, value] : {std::pair(&result.M, m.z->expand(e.M(i, j))), std::pair(&result.C, ex(part(m.qdot, 1))), std::pair(&result.G, ex(part(m.qdot, -1))),
                                                std::pair(&result.K, ex(part(m.q, 1))), std::pair(&result.N, ex(part(m.q, -1)))}) {
                const std::optional<ex> element = readable_there(value);
                if (!element) return {};
                (*matrix)(i, j) = *element;
            }
        }
    return result;
}

}  // namespace alembert
