// SPDX-License-Identifier: GPL-2.0-or-later
// Two systems of linear equations have the same solutions if and only if their reduced row echelon forms are
// equal. A rational identity of degree d that is false holds at a random point of GF(p) with a probability of at
// most d/p (Schwartz, J. ACM 27 (1980) 701; Zippel, EUROSAM 79). With Cramer's rule d ≤ 2 (n deg M + deg f).
#include "analysis/agree/agree.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "alembert/base/random.hpp"
#include "analysis/agree/system.hpp"
#include "analysis/exact/quadratic_residue_points.hpp"
#include "analysis/state/redundancy.hpp"
#include "analysis/state/speeds.hpp"
#include "base/language/say.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

/// Solves a square system by elimination with row exchanges; nothing if a pivot is small compared with the
/// largest.
std::optional<std::vector<long double>> solved(std::vector<std::vector<long double>> rows) {
    const std::size_t size = rows.size();
    if (size == 0 || rows[0].size() != size + 1) return std::nullopt;
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
    return x;
}

std::vector<std::vector<long double>> rows_at(const EquationSystem& s, State<long double> state) {
    return rows_of(s, values_of<long double>(s, [&](const std::vector<long double>& udot) {
                       if (!s.is_plain()) state.qddot = udot;
                       return interpret(s.program, state);
                   }));
}

/// In long double arithmetic at a random state: the largest residual of `b`'s rows for `a`'s solution, divided by
/// the largest term. If the two have different unknowns, the difference of the unknowns that they share, divided
/// by the largest. Nothing if that cannot be computed.
std::optional<long double> residual(const EquationSystem& a, const EquationSystem& b, std::mt19937_64& random) {
    const UniformReal<long double> positive(0.5L, 2.0L), turn(-1.5L, 1.5L);
    State<long double> state;
    for (std::size_t i = 0; i < a.program.parameters.size(); ++i) state.parameters.push_back(positive(random));
    state.t = positive(random);
    for (int i = 0; i < a.n; ++i) {
        state.q.push_back(turn(random));
        state.qdot.push_back(turn(random));
    }
    state.qdot.resize(static_cast<std::size_t>(a.n));
    for (int k = 0; k < a.states; ++k) state.qdot.push_back(turn(random));
    State<long double> plain = state;  // the state with q' in place of u
    for (const EquationSystem* s : {&a, &b}) {
        if (s->is_plain()) continue;
        const auto value = interpret(s->program, state);
        for (int i = 0; i < a.n; ++i) plain.qdot[i] = value[s->rates[i]];
    }
    const auto x = solved(rows_at(a, a.is_plain() ? plain : state));
    if (!x) return std::nullopt;
    const auto other = rows_at(b, b.is_plain() ? plain : state);
    long double worst = 0;
    if (a.hidden != b.hidden || a.is_plain() != b.is_plain()) {
        const auto y = solved(other);
        if (!y) return std::nullopt;
        long double largest = 0;
        for (int k = 0; k < a.common; ++k) {
            largest = std::max({largest, std::abs((*x)[a.hidden + k]), std::abs((*y)[b.hidden + k])});
            worst = std::max(worst, std::abs((*x)[a.hidden + k] - (*y)[b.hidden + k]));
        }
        if (!std::isfinite(largest)) return std::nullopt;
        return largest > 0 ? worst / largest : 0;
    }
    const std::size_t size = x->size();
    for (const auto& row : other) {
        long double sum = -row[size], largest = std::abs(row[size]);
        for (std::size_t c = 0; c < size; ++c) {
            sum += row[c] * (*x)[c];
            largest = std::max(largest, std::abs(row[c] * (*x)[c]));
        }
        if (!std::isfinite(sum)) return std::nullopt;
        if (largest > 0) worst = std::max(worst, std::abs(sum) / largest);
    }
    return worst;
}

/// Do all entries have equal normal forms? False also if deciding that takes more work than `left`, the size of
/// the expressions that may still be compared. It is reduced by those that are.
bool equal_by_normal_form(const Equations& a, const Equations& b, const Mechanism& mechanism, double& left) {
    if (a.speeds_are_rates() != b.speeds_are_rates() || a.A.size() != b.A.size()) return false;
    const Mechanism m = in_terms_of(a, mechanism);
    m.z->adopt(*b.z);
    const auto equal = [&](const ex& x, const ex& y) {
        if (x.is_equal(y)) return true;
        const double size = m.z->tree_size(x) + m.z->tree_size(y);
        left -= size;
        return left >= 0 && size < 20000 && vanishes(x - y, m) == true;
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
    for (std::size_t i = 0; i < a.h.size(); ++i)
        if (!equal(a.h[i], b.h[i])) return false;
    return true;
}

}  // namespace

Derivations derive_all(const Mechanism& mechanism) {
    Derivations result;
    // With the intermediate symbols of the formalisms before, so that equal expressions have the same symbol.
    Mechanism m = mechanism;
    for (const Formalism& f : formalisms()) {
        if (!f.without_constraints.empty() && mechanism.constraints.empty())
            continue;  // this formalism is identical with another one
        if (const auto obstacle = f.obstacle(m)) {
            result.refused.emplace_back(f.name, *obstacle);
            continue;
        }
        result.equations.push_back(f.derive(m));
        m.z = result.equations.back().z;
    }
    return result;
}

