// SPDX-License-Identifier: GPL-2.0-or-later
// Two systems of linear equations have the same solutions if and only if their reduced row echelon forms are equal.
// A rational identity of degree d that is false holds at a random point of GF(p) with a chance of at most d/p
// (Schwartz, J. ACM 27 (1980) 701; Zippel, EUROSAM 79). With Cramer's rule d ≤ 2 (n deg M + deg f).
#include "analysis/agree.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <random>

#include "lower/interpret.hpp"
#include "lower/lower.hpp"
#include "lower/modular.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

/// One formalism's equations as a program: which node each entry of [−Aᵀ M f; 0 A γ] is.
struct System {
    std::string formalism;
    Program program;
    int n = 0;
    std::vector<int> mass, forcing;           // mass: lower triangle
    std::vector<std::vector<int>> A;
    std::vector<int> gamma;
    std::vector<int> wanted;

    /// Rows of m + n unknowns (λ, u') and the right-hand side. `one` is Real's 1.
    template <typename Real>
    std::vector<std::vector<Real>> rows(const std::vector<Real>& value) const {
        const std::size_t m = A.size(), size = static_cast<std::size_t>(n);
        std::vector<std::vector<Real>> result(size + m, std::vector<Real>(m + size + 1, Real(0)));
        for (std::size_t i = 0; i < size; ++i) {
            for (std::size_t k = 0; k < m; ++k) {
                result[i][k] = Real(0) - value[A[k][i]];
                result[size + k][m + i] = value[A[k][i]];
            }
            for (std::size_t j = 0; j < size; ++j) {
                const std::size_t a = std::max(i, j), b = std::min(i, j);
                result[i][m + j] = value[mass[a * (a + 1) / 2 + b]];
            }
            result[i][m + size] = value[forcing[i]];
        }
        for (std::size_t k = 0; k < m; ++k) result[size + k][m + size] = value[gamma[k]];
        return result;
    }
};

System system_of(const Equations& e, const Mechanism& m) {
    Energy none;
    none.kinetic = none.potential = none.energy = none.jacobi = none.power = 0;
    System s{.formalism = e.formalism, .program = lower(m, e, none), .n = e.size(), .mass = {}, .forcing = {}, .A = {}, .gamma = {}, .wanted = {}};
    s.mass = s.program.nodes_of("mass");
    s.forcing = s.program.nodes_of("forcing");
    s.gamma = s.program.nodes_of("gamma");
    const std::vector<int> row = s.program.nodes_of("row");
    for (std::size_t k = 0; k < s.gamma.size(); ++k)
        s.A.emplace_back(row.begin() + static_cast<std::ptrdiff_t>(k) * s.n, row.begin() + static_cast<std::ptrdiff_t>(k + 1) * s.n);
    s.wanted = s.mass;
    s.wanted.insert(s.wanted.end(), s.forcing.begin(), s.forcing.end());
    for (const auto& row : s.A) s.wanted.insert(s.wanted.end(), row.begin(), row.end());
    s.wanted.insert(s.wanted.end(), s.gamma.begin(), s.gamma.end());
    return s;
}

struct Echelon {
    std::vector<std::vector<Prime>> rows;
    double degree = 1, conditions = 0;
};

std::optional<Echelon> echelon(const System& s, const ModularPoint& point) {
    const auto at = evaluate_mod(s.program, point, s.wanted);
    if (!at) return std::nullopt;
    Echelon result{.rows = s.rows(at->value), .conditions = at->conditions};
    double entry = 0, right = 0;
    for (const int id : s.mass) entry = std::max(entry, at->degree[id]);
    for (const auto& row : s.A)
        for (const int id : row) entry = std::max(entry, at->degree[id]);
    for (const int id : s.forcing) right = std::max(right, at->degree[id]);
    for (const int id : s.gamma) right = std::max(right, at->degree[id]);
    result.degree = static_cast<double>(result.rows.size()) * entry + right + 1;
    reduce_rows(result.rows, result.rows.size());
    return result;
}

/// The largest residual of `b`'s rows at `a`'s solution over the largest term, in long double arithmetic at a random
/// state; nothing where that cannot be told.
std::optional<long double> residual(const System& a, const System& b, std::mt19937_64& random) {
    std::uniform_real_distribution<long double> positive(0.5L, 2.0L), turn(-1.5L, 1.5L);
    State<long double> state;
    for (std::size_t i = 0; i < a.program.parameters.size(); ++i) state.parameters.push_back(positive(random));
    state.t = positive(random);
    for (int i = 0; i < a.n; ++i) {
        state.q.push_back(turn(random));
        state.qdot.push_back(turn(random));
    }
    auto rows = a.rows(interpret(a.program, state));
    const auto other = b.rows(interpret(b.program, state));
    const std::size_t size = rows.size();
    std::vector<long double> x(size, 0);
    long double largest_pivot = 0;
    for (std::size_t k = 0; k < size; ++k) {
        std::size_t pivot = k;
        for (std::size_t r = k; r < size; ++r)
            if (std::abs(rows[r][k]) > std::abs(rows[pivot][k])) pivot = r;
        std::swap(rows[k], rows[pivot]);
        largest_pivot = std::max(largest_pivot, std::abs(rows[k][k]));
        if (!(std::abs(rows[k][k]) > 1e-9L * largest_pivot)) return std::nullopt;
        for (std::size_t r = k + 1; r < size; ++r) {
            const long double factor = rows[r][k] / rows[k][k];
            for (std::size_t c = k; c <= size; ++c) rows[r][c] -= factor * rows[k][c];
        }
    }
    for (std::size_t k = size; k-- > 0;) {
        x[k] = rows[k][size];
        for (std::size_t c = k + 1; c < size; ++c) x[k] -= rows[k][c] * x[c];
        x[k] /= rows[k][k];
    }
    long double worst = 0;
    for (const auto& row : other) {
        long double sum = -row[size], largest = std::abs(row[size]);
        for (std::size_t c = 0; c < size; ++c) {
            sum += row[c] * x[c];
            largest = std::max(largest, std::abs(row[c] * x[c]));
        }
        if (!std::isfinite(sum)) return std::nullopt;
        if (largest > 0) worst = std::max(worst, std::abs(sum) / largest);
    }
    return worst;
}

