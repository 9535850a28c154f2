// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The equations of one formalism as numbers: rows of coefficients and a right-hand side, exactly modulo a prime
/// or in floating point.
///
/// The unknowns are hidden ones, then the multipliers of constraints that every system keeps, then q''. The hidden
/// ones are u' of a system in speeds, and the multipliers of constraints that another system has eliminated. In
/// reduced row echelon form, the rows whose pivots come after the hidden columns are the equations for the other
/// unknowns.

#include <map>
#include <optional>

#include "program/interpret.hpp"
#include "program/lower/lower.hpp"
#include "program/modular.hpp"

namespace alembert {

struct EquationSystem {
    std::string formalism;
    Program program;
    int n = 0, speeds = 0;            ///< coordinates, speeds
    int states = 0;                   ///< first-order states, which are given
    std::vector<int> mass, forcing;   ///< mass is the lower triangle
    std::vector<std::vector<int>> A;  ///< the rows in terms of speeds
    std::vector<int> gamma, rates,
        second;                  ///< `rates` are q', `second` is q'' in terms of u'; both are empty if u = q'
    std::vector<int> columns;    ///< the columns of the multipliers of A's rows
    int hidden = 0, common = 0;  ///< columns
    std::vector<int> wanted;

    /// Whether u = q', so that no constraint is eliminated.
    bool is_plain() const { return rates.empty(); }
    int unknowns() const { return hidden + common; }
};

/// `somewhere_eliminated` are positions in Mechanism::constraints of constraints that one of the systems has
/// eliminated.
EquationSystem system_of(const Equations& equations, const Mechanism& mechanism,
                         const std::vector<int>& somewhere_eliminated);

/// The values of all nodes, and q'' = B u' + c.
template <typename Real>
struct SystemValues {
    std::vector<Real> value;
    std::vector<Real> c;
    std::vector<std::vector<Real>> B;  ///< one column for each speed
};

/// The rows of −Aᵀλ + M u' = f, A u' = γ, q'' − B u' = c.
template <typename Real>
std::vector<std::vector<Real>> rows_of(const EquationSystem& s, const SystemValues<Real>& at) {
    const std::size_t size = static_cast<std::size_t>(s.speeds), width = static_cast<std::size_t>(s.unknowns());
    // The first column of u'.
    const std::size_t q = width - static_cast<std::size_t>(s.n), u = s.is_plain() ? q : 0;
    std::vector<std::vector<Real>> result;
    for (std::size_t i = 0; i < size; ++i) {
        std::vector<Real> row(width + 1, Real(0));
        for (std::size_t k = 0; k < s.A.size(); ++k) row[s.columns[k]] = Real(0) - at.value[s.A[k][i]];
        for (std::size_t j = 0; j < size; ++j) {
            const std::size_t a = std::max(i, j), b = std::min(i, j);
            row[u + j] = at.value[s.mass[a * (a + 1) / 2 + b]];
        }
        row[width] = at.value[s.forcing[i]];
        result.push_back(std::move(row));
    }
    for (std::size_t k = 0; k < s.A.size(); ++k) {
        std::vector<Real> row(width + 1, Real(0));
        for (std::size_t i = 0; i < size; ++i) row[u + i] = at.value[s.A[k][i]];
        row[width] = at.value[s.gamma[k]];
        result.push_back(std::move(row));
    }
    for (std::size_t i = 0; i < at.c.size(); ++i) {
        std::vector<Real> row(width + 1, Real(0));
        row[q + i] = Real(1);
        for (std::size_t k = 0; k < size; ++k) row[u + k] = Real(0) - at.B[k][i];
        row[width] = at.c[i];
        result.push_back(std::move(row));
    }
    return result;
}

/// Computes B and c with `evaluate(accelerations)`, which gives the values of all nodes for given u'.
template <typename Real, typename Evaluate>
SystemValues<Real> values_of(const EquationSystem& s, const Evaluate& evaluate) {
    std::vector<Real> udot(static_cast<std::size_t>(s.speeds), Real(0));
    SystemValues<Real> result{.value = evaluate(udot), .c = {}, .B = {}};
    if (s.is_plain() || result.value.empty()) return result;
    for (const int id : s.second) result.c.push_back(result.value[id]);
    for (int k = 0; k < s.speeds; ++k) {
        udot[k] = Real(1);
        const std::vector<Real> value = evaluate(udot);
        udot[k] = Real(0);
        result.B.emplace_back();
        for (std::size_t i = 0; i < result.c.size(); ++i)
            result.B.back().push_back(value[s.second[i]] - result.c[i]);
    }
    return result;
}

/// Given values of the rates; those that are missing are random.
using RatesModP = std::map<std::pair<Variable::Kind, int>, Prime>;

struct Echelon {
    std::vector<std::vector<Prime>> rows;  ///< the rows for the unknowns that are not hidden
    double degree = 1, conditions = 0;
};

/// q' for random u; nothing at an unusable point. `degree` is that of these values in the random ones.
struct ModularRates {
    RatesModP rates;
    double degree = 1;
};
std::optional<ModularRates> rates_at(const EquationSystem& system, const ModularPoint& point);
std::optional<Echelon> echelon(const EquationSystem& system, ModularPoint point, const ModularRates& rates);

}  // namespace alembert
