// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/arnold.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/language/say.hpp"
#include "model/energy.hpp"
#include "model/formalism/elements.hpp"
#include "program/lower/lower.hpp"
#include "stability/linear/dense_long.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

using Complex = std::complex<double>;
using Powers = std::array<int, 4>;  // of z₁, z₂, z̄₁, z̄₂; or of q₁, q₂, p₁, p₂
using PowerSums = std::map<Powers, Complex>;

int degree(const Powers& p) {
    return p[0] + p[1] + p[2] + p[3];
}

PowerSums product(const PowerSums& a, const PowerSums& b, int highest) {
    PowerSums result;
    for (const auto& [p, c] : a)
        for (const auto& [r, d] : b) {
            const Powers sum{p[0] + r[0], p[1] + r[1], p[2] + r[2], p[3] + r[3]};
            if (degree(sum) <= highest) result[sum] += c * d;
        }
    return result;
}

PowerSums part(const PowerSums& s, int of_degree) {
    PowerSums result;
    for (const auto& [p, c] : s)
        if (degree(p) == of_degree) result[p] = c;
    return result;
}

/// {a, b} with {z, z̄} = −i.
PowerSums bracket(const PowerSums& a, const PowerSums& b) {
    PowerSums result;
    for (const auto& [p, c] : a)
        for (const auto& [r, d] : b)
            for (int k = 0; k < 2; ++k) {
                const Powers sum{p[0] + r[0], p[1] + r[1], p[2] + r[2], p[3] + r[3]};
                Powers less = sum;
                --less[k];
                --less[k + 2];
                const double factor = p[k] * r[k + 2] - p[k + 2] * r[k];
                if (factor != 0) result[less] += Complex(0, -1) * factor * c * d;
            }
    return result;
}

/// H to fourth order in (q₁, q₂, p₁, p₂), deviations of essential coordinates and their momenta; momenta of cyclic
/// coordinates are constant.
std::optional<PowerSums> hamiltonian(const Local& local, const ex& H) {
    const Mechanism& m = local.mechanism;
    const std::size_t n = m.q.size();
    std::vector<int> free;
    for (const int r : local.essential) free.push_back(local.split.q[r]);
    const std::vector<ex> momenta = m.z->pull_back({{m.lagrangian(), 1}}, m.qdot);
    GiNaC::exmap rest;
    for (const GiNaC::symbol& rate : m.qdot) rest[rate] = 0;
    std::vector<ex> wanted = substitute(*m.z, momenta, rest);  // b of p = M v + b
    wanted.insert(wanted.end(), momenta.begin(), momenta.end());
    for (std::size_t j = 0; j < n; ++j) {
        const std::vector<ex> column = m.z->push_forward(momenta, {{m.qdot[j], 1}});
        for (const ex& entry : column)
            if (m.z->depends(entry, m.qdot)) return {};
        wanted.insert(wanted.end(), column.begin(), column.end());
    }
    wanted.push_back(H);
    Program program = begun(m);
    const std::vector<int> nodes = lower_expressions(program, m, wanted);
    const Monomials monomials(4, 4);
    const std::vector<int> held(2 * n, -1);
    State<Expansion> state = local.state_at(local.point, nullptr, held);
    RealBallVector p0;
    const std::vector<Expansion> at_point = interpret(program, state);
    for (std::size_t i = 0; i < n; ++i) p0.push_back(at_point[nodes[n + i]].value());
    for (int k = 0; k < 2; ++k) state.q[free[k]] = Expansion::variable(monomials, k, local.point.q[free[k]]);
    const std::vector<Expansion> value = interpret(program, state);
    std::vector<std::vector<Expansion>> M(n, std::vector<Expansion>(n + 1));
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) M[i][j] = value[nodes[2 * n + j * n + i]];
        Expansion p(p0[i]);
        for (int k = 0; k < 2; ++k)
            if (free[k] == static_cast<int>(i)) p = Expansion::variable(monomials, 2 + k, p0[i]);
        M[i][n] = p - value[nodes[i]];
    }
    for (std::size_t k = 0; k < n; ++k)
        for (std::size_t i = 0; i < n; ++i) {
            if (i == k) continue;
            const Expansion factor = M[i][k] / M[k][k];
            for (std::size_t j = k; j <= n; ++j) M[i][j] = M[i][j] - factor * M[k][j];
        }
    for (std::size_t i = 0; i < n; ++i) state.qdot[i] = M[i][n] / M[i][i];
    const Expansion energy = interpret(program, state)[nodes.back()];
    PowerSums result;
    for (int k = 0; k < monomials.size(); ++k) {
        const Monomials::Exponents& e = monomials.exponents(k);
        if (monomials.degree_of(k) >= 2) result[{e[0], e[1], e[2], e[3]}] = energy.coefficient(k).number();
    }
    return result;
}

