// SPDX-License-Identifier: GPL-2.0-or-later
// r = a·x + r₀ vanishes with R x = ρ if a = s R and r₀ = −s ρ: a_j R_k = a_k R_j and R_j r₀ + a_j ρ = 0 for a j
// with R_j ≠ 0.
#include "check/multiple.hpp"

#include <algorithm>

#include "model/energy.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

constexpr double largest_checked = 4000;

bool zero(const ex& e, const Mechanism& m) {
    return e.is_zero() || (m.z->tree_size(e) < largest_checked && is_identically_zero(e, m));
}

}  // namespace

bool is_multiple(const ex& residual, const Mechanism& m, const Equations& e) {
    const auto n = static_cast<std::size_t>(e.size()), k = e.A.size();
    std::vector<GiNaC::symbol> unknowns = e.udot;
    unknowns.insert(unknowns.end(), e.lambda.begin(), e.lambda.end());
    const std::vector<ex> a = m.z->pull_back({{residual, 1}}, unknowns);
    GiNaC::exvector rest{residual};
    for (std::size_t j = 0; j < unknowns.size(); ++j) {
        if (m.z->depends(a[j], unknowns)) return false;
        rest.push_back(-a[j] * unknowns[j]);
    }
    const ex r0 = m.z->name(GiNaC::add(std::move(rest)));
    if (std::all_of(a.begin(), a.end(), [](const ex& x) { return x.is_zero(); })) return zero(r0, m);

    for (std::size_t i = 0; i < n + k; ++i) {
        std::vector<ex> R(unknowns.size(), 0);
        for (std::size_t j = 0; j < n; ++j)
            R[j] = i < n ? e.M(static_cast<unsigned>(i), static_cast<unsigned>(j)) : e.A[i - n][j];
        for (std::size_t c = 0; i < n && c < k; ++c) R[n + c] = -e.A[c][i];
        const ex rho = i < n ? e.forcing(static_cast<int>(i)) : e.gamma[i - n];
        const auto pivot = std::find_if(R.begin(), R.end(), [](const ex& x) { return !x.is_zero(); });
        if (pivot == R.end()) continue;
        const auto j = static_cast<std::size_t>(pivot - R.begin());
        if (a[j].is_zero()) continue;
        bool proportional = zero(*pivot * r0 + a[j] * rho, m);
        for (std::size_t c = 0; c < R.size() && proportional; ++c)
            if (c != j) proportional = (R[c].is_zero() && a[c].is_zero()) || zero(a[j] * R[c] - a[c] * R[j], m);
        if (proportional) return true;
    }
    if (k > 0 || n > 3) return false;
    // det(M) r₀ + Σ_j a_j det(M with column j replaced by f) = 0
    GiNaC::exvector sum{e.M.determinant() * r0};
    for (std::size_t j = 0; j < n; ++j) {
        GiNaC::matrix replaced = e.M;
        for (std::size_t i = 0; i < n; ++i)
            replaced(static_cast<unsigned>(i), static_cast<unsigned>(j)) = e.forcing(static_cast<int>(i));
        sum.push_back(a[j] * replaced.determinant());
    }
    return zero(GiNaC::add(std::move(sum)), m);
}

}  // namespace alembert
