// SPDX-License-Identifier: GPL-2.0-or-later
// Routh: if cyclic speeds are eliminated by their momenta, M_cc δw_c = −M_ce δw_e − D_ce δr_e + constant, there
// remains
//   K = P_ee − D_ec M_cc⁻¹ D_ce
// as the stiffness of the reduced system. (Pars, A Treatise on Analytical Dynamics (1965), §9.6.)
#include "stability/equilibrium/judge.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/language/say.hpp"
#include "stability/interval/disc.hpp"
#include "stability/linear/dense_long.hpp"
#include "stability/linear/paths.hpp"

namespace alembert {

using Index = Eigen::Index;
using Matrix = MatrixOf<long double>;

namespace {

// Relative to the largest eigenvalue; double eigenvalues are accurate only to the square root of rounding.
constexpr long double on_axis = 1e-8L;

struct Reduced {
    std::vector<Index> e;            ///< columns of essential coordinates
    std::vector<Index> own, others;  ///< speeds: the rates of these coordinates, and the others
    Matrix A;
};

Reduced reduced(const SteadyProblem& problem, const Split& split, const Tangent<long double>& t) {
    Reduced result;
    const Index nr = static_cast<Index>(split.q.size()), p = static_cast<Index>(split.u.size());
    for (Index j = 0; j < nr; ++j)
        if (problem.essential()[split.q[j]]) result.e.push_back(j);
    if (problem.residuals().rates_are_speeds) {
        for (const Index j : result.e)
            for (Index i = 0; i < p; ++i)
                if (split.u[i] == split.q[j]) result.own.push_back(i);
    }
    for (Index i = 0; i < p; ++i)
        if (std::find(result.own.begin(), result.own.end(), i) == result.own.end()) result.others.push_back(i);
    const Index n = static_cast<Index>(result.e.size());
    result.A.resize(n + p, n + p);
    for (Index j = 0; j < n; ++j) {
        result.A.row(j).tail(p) = t.rates_by.row(result.e[j]).middleCols(nr, p);
        for (Index k = 0; k < n; ++k) result.A(j, k) = t.rates_by(result.e[j], result.e[k]);
        result.A.col(j).tail(p) = t.speed_rates_by.col(result.e[j]);
    }
    result.A.bottomRightCorner(p, p) = t.speed_rates_by.middleCols(nr, p);
    return result;
}

Matrix part(const Matrix& m, const std::vector<Index>& rows, const std::vector<Index>& columns) {
    Matrix result(rows.size(), columns.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
        for (std::size_t j = 0; j < columns.size(); ++j)
            result(static_cast<Index>(i), static_cast<Index>(j)) = m(rows[i], columns[j]);
    return result;
}

/// Is the energy, with constant cyclic momenta, at a minimum to second order?
bool is_minimum(const Reduced& r, const Tangent<long double>& t, Index nr) {
    if (r.own.size() != r.e.size() || r.e.empty()) return false;
    const Matrix D = t.force.middleCols(nr, t.mass.cols()), P = t.force.leftCols(nr);
    Matrix K = part(P, r.own, r.e);
    if (!r.others.empty()) {
        const Matrix forces = part(P, r.others, r.e);
        if (forces.cwiseAbs().maxCoeff() > 1e-12L * (1 + K.cwiseAbs().maxCoeff())) return false;
        K -= part(D, r.own, r.others) * solve(part(t.mass, r.others, r.others), part(D, r.others, r.own));
    }
    const long double size = K.cwiseAbs().maxCoeff();
    if ((K - K.transpose()).cwiseAbs().maxCoeff() > 1e-12L * size) return false;
    return least_eigenvalue((K + K.transpose()) / 2) > 1e-10L * size;
}

/// Does some inertia vanish here but not close to this state, as at a pole of spherical coordinates?
bool is_singular(const SteadyProblem& problem, const Instant<long double>& at, const Matrix& mass) {
    constexpr long double beside = 0.1L, nothing = 1e-11L;
    const auto least = [](const Matrix& m) { return m.rows() == 0 ? 1.0L : least_eigenvalue(m); };
    Instant<long double> other = at;
    for (std::size_t i = 0; i < other.q.size(); ++i)
        other.q[i] += beside * problem.scales()[i] / static_cast<long double>(i + 1);
    if (!problem.settle_at(other)) return false;
    const Split split = problem.linearized_at(other, other.u).split;
    return least(mass) < nothing * least(tangent(problem.residuals(), split, other).mass);
}

/// Are these zero eigenvalues those of a family of steady motions, one for each value of the cyclic rates?
bool zeros_are_rates(const SteadyProblem& problem, const Reduced& r, const SteadySystem& here,
                     const Instant<long double>& at, Index zeros) {
    constexpr long double no_pivot = 1e-9L, change = 1e-2L;
    const MatrixOf<long double>& kept = problem.kept_speeds();
    if (zeros != kept.rows()) return false;
    if (kernel_of(here.by, no_pivot).cols() != 0 || kernel_of(r.A, no_pivot).cols() != zeros) return false;
    for (Index k = 0; k < kept.rows(); ++k)
        for (const long double sign : {1.0L, -1.0L}) {
            Instant<long double> other = at;
            for (std::size_t i = 0; i < other.u.size(); ++i)
                other.u[i] += sign * change * kept(k, static_cast<Index>(i));
            if (!problem.solve(other)) return false;
        }
    return true;
}

/// Nothing where inertia is singular.
std::optional<Reduced> reduced_at(const SteadyProblem& problem, const Instant<long double>& at) {
    const SteadySystem here = problem.linearized_at(at, at.u);
    const Tangent<long double> t =
        tangent(problem.residuals(), here.split, at, is_at_kink(problem.residuals(), at));
    if (!t.speed_rates_by.allFinite()) return std::nullopt;
    return reduced(problem, here.split, t);
}

/// The accelerations by the coordinates; nothing where there are fewer speeds than coordinates.
std::optional<LongSingularValues> stiffness(const Reduced& r) {
    const Index n = static_cast<Index>(r.e.size());
    if (n == 0 || r.A.rows() < 2 * n) return std::nullopt;
    return singular_values(r.A.bottomLeftCorner(r.A.rows() - n, n));
}

/// At a state beside another one.
struct Beside {
    long double least = 0;  ///< singular value of the stiffness
    bool grows = false;     ///< whether some eigenvalue does
};

std::optional<Beside> beside(const SteadyProblem& problem, Instant<long double> at) {
    if (!problem.settle_at(at)) return std::nullopt;
    const std::optional<Reduced> r = reduced_at(problem, at);
    const auto values = r ? stiffness(*r) : std::nullopt;
    const auto found = r ? eigenvalues(r->A) : std::nullopt;
    if (!values || !found) return std::nullopt;
    long double size = 0;
    for (const auto& value : *found) size = std::max(size, std::abs(value));
    return Beside{.least = values->values[values->values.size() - 1],
                  .grows = std::any_of(found->begin(), found->end(),
                                       [&](const auto& value) { return value.real() > on_axis * size; })};
}

/// Whether Newton's method might take that state for a root.
bool is_balanced(const SteadyProblem& problem, Instant<long double> at) {
    constexpr long double nothing = 1e-12L;  // it is content with 1e-13 of the effect of an ordinary change
    if (!problem.settle_at(at)) return false;
    const SteadySystem there = problem.linearized_at(at, at.u);
    return there.residual.size() > 0 &&
           there.residual.cwiseAbs().maxCoeff() <= nothing * there.by.cwiseAbs().maxCoeff();
}

/// Of states at this distance, in units of the scales, along the softest direction; `unless_forced`: none where
/// there are forces.
Meeting meeting_within(const SteadyProblem& problem, const Instant<long double>& at, const Reduced& r,
                       const LongSingularValues& values, long double distance, bool unless_forced) {
    constexpr long double much = 0.5L, nothing = 1e-17L;
    const Index n = static_cast<Index>(r.e.size());
    const long double least = values.values[n - 1];
    const VectorOf<long double> softest = values.right.col(n - 1);
    const Split split = problem.linearized_at(at, at.u).split;
    std::vector<std::size_t> moved;
    for (const Index e : r.e) moved.push_back(static_cast<std::size_t>(split.q[static_cast<std::size_t>(e)]));
    long double squares = 0, most = 0, change = 0;
    for (std::size_t j = 0; j < moved.size(); ++j)
        squares += std::pow(softest[static_cast<Index>(j)] / problem.scales()[moved[j]], 2.0L);
    int growing = 0;
    for (const long double sign : {1.0L, -1.0L}) {
        Instant<long double> other = at;
        for (std::size_t j = 0; j < moved.size(); ++j)
            other.q[moved[j]] += sign * distance / std::sqrt(squares) * softest[static_cast<Index>(j)];
        if (unless_forced && !is_balanced(problem, other)) return Meeting::none;
        const auto there = beside(problem, std::move(other));
        if (!there) return Meeting::none;
        most = std::max(most, there->least);
        change = std::max(change, std::abs(there->least - least));
        growing += there->grows ? 1 : 0;
    }
    if (most <= nothing * values.values[0] || change <= much * least) return Meeting::none;
    // A minimum of several coordinates need not be convex: what grows beside it says nothing.
    return growing == 2 && n == 1 ? Meeting::grows : Meeting::open;
}

}  // namespace

Meeting meeting_at(const SteadyProblem& problem, const Instant<long double>& at) {
    // Newton's method knows a double root to the square root of its last digits, and roots of higher multiplicity
    // to less: to where the forces are next to nothing.
    constexpr std::array known_to{2e-5L, 1e-4L, 5e-4L, 2.5e-3L, 1e-2L};
    if (problem.residuals().n == 0 || !problem.has_first_approximation(at)) return Meeting::none;
    const std::optional<Reduced> r = reduced_at(problem, at);
    const auto values = r ? stiffness(*r) : std::nullopt;
    if (!values) return Meeting::none;
    for (const long double distance : known_to) {
        const Meeting found = meeting_within(problem, at, *r, *values, distance, distance > known_to.front());
        if (found != Meeting::none) return found;
    }
    return Meeting::none;
}

const char* name_of(Stable stable) {
    return stable == Stable::yes ? to_say("yes") : stable == Stable::no ? to_say("no") : to_say("undecided");
}

MatrixOf<long double> essential_motion(const SteadyProblem& problem, const Instant<long double>& at) {
    if (!problem.has_first_approximation(at)) return {};
    const std::optional<Reduced> r = reduced_at(problem, at);
    return r ? r->A : MatrixOf<long double>();
}

StabilityHint judge(const SteadyProblem& problem, EnergyRate energy, const Instant<long double>& at) {
    const Residuals& residuals = problem.residuals();
    if (!problem.has_first_approximation(at)) return {.because = say("the equations have a kink here")};
    const SteadySystem here = problem.linearized_at(at, at.u);
    const Tangent<long double> t = tangent(residuals, here.split, at, is_at_kink(residuals, at));
    if (!t.speed_rates_by.allFinite() || is_singular(problem, at, t.mass))
        return {.because = say("the mass matrix is singular here"), .singular = true};
    const Reduced r = reduced(problem, here.split, t);
    if (r.A.rows() == 0)
        return {.stable = Stable::yes,
                .because = here.split.q.empty()
                               ? say("nothing can move")
                               : say("the constraints give all rates, the same wherever the coordinates are")};
    const auto found = eigenvalues(r.A);
    if (!found) return {.because = say("the eigenvalues do not converge")};
    StabilityHint result;
    std::vector<std::complex<long double>> values = *found;
    long double size = 0;
    for (const auto& value : values) size = std::max(size, std::abs(value));
    const long double zero = on_axis * size;
    result.exact = values;
    for (auto& value : values) {
        if (std::abs(value.real()) < zero) value.real(0);
        if (std::abs(value.imag()) < zero) value.imag(0);
        result.eigenvalues.emplace_back(value);
    }
    std::sort(result.eigenvalues.begin(), result.eigenvalues.end(), [](const auto& a, const auto& b) {
        return std::pair(a.real(), a.imag()) < std::pair(b.real(), b.imag());
    });
    const auto count = [&](auto is) { return std::count_if(values.begin(), values.end(), is); };
    const auto growing = count([](const auto& v) { return v.real() > 0; });
    const auto turning = count([](const auto& v) { return v.real() == 0 && v.imag() != 0; });
    const auto zeros = count([](const auto& v) { return v.real() == 0 && v.imag() == 0; });
    if (meeting_at(problem, at) == Meeting::open) {
        result.meets = true;
        result.because = say(
            "equilibria meet here, or nearly so: which way the first approximation decides, the last digits of "
            "the state tell");
    } else if (growing > 0) {
        result.stable = Stable::no;
        result.because = say("an eigenvalue has a positive real part");
    } else if (turning == 0 && (zeros == 0 || zeros_are_rates(problem, r, here, at, zeros))) {
        result.stable = Stable::yes;
        result.because = zeros == 0
                             ? say("all eigenvalues have negative real parts")
                             : say("all eigenvalues but those of the cyclic rates have negative real parts");
    } else if (energy != EnergyRate::open && is_minimum(r, t, static_cast<Index>(here.split.q.size()))) {
        result.stable = energy == EnergyRate::grows ? Stable::no : Stable::yes;
        result.by_energy = true;
        result.because = energy == EnergyRate::constant ? say("the energy is at a minimum")
                         : energy == EnergyRate::falls
                             ? say("the energy is at a minimum, and no motion makes it grow")
                             : say("the energy is at a minimum, and every motion makes it grow");
    } else {
        result.because =
            say("eigenvalues on the imaginary axis, about which the first approximation says nothing");
    }
    if (result.stable != Stable::undecided) result.assumed.push_back(signs_in_numbers());
    return result;
}

}  // namespace alembert