/// Canonical variables in which the quadratic part is Σ Ω_k (x_k² + y_k²)/2; columns x₁, x₂, y₁, y₂.
std::optional<std::pair<Eigen::Matrix4d, std::array<double, 2>>> normal_variables(const PowerSums& H) {
    Eigen::Matrix4d S = Eigen::Matrix4d::Zero(), J = Eigen::Matrix4d::Zero();
    for (const auto& [p, c] : part(H, 2)) {
        std::vector<int> which;
        for (int k = 0; k < 4; ++k) which.insert(which.end(), static_cast<std::size_t>(p[k]), k);
        S(which[0], which[1]) += c.real();
        S(which[1], which[0]) += c.real();
    }
    for (int k = 0; k < 2; ++k) {
        J(k, k + 2) = 1;
        J(k + 2, k) = -1;
    }
    const std::optional<LongEigenpairs> eigen = eigenpairs_of((J * S).cast<long double>());
    if (!eigen) return {};
    Eigen::Matrix4d basis;
    std::array<double, 2> frequencies{};
    int found = 0;
    for (int k = 0; k < 4; ++k) {
        const Complex value(eigen->values[static_cast<std::size_t>(k)]);
        if (!(value.imag() > 0)) continue;
        if (found == 2 || std::abs(value.real()) > 1e-9 * value.imag()) return {};
        const Eigen::Vector4cd vector = eigen->vectors.col(k).cast<Complex>();
        Eigen::Vector4d a = vector.real(), b = vector.imag();
        const double s = a.dot(J * b), sign = s > 0 ? 1 : -1;
        if (std::abs(s) < 1e-9) return {};
        a /= std::sqrt(std::abs(s));
        b /= std::sqrt(std::abs(s));
        basis.col(found) = s > 0 ? a : b;
        basis.col(found + 2) = s > 0 ? b : a;
        frequencies[found++] = sign * value.imag();
    }
    if (found != 2) return {};
    return std::pair(basis, frequencies);
}

/// The same function of z and z̄.
PowerSums in_complex(const PowerSums& H, const Eigen::Matrix4d& basis) {
    std::array<PowerSums, 4> old;
    const double half = std::sqrt(0.5);
    for (int row = 0; row < 4; ++row)
        for (int k = 0; k < 2; ++k) {  // x = (z + z̄)/√2, y = (z − z̄)/(i√2)
            const Complex x = basis(row, k) * half, y = Complex(0, -1) * basis(row, k + 2) * half;
            Powers z{}, z_bar{};
            z[k] = z_bar[k + 2] = 1;
            old[row][z] += x + y;
            old[row][z_bar] += x - y;
        }
    PowerSums result;
    for (const auto& [p, c] : H) {
        PowerSums term{{Powers{}, c}};
        for (int row = 0; row < 4; ++row)
            for (int e = 0; e < p[row]; ++e) term = product(term, old[row], 4);
        for (const auto& [powers, value] : term) result[powers] += value;
    }
    return result;
}

}  // namespace

Decision by_arnold(const Local& local, const PowerSign& power, const std::vector<RootOf>& roots) {
    const Mechanism& m = local.mechanism;
    if (!power.is_zero || !m.constraints.empty() || !local.residuals.rates_are_speeds ||
        local.essential.size() != 2 || local.A.rows != 4)
        return {};
    for (const RootOf& root : roots)
        if (root.side != RootOf::Side::axis || root.multiplicity > 1) return {};
    for (const bool dissipative : {true, false})
        for (const ex& load : m.generalized_forces(dissipative))
            if (!is_identically_zero(load, m)) return {};
    const auto H = hamiltonian(local, power.H);
    const auto normal = H ? normal_variables(*H) : std::nullopt;
    if (!normal) return {};
    const auto& [basis, W] = *normal;
    const double high = std::max(std::abs(W[0]), std::abs(W[1])), low = std::min(std::abs(W[0]), std::abs(W[1]));
    for (const int ratio : {1, 2, 3})
        if (std::abs(high - ratio * low) < 1e-7 * high) return {};
    const PowerSums all = in_complex(*H, basis), cubic = part(all, 3);
    PowerSums generator;
    for (const auto& [p, c] : cubic) generator[p] = -c / Complex(0, W[0] * (p[0] - p[2]) + W[1] * (p[1] - p[3]));
    const PowerSums second = bracket(cubic, generator);
    double size = 0;
    const auto coefficient = [&](const Powers& p) {
        Complex value = 0;
        if (const auto found = all.find(p); found != all.end())
            value += found->second, size += std::abs(found->second);
        if (const auto found = second.find(p); found != second.end())
            value += 0.5 * found->second, size += 0.5 * std::abs(found->second);
        return value.real();
    };
    const double a = coefficient({2, 0, 2, 0}), b = coefficient({1, 1, 1, 1}), c = coefficient({0, 2, 0, 2});
    const double D = a * W[1] * W[1] - b * W[0] * W[1] + c * W[0] * W[0];
    if (!(std::abs(D) > 1e-7 * size * high * high)) return {};
    return {StabilityVerdict::stable, StabilityTheorem::arnold,
            say("the Hamiltonian has the frequencies {:.8g} and {:.8g}, without resonances up to order four, and "
                "D = {:.6g} of its normal form is not zero",
                W[0], W[1], D)};
}

}  // namespace alembert
