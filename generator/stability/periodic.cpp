// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/periodic.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "alembert/base/dense.hpp"
#include "alembert/base/error.hpp"
#include "alembert/ode/integrate.hpp"
#include "base/language/say.hpp"
#include "model/energy.hpp"
#include "program/differentiate.hpp"
#include "program/jump_watch.hpp"
#include "program/lower/lower.hpp"
#include "program/quad_motion.hpp"
#include "program/switches.hpp"

namespace alembert {

using GiNaC::ex;
using Index = Eigen::Index;

namespace {

constexpr int most_rounds = 30;

template <typename Real>
struct Precision;
template <>
struct Precision<Quad> {
    static constexpr double closed = 1e-16, shooting = 1e-20;
};
template <>
struct Precision<double> {
    static constexpr double closed = 1e-9, shooting = 1e-11;
};

/// From y = (x, columns of Φ) over one period; empty where the numbers fail.
std::vector<Quad> integrated(const Variation<Quad>& f, const std::vector<Quad>& y, std::size_t columns, Quad from,
                             Quad period, double tolerance) {
    const QuadMotion motion = extrapolate([&](Quad t, const Quad* x, Quad* rate) { f(t, x, rate, columns); }, y,
                                          from, from + period, {.tolerance = tolerance, .budget = 400'000});
    return motion.finished ? motion.state : std::vector<Quad>();
}
std::vector<double> integrated(const Variation<double>& f, const std::vector<double>& y, std::size_t columns,
                               double from, double period, double tolerance) {
    const Rhs rhs = make_rhs(static_cast<int>(y.size()),
                             [&f, columns](double t, const double* x, double* rate) { f(t, x, rate, columns); });
    const Trajectory motion = integrate(
        rhs, y, {.start = from, .duration = period, .tolerance = tolerance, .sample = period, .budget = 200'000});
    if (motion.failure) return {};
    const auto end = motion.final_state();
    return {end.begin(), end.end()};
}

Program differentiated_program(const Derived& d) {
    if (!d.mechanism.unilateral.empty())
        throw ModelError(
            say("multipliers are computed for scenes without contacts; put a constraint in place of a "
                "contact that stays closed"));
    auto program = derivatives_of(d, lowered(d).program);
    if (!program)
        throw ModelError(say("the equations of this scene are too large to be differentiated, or singular"));
    return std::move(program->program);
}

/// Whether a sign changes with t: sign(cos(t)) has no slope in t, and is no constant.
bool is_switched_by_time(const Program& program) {
    const std::vector<int> needed = program.needed(program.right_hand_side());
    return std::any_of(needed.begin(), needed.end(), [&](int id) {
        return program[id].op == Op::sign && (program[id].depends & bit(Variable::Kind::time)) != 0;
    });
}

}  // namespace

PeriodicSystem::PeriodicSystem(const Derived& d)
    : derived_(d),
      program_(differentiated_program(d)),
      residuals_(in_terms_of(d.equations, d.mechanism), d.equations),
      autonomous_(!changes_with_time(d.mechanism, d.equations) && !is_switched_by_time(program_)) {
    if (jumps_along_motion(program_))
        throw ModelError(
            say("a periodic motion is followed where accelerations are continuous; here they jump where the "
                "argument of a 'sign' is zero or a table has a corner, and multipliers with them; write a smooth "
                "function in its place, or take interpolation = \"cubic\""));
}

std::vector<std::string> PeriodicSystem::names() const {
    std::vector<std::string> result;
    for (const GiNaC::symbol& q : derived_.mechanism.q) result.push_back(q.get_name());
    for (const GiNaC::symbol& u : derived_.equations.u) result.push_back(u.get_name());
    return result;
}

template <typename Real>
PeriodicMotion<Real> PeriodicSystem::motion(const Start& start, double period) const {
    const Mechanism& m = derived_.mechanism;
    const State<double> state = state_of(start, m, derived_.equations);
    PeriodicMotion<Real> result{.parameters = {start.parameters.begin(), start.parameters.end()},
                                .x = {state.q.begin(), state.q.end()},
                                .t = static_cast<Real>(start.t),
                                .period = static_cast<Real>(period)};
    for (const double u : state.qdot) result.x.push_back(static_cast<Real>(u));
    if (period > 0 || !m.run.period) return result;
    Program one = begun(m);
    const int node = lower_expression(one, m, *m.run.period);
    Tape<Real>(one, {node}, result.parameters)(Real(0), nullptr, nullptr, &result.period);
    return result;
}

template <typename Real>
PeriodicSystem::Frame PeriodicSystem::frame(const PeriodicMotion<Real>& motion) const {
    Frame result;
    if (!constrained()) {
        for (int k = 0; k < residuals_.n + residuals_.s; ++k) result.rows.push_back(k);
        return result;
    }
    const auto n = static_cast<std::size_t>(residuals_.n);
    State<double> state;
    state.t = static_cast<double>(motion.t);
    for (const Real& p : motion.parameters) state.parameters.push_back(static_cast<double>(p));
    for (std::size_t k = 0; k < motion.x.size(); ++k)
        (k < n ? state.q : state.qdot).push_back(static_cast<double>(motion.x[k]));
    result.at = instant_of<long double>(residuals_, state);
    for (std::size_t k = 0; k < motion.x.size(); ++k)
        (k < n ? result.at.q[k] : result.at.u[k - n]) = static_cast<long double>(motion.x[k]);
    const Mechanism& m = derived_.mechanism;
    std::vector<bool> guessed(static_cast<std::size_t>(residuals_.s), false);
    if (residuals_.rates_are_speeds) guessed = m.qdot_is_guess;
    result.split = split_of(residuals_, result.at, m.q_is_guess, guessed);
    const Tangent<long double> here = tangent(residuals_, result.split, result.at);
    const auto independent = static_cast<Index>(result.split.q.size() + result.split.u.size());
    result.columns = here.along.topLeftCorner(residuals_.n + residuals_.s, independent);
    result.rows = result.split.q;
    for (const int u : result.split.u) result.rows.push_back(residuals_.n + u);
    return result;
}

/// Dependent ones moved until the constraints hold.
template <typename Real>
bool PeriodicSystem::settled(PeriodicMotion<Real>& motion) const {
    if (!constrained()) return true;
    Frame here = frame(motion);
    if (!settle(residuals_, here.split, here.at)) return false;
    const auto n = static_cast<std::size_t>(residuals_.n);
    for (const int k : here.split.q_dependent)
        motion.x[static_cast<std::size_t>(k)] = static_cast<Real>(here.at.q[static_cast<std::size_t>(k)]);
    for (const int k : here.split.u_dependent)
        motion.x[n + static_cast<std::size_t>(k)] = static_cast<Real>(here.at.u[static_cast<std::size_t>(k)]);
    return true;
}

template <typename Real>
std::vector<int> PeriodicSystem::independent(const PeriodicMotion<Real>& motion) const {
    return frame(motion).rows;
}

template <typename Real>
PeriodEnd<Real> PeriodicSystem::monodromy(const PeriodicMotion<Real>& motion, double tolerance) const {
    const Frame here = frame(motion);
    const std::size_t N = motion.x.size(), columns = here.rows.size();
    std::vector<Real> y = motion.x;
    for (std::size_t c = 0; c < columns; ++c)
        for (std::size_t i = 0; i < N; ++i)
            y.push_back(here.columns.size() > 0
                            ? static_cast<Real>(here.columns(static_cast<Index>(i), static_cast<Index>(c)))
                            : Real(i == c ? 1 : 0));
    const Variation<Real> f(program_, motion.parameters);
    y = integrated(f, y, columns, motion.t, motion.period, tolerance);
    PeriodEnd<Real> end;
    end.finished = !y.empty();
    if (!end.finished) return end;
    end.state.assign(y.begin(), y.begin() + static_cast<std::ptrdiff_t>(N));
    for (std::size_t c = 0; c < columns; ++c)
        for (const int row : here.rows) end.Phi.push_back(y[N + c * N + static_cast<std::size_t>(row)]);
    return end;
}

/// Follows one period in double precision.
template <typename Real>
void PeriodicSystem::look_for_jumps(const PeriodicMotion<Real>& motion) const {
    constexpr double usual = 1e-9;
    std::vector<double> parameters, y;
    for (const Real& p : motion.parameters) parameters.push_back(static_cast<double>(p));
    for (const Real& x : motion.x) y.push_back(static_cast<double>(x));
    JumpWatch watch(program_, parameters);
    const Variation<double> f(program_, parameters);
    const Rhs rhs =
        make_rhs(static_cast<int>(y.size()), [&f](double t, const double* x, double* rate) { f(t, x, rate, 0); });
    integrate(
        rhs, y,
        {.start = static_cast<double>(motion.t),
         .duration = static_cast<double>(motion.period),
         .tolerance = usual,
         .budget = 200'000,
         .on_step = [&](double t, std::span<const double> x, std::span<const double>) { watch(t, x.data()); }});
}

template <typename Real>
bool PeriodicSystem::shoot(PeriodicMotion<Real>& motion) const {
    const Variation<Real> f(program_, motion.parameters);
    if (!settled(motion)) return false;
    for (int round = 0; round < most_rounds; ++round) {
        const PeriodEnd<Real> end = monodromy(motion, Precision<Real>::shooting);
        if (!end.finished) return false;
        const std::vector<int> rows = frame(motion).rows;
        const std::vector<Real> rate = f.rate_at(motion.t + motion.period, end.state);
        Real largest = 0;
        for (const int row : rows) {
            const Real miss = end.state[static_cast<std::size_t>(row)] - motion.x[static_cast<std::size_t>(row)];
            largest = std::max(largest, miss < 0 ? Real(-miss) : miss);
        }
        motion.closure_error = static_cast<double>(largest);
        if (motion.closure_error < Precision<Real>::closed) {
            look_for_jumps(motion);
            return true;
        }
        const Index N = static_cast<Index>(rows.size());
        Eigen::MatrixXd J(N, N + (autonomous_ ? 1 : 0));
        Eigen::VectorXd g(N);
        for (Index i = 0; i < N; ++i) {
            const auto row = static_cast<std::size_t>(rows[static_cast<std::size_t>(i)]);
            for (Index c = 0; c < N; ++c)
                J(i, c) = static_cast<double>(end.Phi[static_cast<std::size_t>(c * N + i)]) - (i == c ? 1 : 0);
            g[i] = static_cast<double>((end.state[row] - motion.x[row]) / largest);
            if (autonomous_) J(i, N) = static_cast<double>(rate[row]);
        }
        const Eigen::VectorXd step = least_norm(J, -g).x;
        if (!step.allFinite() || step.norm() * motion.closure_error > 1e3) return false;
        for (Index i = 0; i < N; ++i)
            motion.x[static_cast<std::size_t>(rows[static_cast<std::size_t>(i)])] +=
                largest * static_cast<Real>(step[i]);
        if (autonomous_) motion.period += largest * static_cast<Real>(step[N]);
        if (!(motion.period > 0) || !settled(motion)) return false;
    }
    return false;
}

#define ALEMBERT_PERIODIC(Real)                                                                    \
    template PeriodicMotion<Real> PeriodicSystem::motion<Real>(const Start&, double) const;        \
    template bool PeriodicSystem::shoot(PeriodicMotion<Real>&) const;                              \
    template PeriodEnd<Real> PeriodicSystem::monodromy(const PeriodicMotion<Real>&, double) const; \
    template std::vector<int> PeriodicSystem::independent(const PeriodicMotion<Real>&) const;
ALEMBERT_PERIODIC(double)
ALEMBERT_PERIODIC(Quad)
#undef ALEMBERT_PERIODIC

bool changes_with_time(const Mechanism& m, const Equations& e) {
    Intermediates::Direction time{{m.t, 1}};  // states change with the motion
    for (const Mechanism::Input& input : m.inputs)
        for (std::size_t order = 0; order < 2; ++order)
            time.emplace_back(input.derivative[order], input.derivative[order + 1]);
    const auto moves = [&](const ex& value) {
        return !is_identically_zero(m.z->push_forward({value}, time)[0], m);
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

}  // namespace alembert
