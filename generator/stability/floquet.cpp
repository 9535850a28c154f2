// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/floquet.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>

#include "alembert/error.hpp"
#include "lower/lower.hpp"
#include "model/energy.hpp"
#include "program/differentiate.hpp"
#include "program/tape.hpp"
#include "run/quad_motion.hpp"

namespace alembert {

using GiNaC::ex;
using Index = Eigen::Index;

namespace {

constexpr double fine = 1e-26, coarse = 1e-20;
constexpr double closed = 1e-16;  // |x(T) − x(0)| of a periodic motion
constexpr int most_rounds = 30;

/// The state with the columns of Φ behind it.
class Variation {
public:
    Variation(const Program& program, const std::vector<Quad>& parameters)
        : n_(program.coordinates.size()),
          tape_(program, wanted(program), parameters),
          out_(wanted(program).size()) {}

    std::size_t size() const { return 2 * n_; }

    void operator()(Quad t, const Quad* y, Quad* rate) const {
        const std::size_t N = size();
        tape_(t, y, y + n_, out_.data());
        for (std::size_t i = 0; i < n_; ++i) {
            rate[i] = y[n_ + i];
            rate[n_ + i] = out_[i];
        }
        const Quad* const J = out_.data() + n_;
        for (std::size_t c = 0; c < N; ++c)
            for (std::size_t i = 0; i < N; ++i) {
                Quad sum = 0;
                for (std::size_t k = 0; k < N; ++k) sum += J[i * N + k] * y[N + c * N + k];
                rate[N + c * N + i] = sum;
            }
    }

