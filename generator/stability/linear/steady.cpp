// SPDX-License-Identifier: GPL-2.0-or-later
// Newton's method for steady motions, in the local coordinates of stability/linear/tangent.hpp. (Deuflhard, Newton
// Methods for Nonlinear Problems (2004), §4.4: Gauss-Newton steps of a system of lower rank.)
#include "stability/linear/steady.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "alembert/base/error.hpp"
#include "base/language/say.hpp"
#include "model/formalism/with_states.hpp"
#include "program/known_knots.hpp"
#include "program/rewriting.hpp"
#include "stability/linear/dense_long.hpp"
#include "stability/linear/kinks.hpp"
#include "stability/linear/paths.hpp"

namespace alembert {

using Index = Eigen::Index;
using Column = VectorOf<long double>;

namespace {

// Relative to the largest singular value; below this a direction is free.
constexpr long double no_pivot = 1e-11L;
constexpr long double small_step = 1e-16L;  // in units of the scales
constexpr long double rounding = 1e-15L;
constexpr long double longest_step = 0.5L;
constexpr int most_long_steps = 30;      // where steps are that long after so many, hardly any search finds a root
constexpr long double noise = 1e-17L;    // of the largest work that a force does in changes of the scales
constexpr long double solved = 1e-13L;   // relative to the effect of a change of 1 in units of the scales
constexpr long double smallest = 1e-6L;  // in units of the scales: what a state must tell apart
constexpr long double stays = 1e-9L;     // likewise, of the equations with all that occurs in motion alone

/// The least-squares solution of least length.
Column least_step(const LongMatrix& J, const Column& r, bool& full_rank) {
    if (J.cols() == 0) {
        full_rank = true;
        return Column(0);
    }
    LongMatrix scaled = J;
    Column right = -r;
    for (Index i = 0; i < J.rows(); ++i) {
        const long double row = J.row(i).cwiseAbs().maxCoeff();
        if (row > 0) scaled.row(i) /= row, right[i] /= row;
    }
    const LongLeastNorm step = least_norm(scaled, right, no_pivot);
    full_rank = step.rank == J.cols();
    return step.x;
}

/// Of the independent parameters, the numbers that the scene writes, or those that are given in their place.
std::vector<Rational> exact_values(const Mechanism& m, const Instant<long double>& at) {
    std::vector<Rational> result;
    for (const Mechanism::Parameter& one : m.parameters) {
        if (!one.independent) continue;
        const auto value = static_cast<double>(at.parameters[result.size()]);
        const GiNaC::numeric number = one.number();
        result.push_back(number.is_rational() && number.to_double() == value
                             ? cln::the<cln::cl_RA>(number.to_cl_N())
                             : exact(value));
    }
    return result;
}

/// Whether a node is zero whatever the state is, with these parameters: also "eps*(1 - z)" with eps = 0.
bool is_zero_with(const Program& program, int node, const std::vector<Rational>& parameters) {
    Program one = program;
    one.roots = {{Group::output, "value", node}};
    Rewriting rewriting(one);
    const Program made = rewriting.finish([&](int id) {
        const Variable& v = one[id].variable;
        return one[id].op == Op::variable && v.kind == Variable::Kind::parameter
                   ? rewriting.made().number(parameters[static_cast<std::size_t>(v.index)])
                   : rewriting.plain(id);
    });
    return made.is_zero(made.roots[0].node);
}

/// Leaves out the equations from `first` to `last` that say of one unknown that it stays as it is, and these
/// unknowns.
void leave_out_kept(SteadySystem& system, Index first, Index last) {
    std::vector<Index> rows, columns;
    std::vector<bool> is_kept(system.unknowns.size(), false);
    for (Index i = 0; i < system.by.rows(); ++i) {
        Index where = 0;
        const bool is_single = (system.by.row(i).array() != 0).count() == 1;
        if (is_single) system.by.row(i).cwiseAbs().maxCoeff(&where);
        if (is_single && first <= i && i < last && system.residual[i] == 0)
            is_kept[static_cast<std::size_t>(where)] = true;
        else
            rows.push_back(i);
    }
    std::vector<Index> unknowns;
    for (std::size_t j = 0; j < is_kept.size(); ++j)
        if (!is_kept[j]) {
            columns.push_back(static_cast<Index>(j));
            unknowns.push_back(system.unknowns[j]);
        }
    system.unknowns = std::move(unknowns);
    system.residual = Column(system.residual(rows));
    system.by = LongMatrix(system.by(rows, columns));
}

}  // namespace

SteadyProblem::SteadyProblem(const Mechanism& m, const Equations& e, const Start& start)
    : mechanism_(m),
      equations_(e),
      residuals_(m, e),
      start_(instant_of<long double>(residuals_, state_of(start, m, e))),
      essential_(static_cast<std::size_t>(m.size()), true),
      follows_q_(m.q_is_guess),
      follows_u_(static_cast<std::size_t>(e.size()), false),
      scales_(static_cast<std::size_t>(m.size()), 1) {
    if (residuals_.rates_are_speeds) follows_u_ = m.qdot_is_guess;
    const Split split = split_at(start_);
    const Index p = static_cast<Index>(split.u.size()), nr = static_cast<Index>(split.q.size());
    const Dependences depends = dependences(residuals_, split, start_);
    const std::vector<bool> essential = essential_coordinates(depends, residuals_, split, start_);
    for (Index i = 0; i < p + nr; ++i)
        if (depends(i, nr + p))
            throw ModelError(
                say("the equations change with time (the rate of {} holds t, and not through inputs); there is no "
                    "equilibrium or steady motion",
                    i < p ? e.u[split.u[i]].get_name() : m.q[split.q[i - p]].get_name()));
    for (Index j = 0; j < nr; ++j) essential_[split.q[j]] = essential[j];
    for (int i = 0; i < m.size(); ++i) follows_q_[i] = essential_[i];  // cyclic coordinates stay independent

    // The speeds that move no essential coordinate.
    const Tangent<long double> here = tangent(residuals_, split, start_, false, Undisturbed::steady);
    LongMatrix moves = LongMatrix::Zero(nr + p, p);
    // A state is no rate of a cyclic coordinate: it has to stay, where it has a rate; elsewhere it stays as given.
    std::vector<int> still;
    for (Index i = 0; i < p; ++i) {
        if (split.u[i] < residuals_.s - residuals_.states) continue;
        if (is_zero_with(residuals_.program, residuals_.forcing[split.u[i]], exact_values(m, start_)))
            still.push_back(split.u[i]);
        else
            moves(nr + i, i) = 1;
    }
    for (Index j = 0; j < nr; ++j) moves.row(j) = (essential[j] ? 1 : 0) * here.rates_by.row(j).middleCols(nr, p);
    kept_states_ = LongMatrix::Zero(static_cast<Index>(still.size()), residuals_.s);
    for (std::size_t k = 0; k < still.size(); ++k) kept_states_(static_cast<Index>(k), still[k]) = 1;
    LongMatrix free = LongMatrix::Identity(p, p);
    if (p > 0 && !moves.isZero(0)) free = kernel_of(moves);
    kept_speeds_ = LongMatrix::Zero(free.cols(), residuals_.s);
    for (Index k = 0; k < free.cols(); ++k)
        for (Index i = 0; i < p; ++i) kept_speeds_(k, split.u[i]) = free(i, k) / free.col(k).norm();
    // Where wheels roll, the speeds have to pass through others on the way to a root: for the bicycle the search
    // from as many starts finds 18 steady motions so, and 11 with the rates of lean, pitch and steering held at 0.
    if (residuals_.rates_are_speeds && residuals_.kept == residuals_.holonomic) {
        at_rest_.emplace(m, e, resting());
        at_rest_->inputs = residuals_.inputs;  // also those that act only in motion
    }
}

bool SteadyProblem::is_held(std::size_t place) const {
    return kept_states_.cols() > 0 && !kept_states_.col(static_cast<Index>(place)).isZero(0);
}

std::vector<bool> SteadyProblem::resting() const {
    // Coordinates that constraints of position tie to a cyclic one, to a state or to the time, directly or through
    // others, may move with it.
    std::vector<bool> result = essential_;
    std::vector<std::vector<int>> tied;
    for (const int root : residuals_.position) {
        tied.emplace_back();
        bool is_driven = false;  // inputs are unknowns, states are among the speeds
        for (const int id : residuals_.program.needed(std::vector<int>{root})) {
            const Node& node = residuals_.program[id];
            if (node.op != Op::variable) continue;
            if (node.variable.kind == Variable::Kind::coordinate) tied.back().push_back(node.variable.index);
            is_driven = is_driven || node.variable.kind == Variable::Kind::time ||
                        node.variable.kind == Variable::Kind::unknown ||
                        node.variable.kind == Variable::Kind::rate;
        }
        if (is_driven)
            for (const int i : tied.back()) result[static_cast<std::size_t>(i)] = false;
    }
    const auto rests = [&](int i) { return result[static_cast<std::size_t>(i)]; };
    for (bool changed = true; changed;) {
        changed = false;
        for (const std::vector<int>& coordinates : tied) {
            if (std::all_of(coordinates.begin(), coordinates.end(), rests)) continue;
            for (const int i : coordinates) {
                changed = changed || rests(i);
                result[static_cast<std::size_t>(i)] = false;
            }
        }
    }
    return result;
}

Split SteadyProblem::split_at(const Instant<long double>& at) const {
    return split_of(residuals_, at, follows_q_, follows_u_);
}

bool SteadyProblem::settle_at(Instant<long double>& at, const Split* split) const {
    if (residuals_.holonomic == 0 && residuals_.kept == 0) return true;
    return settle(residuals_, split != nullptr ? *split : split_at(at), at);
}

SteadySystem SteadyProblem::linearized_at(const Instant<long double>& at, const std::vector<long double>& given,
                                          Rates rates, const Split* split) const {
    SteadySystem result = system_of(residuals_, at, given, rates, split != nullptr ? *split : split_at(at));
    leave_out_roundings(result);
    return result;
}

void SteadyProblem::leave_out_roundings(SteadySystem& system) const {
    const auto p = static_cast<Index>(system.split.u.size());
    Column work = Column::Zero(p);
    for (Index i = 0; i < p; ++i) {
        const long double along = residuals_.rates_are_speeds ? scales_[system.split.u[i]] : 1;
        for (Index j = 0; j < system.by.cols(); ++j)
            work[i] = std::max(work[i], std::abs(system.by(i, j)) * scale_of(system, j) * along);
    }
    for (Index i = 0; i < p; ++i) {
        const bool is_kept = is_held(static_cast<std::size_t>(system.split.u[i]));
        if (is_kept) system.residual[i] = 0;  // also where decimals cancel but for rounding
        if (is_kept || work[i] < noise * work.maxCoeff()) system.by.row(i).setZero();
    }
}

SteadySystem SteadyProblem::resting_system(const Instant<long double>& at, const std::vector<long double>& given,
                                           Rates rates) const {
    SteadySystem result = system_of(*at_rest_, at, given, rates, split_at(at));
    leave_out_roundings(result);
    const auto p = static_cast<Index>(result.split.u.size());
    const Index still = result.by.cols() - p;  // coordinates, whose rates have an equation each
    leave_out_kept(result, p, p + still);
    return result;
}

SteadySystem SteadyProblem::system_of(const Residuals& residuals, const Instant<long double>& at,
                                      const std::vector<long double>& given, Rates rates,
                                      const Split& split) const {
    SteadySystem result{.split = split,
                        .tangent = tangent(residuals, split, at, false, Undisturbed::steady),
                        .unknowns = {},
                        .residual = {},
                        .by = {}};
    const Tangent<long double>& t = result.tangent;
    const LongMatrix& kept_rows = rates == Rates::given ? kept_speeds_ : kept_states_;
    const Index nr = static_cast<Index>(result.split.q.size()), p = static_cast<Index>(result.split.u.size());
    std::vector<Index> still;  // essential independent coordinates
    for (Index j = 0; j < nr; ++j)
        if (essential_[result.split.q[j]]) still.push_back(j);
    result.unknowns = still;
    for (Index i = 0; i < p; ++i) result.unknowns.push_back(nr + i);
    const Index n_still = static_cast<Index>(still.size()), kept = kept_rows.rows();
    result.residual.resize(p + n_still + kept);
    LongMatrix all(p + n_still + kept, nr + p);
    result.residual.head(p) = t.balance;
    all.topRows(p) = -t.force.leftCols(nr + p);
    for (Index j = 0; j < n_still; ++j) {
        result.residual[p + j] = t.rates[still[j]];
        all.row(p + j) = t.rates_by.row(still[j]).head(nr + p);
    }
    for (Index k = 0; k < kept; ++k) {
        long double sum = 0;
        for (int i = 0; i < residuals_.s; ++i) sum += kept_rows(k, i) * (at.u[i] - given[i]);
        result.residual[p + n_still + k] = sum;
        all.row(p + n_still + k) = kept_rows.row(k) * t.along.block(residuals_.n, 0, residuals_.s, nr + p);
    }
    result.by.resize(all.rows(), static_cast<Index>(result.unknowns.size()));
    for (std::size_t j = 0; j < result.unknowns.size(); ++j)
        result.by.col(static_cast<Index>(j)) = all.col(result.unknowns[j]);
    return result;
}

long double SteadyProblem::scale_of(const SteadySystem& here, Index unknown) const {
    const Index column = here.unknowns[static_cast<std::size_t>(unknown)];
    const bool is_coordinate = column < static_cast<Index>(here.split.q.size());
    return is_coordinate ? scales_[here.split.q[column]] : 1;
}

long double SteadyProblem::size(const Column& change) const {
    long double largest = 0;
    for (Index i = 0; i < residuals_.n; ++i) largest = std::max(largest, std::abs(change[i]) / scales_[i]);
    return largest;
}

long double SteadyProblem::unbalanced(const SteadySystem& here) const {
    long double worst = 0;
    for (Index i = 0; i < here.residual.size(); ++i) {
        long double does = 1e-3L;  // the reference if there is no other force
        for (Index j = 0; j < here.by.cols(); ++j) does += std::abs(here.by(i, j)) * scale_of(here, j);
        worst = std::max(worst, std::abs(here.residual[i]) / does);
    }
    return worst;
}

bool SteadyProblem::is_resolved(const Instant<long double>& at) const {
    constexpr long double most = smallest / std::numeric_limits<long double>::epsilon();
    for (int i = 0; i < residuals_.n; ++i)
        if (std::abs(at.q[i]) > most * scales_[i]) return false;
    return std::all_of(at.u.begin(), at.u.end(), [](long double u) { return std::abs(u) <= most; });
}

std::optional<SteadyRoot> SteadyProblem::solve(Instant<long double> at, Rates rates, int most) const try {
    const std::vector<long double> given = at.u;
    if (residuals_.rates_are_speeds)
        for (int i = 0; i < residuals_.n; ++i)
            if (essential_[i]) at.u[i] = 0;
    if (!settle_at(at)) return {};
    long double last = HUGE_VALL;
    for (int step = 0; step < most; ++step) {
        const SteadySystem here = at_rest_ ? resting_system(at, given, rates) : linearized_at(at, given, rates);
        if (!here.residual.allFinite() || !here.by.allFinite()) return {};
        bool full_rank = true;
        const Column change = least_step(here.by, here.residual, full_rank);
        Column local = Column::Zero(here.tangent.along.cols());
        for (std::size_t j = 0; j < here.unknowns.size(); ++j)
            local[here.unknowns[j]] = change[static_cast<Index>(j)];
        const Column whole = here.tangent.along * local;
        const long double size_q = size(whole.head(residuals_.n));
        long double moved = size_q;
        for (int i = 0; i < residuals_.s; ++i)
            moved = std::max(moved, std::abs(whole[residuals_.n + i]) / std::max(1.0L, std::abs(at.u[i])));
        if (!std::isfinite(moved)) return {};
        if (moved < small_step || (step > 8 && moved < 1e-14L && moved >= last)) {
            const long double worst = unbalanced(here);
            if (worst > solved) return {};
            if (!is_resolved(at)) return {};
            // The full equations have the last word.
            if (at_rest_ && unbalanced(linearized_at(at, given, rates)) > stays) return {};
            for (int i = 0; i < residuals_.n; ++i)
                if (std::abs(at.q[i]) < rounding * scales_[i]) at.q[i] = 0;
            for (long double& u : at.u)
                if (std::abs(u) < rounding) u = 0;
            return SteadyRoot{.at = at, .residual = worst, .step = moved, .isolated = full_rank};
        }
        if (step >= most_long_steps && moved > longest_step) return {};
        last = moved;
        const long double part = size_q > longest_step ? longest_step / size_q : 1;
        for (int i = 0; i < residuals_.n; ++i) at.q[i] += part * whole[i];
        for (int i = 0; i < residuals_.s; ++i) at.u[i] += part * whole[residuals_.n + i];
        if (!settle_at(at)) return {};
    }
    return {};
} catch (const IntegrationError&) {  // the constraints lose rank on the way
    return {};
}

Start SteadyProblem::start_at(const Start& like, const Instant<long double>& at) const {
    Start result = like;
    for (std::size_t i = 0; i < result.q.size(); ++i) result.q[i] = static_cast<double>(at.q[i]);
    for (std::size_t i = 0; i < result.parameters.size(); ++i)
        result.parameters[i] = static_cast<double>(at.parameters[i]);
    State<long double> state{.parameters = at.parameters, .t = at.t, .q = at.q, .qdot = at.u, .qddot = {}};
    state.unknown.resize(residuals_.input_places());
    for (std::size_t k = 0; k < residuals_.inputs.size(); ++k) state.unknown[residuals_.inputs[k]] = at.inputs[k];
    const std::vector<long double> value = interpret(residuals_.program, state);
    for (std::size_t k = 0; k < result.speeds.size(); ++k) result.speeds[k] = static_cast<double>(at.u[k]);
    for (std::size_t k = 0; k < result.states.size(); ++k)
        result.states[k] = static_cast<double>(at.u[first_state(at.u.size(), mechanism_) + k]);
    for (std::size_t i = 0; i < result.qdot.size(); ++i)
        result.qdot[i] = static_cast<double>(value[residuals_.rate[i]]);
    return result;
}

std::vector<std::pair<std::string, std::string>> steady_nearby(const Mechanism& m, const Equations& e,
                                                               const Start& start) try {
    const SteadyProblem problem(m, e, start);
    const auto root = problem.solve(problem.start());
    if (!root) return {};
    std::vector<std::pair<std::string, std::string>> state;
    for (int i = 0; i < m.size(); ++i) {
        if (!problem.essential()[i]) continue;
        state.emplace_back(m.q[i].get_name(), fmt::format("{}", static_cast<double>(root->at.q[i])));
        if (start.qdot[i] != 0) state.emplace_back(m.q[i].get_name() + "'", "0");
    }
    for (std::size_t k = 0; k < m.states.size(); ++k)
        state.emplace_back(m.states[k].derivative[0].get_name(),
                           fmt::format("{}", static_cast<double>(root->at.u[first_state(e.u.size(), m) + k])));
    return state;
} catch (const std::runtime_error&) {  // there is no such state to suggest
    return {};
}

bool SteadyProblem::has_first_approximation(const Instant<long double>& at) const try {
    if (!is_at_kink(residuals_, at)) return true;
    const Split split = split_at(at);
    check_differentiable(residuals_, split, at, tangent(residuals_, split, at, true), mechanism_, equations_);
    return true;
} catch (const ModelError&) {
    return false;
} catch (const IntegrationError&) {
    return false;
}

}  // namespace alembert