/// Are all entries equal by their normal forms? False too where that takes too long to tell.
bool equal_by_normal_form(const Equations& a, const Equations& b, const Mechanism& m, double seconds) {
    const auto start = std::chrono::steady_clock::now();
    const auto equal = [&](const ex& x, const ex& y) {
        if (x.is_equal(y)) return true;
        const std::chrono::duration<double> used = std::chrono::steady_clock::now() - start;
        return used.count() < seconds && m.z->tree_size(x) + m.z->tree_size(y) < 20000 && vanishes(x - y, m) == true;
    };
    for (int i = 0; i < a.size(); ++i) {
        for (int j = 0; j <= i; ++j)
            if (!equal(a.M(i, j), b.M(i, j))) return false;
        if (!equal(a.forcing(i), b.forcing(i))) return false;
    }
    for (std::size_t k = 0; k < a.A.size(); ++k) {
        for (int i = 0; i < a.size(); ++i)
            if (!equal(a.A[k][i], b.A[k][i])) return false;
        if (!equal(a.gamma[k], b.gamma[k])) return false;
    }
    return true;
}

}  // namespace

Derivations derive_all(const Mechanism& mechanism) {
    Derivations result;
    for (const Formalism& f : formalisms()) {
        if (f.name == "routh" && mechanism.constraints.empty()) continue;  // Lagrange's, word for word
        try {
            result.equations.push_back(f.derive(mechanism));
        } catch (const ModelError& e) {
            result.refused.emplace_back(f.name, e.what());
        }
    }
    return result;
}

Agreement agree(const std::vector<Equations>& equations, const Mechanism& m, double seconds) {
    constexpr int most_unlucky = 20000;
    Agreement result;
    if (equations.size() < 2) {
        result.reason = "fewer than two formalisms apply";
        return result;
    }
    std::vector<System> systems;
    for (const Equations& e : equations) {
        if (e.A.size() != equations[0].A.size() || e.size() != equations[0].size()) {
            result.reason = fmt::format("{} and {} have different unknowns", equations[0].formalism, e.formalism);
            return result;
        }
        systems.push_back(system_of(e, m));
    }

    int unlucky = 0;
    for (std::uint64_t seed = 1; result.failure > -60; ++seed) {
        const ModularPoint point{.seed = seed};
        std::vector<Echelon> forms;
        for (const System& s : systems) {
            auto form = echelon(s, point);
            if (!form) break;
            forms.push_back(std::move(*form));
        }
        if (forms.size() < systems.size()) {
            if (++unlucky < most_unlucky) continue;
            result.reason = "no point was found where all roots exist";
            return result;
        }
        double degree = 0, conditions = 0;
        for (const Echelon& form : forms) {
            degree += form.degree + forms[0].degree;
            conditions = std::max(conditions, form.conditions);
        }
        for (std::size_t k = 1; k < forms.size(); ++k) {
            if (forms[k].rows == forms[0].rows) continue;
            std::mt19937_64 random(seed);
            int tried = 0;
            for (int attempt = 0; attempt < 32; ++attempt)
                if (const auto r = residual(systems[0], systems[k], random); r && ++tried && *r > 1e-9L) {
                    result.verdict = Agreement::Verdict::refuted;
                    result.reason = fmt::format("{} and {} differ: at a random state an equation of the second is off by {:.2g} "
                                                "of its largest term with the accelerations of the first",
                                                systems[0].formalism, systems[k].formalism, static_cast<double>(*r));
                    return result;
                }
            result.reason = fmt::format("{} and {} differ in exact arithmetic that does not know all identities, and agree at "
                                        "{} random states",
                                        systems[0].formalism, systems[k].formalism, tried);
            return result;
        }
        ++result.points;
        const double chance = std::log2(degree) + conditions - 61;
        if (chance > -1) {
            result.reason = "the equations are of too high a degree for a bound on the failure of sampling";
            return result;
        }
        result.failure += chance;
    }
    result.verdict = Agreement::Verdict::proved;
    result.normal_form = true;
    const auto start = std::chrono::steady_clock::now();
    for (std::size_t k = 1; k < equations.size() && result.normal_form; ++k) {
        const std::chrono::duration<double> used = std::chrono::steady_clock::now() - start;
        result.normal_form = equal_by_normal_form(equations[0], equations[k], m, seconds - used.count());
    }
    return result;
}

}  // namespace alembert