    struct End {
        std::vector<Quad> state, Phi;  ///< Φ by columns
    };
    End over(const std::vector<Quad>& start, Quad from, Quad period, double tolerance) const {
        const std::size_t N = size();
        std::vector<Quad> y(N + N * N, Quad(0));
        std::copy(start.begin(), start.end(), y.begin());
        for (std::size_t k = 0; k < N; ++k) y[N + k * N + k] = 1;
        const QuadMotion motion = extrapolate([this](Quad t, const Quad* x, Quad* rate) { (*this)(t, x, rate); },
                                              y, from, from + period, {.tolerance = tolerance, .budget = 400'000});
        if (!motion.finished)
            throw IntegrationError("the variational equations cannot be integrated over one period",
                                   static_cast<double>(from), {});
        return {{motion.state.begin(), motion.state.begin() + static_cast<std::ptrdiff_t>(N)},
                {motion.state.begin() + static_cast<std::ptrdiff_t>(N), motion.state.end()}};
    }
    std::vector<Quad> rate_at(Quad t, const std::vector<Quad>& x) const {
        std::vector<Quad> y = x, rate(size() + size() * size());
        y.resize(rate.size(), Quad(0));
        (*this)(t, y.data(), rate.data());
        rate.resize(size());
        return rate;
    }

private:
    static std::vector<int> wanted(const Program& program) {
        std::vector<int> result = program.nodes_of(Group::acceleration);
        const std::vector<int> J = program.nodes_of(Group::jacobian);
        result.insert(result.end(), J.begin(), J.end());
        return result;
    }

    std::size_t n_;
    mutable Tape<Quad> tape_;
    mutable std::vector<Quad> out_;
};

void check_period(const Variation& f, const std::vector<Quad>& start, Quad t0, Quad period) {
    std::mt19937_64 random(5);
    for (int k = 0; k < 6; ++k) {
        std::vector<Quad> x = start;
        for (Quad& one : x)
            one += static_cast<Quad>(0.2 * (static_cast<double>(random() >> 11) / 9007199254740992.0 - 0.5));
        const Quad t = t0 + period * static_cast<Quad>((k + 0.37) / 6.0);
        const std::vector<Quad> now = f.rate_at(t, x), later = f.rate_at(t + period, x);
        for (std::size_t i = 0; i < now.size(); ++i)
            if (abs(now[i] - later[i]) > static_cast<Quad>(1e-12) * (1 + abs(now[i])))
                throw ModelError(fmt::format(
                    "the equations do not have the period {:.10g}: a rate is {:.10g} at t = {:.6g} and {:.10g} "
                    "one period later; give the period of the inputs, or a multiple of it",
                    static_cast<double>(period), static_cast<double>(now[i]), static_cast<double>(t),
                    static_cast<double>(later[i])));
    }
}

Eigen::MatrixXd matrix_of(const std::vector<Quad>& Phi, Index N) {
    Eigen::MatrixXd result(N, N);
    for (Index c = 0; c < N; ++c)
        for (Index i = 0; i < N; ++i) result(i, c) = static_cast<double>(Phi[static_cast<std::size_t>(c * N + i)]);
    return result;
}

/// Newton's method: x₀ (and T, where `free_period`) so that x(T) = x₀; the shortest step.
void shoot(const Variation& f, std::vector<Quad>& x, Quad t0, Quad& period, bool free_period) {
    const Index N = static_cast<Index>(f.size());
    double misfit = 0;
    for (int round = 0; round < most_rounds; ++round) {
        const Variation::End end = f.over(x, t0, period, coarse);
        const std::vector<Quad> rate = f.rate_at(t0 + period, end.state);
        Quad largest = 0;
        for (std::size_t i = 0; i < x.size(); ++i) largest = std::max(largest, abs(end.state[i] - x[i]));
        misfit = static_cast<double>(largest);
        if (misfit < closed) return;
        Eigen::MatrixXd J(N, N + (free_period ? 1 : 0));
        J.leftCols(N) = matrix_of(end.Phi, N) - Eigen::MatrixXd::Identity(N, N);
        Eigen::VectorXd g(N);
        for (Index i = 0; i < N; ++i) {
            const auto k = static_cast<std::size_t>(i);
            g[i] = static_cast<double>((end.state[k] - x[k]) / largest);
            if (free_period) J(i, N) = static_cast<double>(rate[k]);
        }
        const Eigen::VectorXd step = J.completeOrthogonalDecomposition().solve(-g);
        if (!step.allFinite() || step.norm() * misfit > 1e3) break;
        for (Index i = 0; i < N; ++i) x[static_cast<std::size_t>(i)] += largest * static_cast<Quad>(step[i]);
        if (free_period) period += largest * static_cast<Quad>(step[N]);
        if (!(period > 0)) break;
    }
    throw ModelError(
        fmt::format("no motion of period {:.10g} is found from this state: after Newton's method the state "
                    "misses itself by {:.3g}; give a state and a period nearer to one",
                    static_cast<double>(period), misfit));
}

enum class Place { inside, circle, outside, unclear };

/// Where each multiplier lies; `mirrored`: the set of them is its own image in the circle.
std::vector<Place> places(const std::vector<RootOf>& roots, bool mirrored) {
    std::vector<Place> result;
    for (const RootOf& root : roots) {
        const double size = std::abs(root.value);
        Place place = size + root.radius < 1   ? Place::inside
                      : size - root.radius > 1 ? Place::outside
                                               : Place::unclear;
        if (place == Place::unclear && mirrored && root.multiplicity == 1) {
            const std::complex<double> image = 1.0 / std::conj(root.value);
            const double reach = 4 * (root.radius + std::abs(image - root.value)) + 1e-12;
            const auto near = std::count_if(roots.begin(), roots.end(), [&](const RootOf& other) {
                return std::abs(other.value - root.value) <= reach + other.radius;
            });
            if (near == 1) place = Place::circle;
        }
        result.push_back(place);
    }
    return result;
}

Decision judged(const FloquetResult& found, const std::vector<RootOf>& roots, bool autonomous, bool linear,
                bool mirrored) {
    std::vector<Place> at = places(roots, mirrored);
    if (autonomous) {  // the one along the motion
        std::size_t own = 0;
        for (std::size_t k = 0; k < roots.size(); ++k)
            if (std::abs(roots[k].value - 1.0) < std::abs(roots[own].value - 1.0)) own = k;
        at[own] = Place::inside;
    }
    const auto has = [&](Place place) { return std::find(at.begin(), at.end(), place) != at.end(); };
    const std::string of = fmt::format("the largest multiplier over the period {:.10g} has the size {:.12g}",
                                       found.period, std::abs(found.multipliers.front()));
    const char* const orbit =
        autonomous ? "; the one along the motion is 1 and not counted: the orbit is stable" : "";
    if (has(Place::outside)) return {StabilityVerdict::unstable, StabilityTheorem::floquet, of + ", beyond 1"};
    if (!has(Place::circle) && !has(Place::unclear))
        return {StabilityVerdict::asymptotically_stable, StabilityTheorem::floquet,
                autonomous ? std::string("all multipliers but one are smaller than 1") + orbit : of + ", below 1"};
    if (linear && !has(Place::unclear))
        return {StabilityVerdict::stable, StabilityTheorem::floquet,
                "all multipliers are simple and on the unit circle: the equations are linear and have a "
                "Hamiltonian, so that none can leave it"};
    return {
        StabilityVerdict::undecided, StabilityTheorem::none,
        fmt::format("critical: no multiplier is surely beyond the unit circle, and some are on it{}; the first "
                    "approximation over a period says nothing about {} equations",
                    has(Place::unclear) ? " or too near to tell" : "", linear ? "these" : "nonlinear")};
}

}  // namespace

bool changes_with_time(const Mechanism& m, const Equations& e) {
    const auto moves = [&](const ex& value) {
        for (const ex& slope : m.explicit_time_derivative({value}))
            if (!is_identically_zero(slope, m)) return true;
        return false;
    };
    for (const Mechanism::Input& input : m.inputs)
        for (const GiNaC::symbol& derivative : input.derivative)
            for (int i = 0; i < e.size(); ++i)
                if (m.z->depends(e.forcing(i), {derivative}) && m.z->depends(input.value, {m.t})) return true;
    for (int i = 0; i < e.size(); ++i) {
        if (moves(m.z->name(e.forcing(i)))) return true;
        for (int j = 0; j <= i && e.M.rows() > 0; ++j)
            if (moves(m.z->name(e.M(i, j)))) return true;
    }
    return false;
}

FloquetResult floquet(const Derived& d, const Start& start, const ExactOverrides& exact_at, double period) {
    const Mechanism& m = d.mechanism;
    if (!m.constraints.empty() || !m.unilateral.empty() || !d.equations.speeds_are_rates())
        throw ModelError(
            "multipliers are computed for scenes without constraints, contacts and [speeds]; choose independent "
            "coordinates");
    const auto program = differentiated(lowered(d).program);
    if (!program) throw ModelError("the equations of this scene are too large to be differentiated, or singular");
    const ExactStart exact = exact_start(m, start, exact_at);
    std::vector<Quad> parameters, x;
    for (const Certain& p : exact.parameters) parameters.push_back(p.middle());
    for (const CertainVector* list : {&exact.q, &exact.qdot})
        for (const Certain& one : *list) x.push_back(one.middle());
    const Quad t0 = exact.t.middle();
    const Variation f(program->program, parameters);
    FloquetResult result;
    Quad T = static_cast<Quad>(period);
    if (!(period > 0)) {  // as exactly as the scene has it
        Program one = begun(m);
        const int node = lower_expression(one, m, *m.run.period);
        Tape<Quad>(one, {node}, parameters)(0, nullptr, nullptr, &T);
    }
    const bool autonomous = !changes_with_time(m, d.equations);
    if (!autonomous) check_period(f, x, t0, T);
    shoot(f, x, t0, T, autonomous);
    const Variation::End good = f.over(x, t0, T, fine), rough = f.over(x, t0, T, coarse);
    const int N = static_cast<int>(f.size());
    CertainMatrix Phi(N, N);
    for (int c = 0; c < N; ++c)
        for (int i = 0; i < N; ++i) {
            const auto k = static_cast<std::size_t>(c * N + i);
            Phi(i, c) = Certain::about(good.Phi[k], static_cast<double>(abs(good.Phi[k] - rough.Phi[k])) + 1e-24);
        }
    std::vector<RootOf> roots = roots_of(characteristic(Phi));
    std::sort(roots.begin(), roots.end(),
              [](const RootOf& a, const RootOf& b) { return std::abs(a.value) > std::abs(b.value); });
    for (const RootOf& root : roots) {
        result.multipliers.push_back(root.value);
        result.radii.push_back(root.radius);
    }
    result.period = static_cast<double>(T);
    for (const Quad& one : x) result.start.push_back(static_cast<double>(one));
    bool mirrored = true;
    for (const bool dissipative : {true, false})
        for (const ex& load : m.generalized_forces(dissipative))
            mirrored = mirrored && is_identically_zero(load, m);
    bool still = autonomous;
    for (const Quad& rate : f.rate_at(t0, x)) still = still && abs(rate) < static_cast<Quad>(1e-12);
    if (still)
        throw ModelError(
            "the equations do not hold t and this state is an equilibrium; leave the period out, or give a "
            "state on a periodic motion");
    result.decision = judged(result, roots, autonomous, is_linear(m, d.equations), mirrored);
    return result;
}

}  // namespace alembert