namespace {

/// The reason why equations in speeds cannot be compared, if there is one.
std::string obstacle_in_speeds(const std::vector<Equations>& equations) {
    const Equations* in_speeds = nullptr;
    for (const Equations& e : equations) {
        if (e.speeds_are_rates()) continue;
        if (in_speeds == nullptr) in_speeds = &e;
        if (e.u != in_speeds->u)
            return say("{} and {} are in different speeds", in_speeds->formalism, e.formalism);
    }
    return {};
}

std::vector<EquationSystem> systems_of(const std::vector<Equations>& equations, const Mechanism& m) {
    std::vector<int> eliminated;
    for (const Equations& e : equations)
        for (const Equations::Eliminated& constraint : e.eliminated) eliminated.push_back(constraint.constraint);
    std::vector<EquationSystem> systems;
    for (const Equations& e : equations) systems.push_back(system_of(e, m, eliminated));
    return systems;
}

/// The same equations modulo a prime, at points where all of them have values.
class SampledSystems {
public:
    explicit SampledSystems(const std::vector<EquationSystem>& systems)
        : systems_(systems), usable_(parts_of(systems), {}) {
        for (const QuadraticResiduePoints::Part& part : parts_of(systems))
            finer_ = std::max(finer_, halvings(*part.program, part.roots) - ModularPoint{}.halves);
        for (const EquationSystem& s : systems)
            if (!s.is_plain()) speeds_ = &s;
    }

    /// The reduced rows of each system at one point; fewer than systems if one has no value there.
    std::vector<Echelon> at(std::uint64_t seed) const {
        const auto point = usable_.at({.seed = seed, .given = {}, .given_angles = {}, .finer = finer_});
        const auto rates = !point               ? std::nullopt
                           : speeds_ != nullptr ? rates_at(*speeds_, *point)
                                                : std::optional(ModularRates{});
        std::vector<Echelon> forms;
        for (const EquationSystem& s : systems_) {
            auto form = rates ? echelon(s, *point, *rates) : std::nullopt;
            if (!form) break;
            forms.push_back(std::move(*form));
        }
        return forms;
    }

private:
    static std::vector<QuadraticResiduePoints::Part> parts_of(const std::vector<EquationSystem>& systems) {
        std::vector<QuadraticResiduePoints::Part> parts;
        for (const EquationSystem& s : systems) {
            parts.push_back({&s.program, s.wanted});
            parts.back().roots.insert(parts.back().roots.end(), s.rates.begin(), s.rates.end());
        }
        return parts;
    }

    const std::vector<EquationSystem>& systems_;
    QuadraticResiduePoints usable_;
    int finer_ = 0;
    const EquationSystem* speeds_ = nullptr;  ///< one in speeds, which determines the rates
};

/// log₂ of the probability that equal rows at one random point are an accident.
double chance_of(const std::vector<Echelon>& forms) {
    double degree = 0, conditions = 0;
    for (const Echelon& form : forms) {
        degree += form.degree + forms[0].degree;
        conditions = std::max(conditions, form.conditions);
    }
    return std::log2(degree) + conditions - 61;
}

/// What follows where two systems differ in exact arithmetic: refuted if they differ as numbers too.
void tell_difference(Agreement& result, const EquationSystem& first, const EquationSystem& other,
                     std::uint64_t seed) {
    std::mt19937_64 random(seed);
    int tried = 0;
    for (int attempt = 0; attempt < 32; ++attempt)
        if (const auto r = residual(first, other, random); r && ++tried && *r > 1e-9L) {
            result.verdict = Agreement::Verdict::refuted;
            result.reason =
                say("{} and {} differ: at a random state an equation of the second is off by {:.2g} "
                    "of its largest term with the accelerations of the first",
                    first.formalism, other.formalism, static_cast<double>(*r));
            return;
        }
    result.reason =
        say("{} and {} differ in exact arithmetic that does not know all identities, and agree at "
            "{} random states",
            first.formalism, other.formalism, tried);
}

/// Compares at random points until the probability of an error is small; false, with the reason, if that is never
/// reached.
bool agree_at_points(Agreement& result, const std::vector<EquationSystem>& systems) {
    constexpr int most_unusable = 2000;
    const SampledSystems sampled(systems);
    int unusable = 0;
    for (std::uint64_t seed = 1; result.failure > -60; ++seed) {
        const std::vector<Echelon> forms = sampled.at(seed);
        if (forms.size() < systems.size()) {
            if (++unusable < most_unusable) continue;
            result.reason = say("no point was found where all roots exist");
            return false;
        }
        for (std::size_t k = 1; k < forms.size(); ++k)
            if (forms[k].rows != forms[0].rows) {
                tell_difference(result, systems[0], systems[k], seed);
                return false;
            }
        ++result.points;
        const double chance = chance_of(forms);
        if (chance > -1) {
            result.reason = say("the equations are of too high a degree for a bound on the failure of sampling");
            return false;
        }
        result.failure += chance;
    }
    return true;
}

}  // namespace

Agreement agree(const std::vector<Equations>& equations, const Mechanism& m, double work) {
    Agreement result;
    result.reason = equations.size() < 2 ? say("fewer than two formalisms apply") : obstacle_in_speeds(equations);
    if (!result.reason.empty() || !agree_at_points(result, systems_of(equations, m))) return result;
    result.verdict = Agreement::Verdict::proved;
    result.normal_form = true;
    double left = work;
    for (std::size_t k = 1; k < equations.size() && result.normal_form; ++k)
        result.normal_form = equal_by_normal_form(equations[0], equations[k], m, left);
    return result;
}

Agreed agree(Scene scene, double work) {
    const auto start = std::chrono::steady_clock::now();
    Agreed result{prepared(std::move(scene))};
    Mechanism& m = result.mechanism;
    const auto redundant = redundant_constraints(m);   // before m is moved
    m = without_constraints(std::move(m), redundant);  // as in `derive`
    if (const std::optional<Diagnostic> mistake = mistake_in_speeds(m)) fail(result.scene, {*mistake});
    result.derivations = derive_all(m);
    result.agreement = agree(result.derivations.equations, m, work);
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
}

}  // namespace alembert
